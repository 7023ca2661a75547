// Where in the map is the camera, when nothing is known of it?
#pragma once

#include <optional>
#include <vector>

#include "ofm/tracking/pose_search.h"

namespace ofm {

/// Keyframes of the map that may show what the frame shows, each once: first those that look alike
/// (bags of words), then those about `last_reference` (invalid = nowhere), then some from all over
/// the map, others in each frame.
std::vector<KeyframeId> FindRelocalizationCandidates(const TrackingInput& input,
                                                     KeyframeId last_reference,
                                                     const RelocalizationOptions& options);

/// The frame's pose against the first candidate that at least options.min_relocalization_inliers of
/// the landmarks around agree with, as kRelocalized; empty where there is none. By descriptors and
/// RANSAC, then guided search (as published for ORB-SLAM, Mur-Artal et al. 2015, section V-D).
std::optional<TrackingResult> Relocalize(const PoseSearch& search, const TrackingInput& input,
                                         KeyframeId last_reference);

}  // namespace ofm
