// Parts of a report's page.
#pragma once

#include <string>
#include <vector>

#include "ofm/report/figures.h"

namespace ofm {

/// A heading with an anchor.
std::string SectionHead(const char* anchor, const char* title, const std::string& lead);

/// The drawings of a figure side by side, each with its description; what is missing in lines.
std::string FigureHtml(const Figure& figure);

/// Lines that say what is missing.
std::string MissingHtml(const std::vector<std::string>& lines);

/// A run's name beside a patch of its colour; `run` is its number.
std::string RunNameHtml(std::size_t run, const std::string& name);

/// A card for each run with its main figures, then a table that compares all runs.
std::string SummaryHtml(const ReportData& data);

/// Pictures of key frames, a strip for each run.
std::string KeyframesHtml(const ReportData& data);

/// The 3-D view with its data, and the classes' colours.
std::string ViewerHtml(const ReportData& data);

/// A table of objects and one of tracks for each run.
std::string ObjectsHtml(const ReportData& data);

}  // namespace ofm
