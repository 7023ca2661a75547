// Maps in files; docs/map_file.md describes the format.
#pragma once

#include <filesystem>
#include <memory>

#include "ofm/base/options.h"
#include "ofm/camera/pinhole_camera.h"
#include "ofm/map/map.h"

namespace ofm {

/// What the contents of a map depend on. Who goes on with it must have the same.
struct MapSettings {
  PinholeCamera camera;
  int levels = 8;             ///< of the image pyramid
  double scale_factor = 1.2;  ///< between its levels

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("camera", self.camera);
    visit("features.levels", self.levels, "levels of the image pyramid", Range{1, 255});
    visit("features.scale_factor", self.scale_factor, "scale between levels", Range{1, 100});
  }
};

/// A map as a file holds it.
struct StoredMap {
  MapSettings settings;
  std::shared_ptr<const MapSnapshot> map;
};

/// Of the format; a file of another one is not read.
inline constexpr int kMapFileVersion = 2;

/// Writes the map in one step (WriteFileAtomically): an older file at `path` stays whole whatever
/// happens. The same map gives the same bytes. Of keyframes all is kept but their frames' ids,
/// which mean something to one run alone. Throws Error for a map without keyframes, and where the
/// file cannot be written.
void SaveMap(const std::filesystem::path& path, const MapSnapshot& map,
             const MapSettings& settings);

/// Throws Error for a file that is missing, is no map, is of another version, or in which one byte
/// is not what was written. The keyframes' words are not stored: `vocabulary` makes them anew.
StoredMap LoadMap(const std::filesystem::path& path,
                  std::shared_ptr<const Vocabulary> vocabulary = SharedDefaultVocabulary());

/// Throws Error that names the first setting in which the map at `path` and those who want to go on
/// with it differ. The scale and delay of depth images may: the map is in metres.
void RequireSameSettings(const std::filesystem::path& path, MapSettings stored, MapSettings wanted);

}  // namespace ofm
