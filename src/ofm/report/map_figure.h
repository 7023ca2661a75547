// The semantic map from above.
#pragma once

#include "ofm/report/figures.h"

namespace ofm {

/// A plot for each run that has a cloud: the cloud from above by class (DrawMapFromAbove), its
/// objects' boxes with their classes, and the camera's path.
Figure MapFigure(const ReportData& data);

/// The classes that the runs' clouds, voxels and objects have, by id, with their names.
std::map<int, std::string> ClassesShown(const ReportData& data);

}  // namespace ofm
