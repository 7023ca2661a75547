// The data of the report's 3-D view.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>

#include "ofm/report/report_data.h"

namespace ofm {

/// {"up", "truth" (or null), "truth_color", "none_color", "classes": [{"id", "name", "color"}],
/// "runs": [{"name", "color", "cloud", "voxels", "trajectory"}]}, in the report's world [m].
/// Clouds and voxels are {"count", "min", "step", "positions", "colors", "labels"}: a position is
/// min + step * a 16-bit number for each axis; positions, colours (RGB) and labels (class ids) are
/// base64 of little-endian numbers. Clouds also have "spacing_m", voxels "resolution_m", "sizes"
/// (exponents of 2) and, as they are in the run's own world, "report_from_run" (three rows of a
/// rigid transform). Paths are 32-bit floats. A point takes 10 bytes, 13.3 in base64. Null where
/// there is nothing to show.
nlohmann::ordered_json SceneToJson(const ReportData& data);

}  // namespace ofm
