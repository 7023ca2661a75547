#include "ofm/pipeline/slam.h"

#include "ofm/features/default_vocabulary.h"

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
      model_(MakeModel(camera, options)),
      front_end_(camera, options, std::move(segmenter)),
      tracker_(model_, options.tracking, options.seed),
      mapper_(model_, options.mapping),
      loop_closer_(model_, options.loop, DefaultVocabulary(), options.seed),
      semantic_mapper_(camera, options.dense) {}

}  // namespace ofm
