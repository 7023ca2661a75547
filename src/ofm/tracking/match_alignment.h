// Places of matched features to a small part of a pixel.
#pragma once

#include <memory>
#include <span>

#include "ofm/tracking/frame_matcher.h"
#include "ofm/tracking/measurement.h"

namespace ofm {

/// The features of `view`, those of `matches` where the keyframes that made their landmarks, laid
/// over them, put them. Those that do not fit stay where they are. The view's pose is good to a few
/// pixels.
std::shared_ptr<FrameFeatures> AlignMatches(const MeasurementModel& model,
                                            const PatchAlignmentOptions& options,
                                            const MapSnapshot& map, const FrameView& view,
                                            std::span<const PointMatch> matches);

/// How well the aligned features of `view` lie, by how well they agree with its pose: their noise
/// over that of corners, at most 1. 1 where there are too few to tell.
double MeasureAlignedNoise(const MeasurementModel& model, const MatchAlignmentOptions& options,
                           const FrameView& view, std::span<const PointMatch> matches);

/// How well the depth of `view` agrees with the map: its noise over
/// measurement.inverse_depth_sigma, at most 1. Depth is trusted more only where the aligned
/// features agree with the pose (their noise was measured before; from twice the least noise on the
/// result is 1): what displaces them (blur, a rolling shutter, images of different times) displaces
/// depth too, for many features alike, which a typical residual does not show. 1 where there are
/// too few to tell.
double MeasureDepthNoise(const MeasurementModel& model, const MatchAlignmentOptions& options,
                         const FrameView& view, std::span<const PointMatch> matches);

}  // namespace ofm
