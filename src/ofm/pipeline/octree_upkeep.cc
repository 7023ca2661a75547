#include "ofm/pipeline/octree_upkeep.h"

#include <limits>

namespace ofm {

OctreeUpkeep::OctreeUpkeep(const DenseOptions& options)
    : options_(options), settled_(options, Tolerance_m()), integrator_(options) {}

void OctreeUpkeep::Update(const KeyframeClouds& clouds, const KeyframePoseMap& world_from_camera) {
  is_whole_ = false;
  constexpr double kAnywhere_m = std::numeric_limits<double>::infinity();
  const IntegrationCounts counts = integrator_.Update(clouds, settled_.Update(world_from_camera),
                                                      credit_ >= 0 ? Tolerance_m() : kAnywhere_m);
  credit_ += static_cast<std::ptrdiff_t>(counts.added) -
             static_cast<std::ptrdiff_t>(counts.moved + counts.reintegrated);
  is_whole_ = true;
}

SemanticOctree OctreeUpkeep::Finish(const KeyframeClouds& clouds,
                                    const KeyframePoseMap& world_from_camera) {
  if (!is_whole_) integrator_ = OctreeIntegrator(options_);
  is_whole_ = false;
  integrator_.Update(clouds, world_from_camera, 0);
  is_whole_ = true;
  return integrator_.Take();
}

}  // namespace ofm
