// Everything that can be set, in one tree: the configuration file's structure.
#pragma once

#include <cstdint>
#include <string>

#include "ofm/base/options.h"
#include "ofm/dense/dense_options.h"
#include "ofm/dynamics/dynamics_options.h"
#include "ofm/features/orb_extractor.h"
#include "ofm/loop/options.h"
#include "ofm/mapping/options.h"
#include "ofm/objects/object_options.h"
#include "ofm/perception/perception_options.h"
#include "ofm/tracking/measurement.h"
#include "ofm/tracking/options.h"

namespace ofm {

struct SlamOptions {
  std::uint64_t seed = 0;  ///< of every random draw
  bool build_semantic_map = true;
  bool build_objects = true;     ///< where there is a segmenter
  bool final_adjustment = true;  ///< bundle adjustment over all keyframes at the end
  bool localize_only = false;    ///< no mapping: the camera is followed in a map that was loaded
  std::string vocabulary = {};   ///< file that places are recognised by; empty = the built-in one
  int keyframe_images = 24;      ///< most small pictures of keyframes that are kept; 0 = none
  PerceptionOptions perception;
  DynamicsOptions dynamics;
  OrbOptions features;
  MeasurementOptions measurement;
  TrackingOptions tracking;
  MappingOptions mapping;
  LoopOptions loop;
  DenseOptions dense;
  ObjectOptions objects;

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("seed", self.seed, "of every random draw", Range{0, 1e15});
    visit("build_semantic_map", self.build_semantic_map, "make map.ply, map.ot and map.bt");
    visit("build_objects", self.build_objects,
          "make objects.db and objects.json, where there is a segmenter");
    visit("final_adjustment", self.final_adjustment,
          "bundle adjustment over all keyframes at the end");
    visit("localize_only", self.localize_only,
          "no mapping: the camera is followed in a map that was loaded");
    visit("vocabulary", self.vocabulary,
          "file that places are recognised by (ofm-slam vocabulary); empty = the built-in one");
    visit("keyframe_images", self.keyframe_images,
          "most small pictures of keyframes that are kept, for the report; 0 = none",
          Range{0, 1000});
    visit("perception", self.perception);
    visit("dynamics", self.dynamics);
    visit("features", self.features);
    visit("measurement", self.measurement);
    visit("tracking", self.tracking);
    visit("mapping", self.mapping);
    visit("loop", self.loop);
    visit("dense", self.dense);
    visit("objects", self.objects);
  }
};

}  // namespace ofm
