#include "ofm/pipeline/slam.h"

#include "ofm/base/error.h"
#include "ofm/features/vocabulary_file.h"
#include "ofm/map/submap.h"

namespace ofm {
namespace {

MeasurementModel MakeModel(const PinholeCamera& camera, const SlamOptions& options) {
  return {camera, OctaveScales(options.features.levels, options.features.scale_factor),
          options.measurement};
}

/// Without mapping there is nowhere to begin a sub-map.
TrackingOptions OptionsOfTracking(const SlamOptions& options) {
  TrackingOptions tracking = options.tracking;
  if (options.localize_only) tracking.submap.enabled = false;
  return tracking;
}

std::shared_ptr<const MapSnapshot> RequireMap(std::shared_ptr<const MapSnapshot> map,
                                              const SlamOptions& options) {
  const bool empty = !map || map->keyframe_count == 0;
  if (options.localize_only && empty) throw Error("localize_only needs a map: load one");
  if (map) return map;
  auto none = std::make_shared<MapSnapshot>();
  none->vocabulary = ResolveVocabulary(options);
  return none;
}

}  // namespace

std::shared_ptr<const Vocabulary> ResolveVocabulary(const SlamOptions& options) {
  if (options.vocabulary.empty()) return SharedDefaultVocabulary();
  return std::make_shared<const Vocabulary>(LoadVocabulary(options.vocabulary));
}

Slam::Slam(const PinholeCamera& camera, const SlamOptions& options,
           std::unique_ptr<Segmenter> segmenter, std::shared_ptr<const MapSnapshot> map)
    : camera_(camera),
      options_(options),
      model_(MakeModel(camera, options)),
      front_end_(camera, options, std::move(segmenter)),
      tracker_(model_, OptionsOfTracking(options), options.seed),
      mapper_(model_, options.mapping, *RequireMap(std::move(map), options)),
      loaded_submap_(mapper_.map().keyframes().size() > 0 ? LargestSubmap(*mapper_.Snapshot())
                                                          : SubmapId()),
      loop_closer_(model_, options.loop, options.seed, loaded_submap_),
      semantic_mapper_(camera, options.dense),
      object_mapper_(camera, options.objects,
                     ClassPolicies(options.dynamics, front_end_.class_names())) {}

}  // namespace ofm
