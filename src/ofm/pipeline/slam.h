// The stages of the system, wired together but not yet run: a runner decides about threads.
#pragma once

#include <memory>

#include "ofm/dense/semantic_mapper.h"
#include "ofm/loop/loop_closer.h"
#include "ofm/mapping/mapper.h"
#include "ofm/objects/object_mapper.h"
#include "ofm/pipeline/front_end.h"
#include "ofm/pipeline/options.h"
#include "ofm/tracking/tracker.h"

namespace ofm {

/// By which the places of a new map are recognised, and those of a loaded one are to be: that of
/// options.vocabulary, or the built-in one. Throws Error where the file is none. Never null.
std::shared_ptr<const Vocabulary> ResolveVocabulary(const SlamOptions& options);

/// One SLAM system. Several in one process do not notice one another. Each stage serves the one
/// thread that its runner gives it.
class Slam {
 public:
  /// Goes on with `map`, where there is one: it must be of the same camera and of the same pyramid,
  /// and its vocabulary counts. Throws Error where there is none and options.localize_only, or
  /// where ResolveVocabulary does.
  Slam(const PinholeCamera& camera, const SlamOptions& options,
       std::unique_ptr<Segmenter> segmenter, std::shared_ptr<const MapSnapshot> map = nullptr);

  FrontEnd& front_end() { return front_end_; }
  Tracker& tracker() { return tracker_; }
  Mapper& mapper() { return mapper_; }
  LoopCloser& loop_closer() { return loop_closer_; }
  SemanticMapper& semantic_mapper() { return semantic_mapper_; }
  ObjectMapper& object_mapper() { return object_mapper_; }
  /// True where the run makes objects: it maps, and its segmenter knows classes.
  bool makes_objects() const {
    return options_.build_objects && !options_.localize_only && !front_end_.class_names().empty();
  }
  const SlamOptions& options() const { return options_; }
  /// The largest sub-map of the map that was given, whose world stays; invalid where there is none.
  SubmapId loaded_submap() const { return loaded_submap_; }
  const PinholeCamera& camera() const { return camera_; }
  const MeasurementModel& model() const { return model_; }

 private:
  PinholeCamera camera_;
  SlamOptions options_;
  MeasurementModel model_;
  FrontEnd front_end_;
  Tracker tracker_;
  Mapper mapper_;
  SubmapId loaded_submap_;
  LoopCloser loop_closer_;
  SemanticMapper semantic_mapper_;
  ObjectMapper object_mapper_;
};

}  // namespace ofm
