// The report: one HTML file with all that it needs.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "ofm/report/report_data.h"

namespace ofm {

/// How much of their maps the runs of a report have together: 2.7 MB of points and 1 MB of voxels.
inline constexpr RecordLimits kReportLimits = {200000, 60000};

/// Reads what `ofm-slam run` has written into the folders, with as much of their maps as `limits`
/// lets all of them have together. `truth_file` may be empty (see MakeReportData). Throws Error
/// that names the folder, or the file and line, at fault, and where there are no folders or more
/// than kMaxRuns.
ReportData LoadReportData(const std::vector<std::filesystem::path>& folders,
                          const std::filesystem::path& truth_file,
                          const RecordLimits& limits = kReportLimits);

/// The page: a document that refers to nothing outside of it. The same folders give the same bytes.
/// Throws Error where a picture of a key frame cannot be read.
std::string ReportPage(const ReportData& data, const std::string& version);

}  // namespace ofm
