// Camera parameters from files and by name.
#pragma once

#include <filesystem>
#include <string>

#include "ofm/camera/pinhole_camera.h"

namespace ofm {

/// Reads a camera from YAML (the fields of PinholeCamera) or, where the name ends in .json, from
/// JSON: width, height, fx, fy, cx, cy, distortion [k1, k2, p1, p2, k3], depth_scale, baseline_m,
/// depth_delay_s.
/// Size, focal lengths and principal point are required, the rest has PinholeCamera's defaults.
/// Throws Error with path and line: not readable, unknown key, wrong type, out of range, missing.
PinholeCamera LoadCamera(const std::filesystem::path& path);

/// The camera that a user means by `name_or_path`: a preset ("tum-fr1"), a file, or "auto": the
/// camera.json or camera.yaml in `sequence_folder`. Throws Error that lists what can be given.
PinholeCamera ResolveCamera(const std::string& name_or_path,
                            const std::filesystem::path& sequence_folder);

}  // namespace ofm
