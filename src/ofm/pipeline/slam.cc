#include "ofm/pipeline/slam.h"

namespace ofm {
namespace {

MeasurementModel MakeModel(const PinholeCamera& camera, const SlamOptions& options) {
  return {camera, OctaveScales(options.features.levels, options.features.scale_factor),
          options.measurement};
}

}  // namespace

Slam::Slam(const PinholeCamera& camera, const SlamOptions& options,
           std::unique_ptr<Segmenter> segmenter)
    : camera_(camera),
      options_(options),
      front_end_(camera, options, std::move(segmenter)),
      tracker_(MakeModel(camera, options), options.tracking, options.seed),
      mapper_(MakeModel(camera, options), options.mapping),
      semantic_mapper_(camera, options.dense) {}

}  // namespace ofm
