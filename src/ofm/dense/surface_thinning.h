// From the thick shell that noise makes of a surface to the surface.
#pragma once

#include <span>
#include <vector>

#include "ofm/dense/voxel_filter.h"

namespace ofm {

/// Noise of depth and poses spreads a surface over several voxels along the line of sight. Each
/// point is moved along the mean line of sight of its voxel to where most was measured: by mean
/// shift (Comaniciu and Meer, "Mean shift", PAMI 2002) over the voxels on that line, weighted by
/// their precision, with a Gaussian kernel of 1.5 voxels or twice the depth's standard deviation.
/// Then one point per voxel is left: the mean of the points that came into it, with colour, label
/// and instance of the one with most precision. `voxels` are those of a filter of `resolution_m`;
/// the result is in their order.
std::vector<LabelledPoint> ThinSurfaces(std::span<const FusedVoxel> voxels, double resolution_m);

}  // namespace ofm
