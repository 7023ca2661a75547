// Settings of the semantic map.
#pragma once

#include <array>
#include <string_view>
#include <utility>

#include "ofm/base/options.h"

namespace ofm {

/// Which pixels of a key frame are mapped, and how finely.
struct KeyframeCloudOptions {
  double edge_sigmas = 8;             ///< depth step that is an edge [depth sigmas]
  int min_measured_pixels = 6;        ///< of the 3 x 3 around a pixel, itself included
  int view_stride = 1;                ///< frames from one view of a cloud to the next; 0 = none
  int mask_dilation_px = 4;           ///< dropped around what moves, whatever its depth
  int mask_margin_px = 8;             ///< dropped around what moves where the depth is alike
  double mask_margin_depth_m = 0.2;   ///< how alike
  double unlabelled_confidence = .5;  ///< what "no label" counts, as a label's confidence

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("edge_sigmas", self.edge_sigmas, "depth step that is an edge [depth sigmas]",
          Range{1, 1000});
    visit("min_measured_pixels", self.min_measured_pixels,
          "pixels with depth that a mapped pixel's 3 x 3 must hold", Range{1, 9});
    visit("view_stride", self.view_stride,
          "between key frames every so many frames add what they see to the next one's cloud; 0 = "
          "none do",
          Range{0, 1000});
    visit("mask_dilation_px", self.mask_dilation_px,
          "pixels dropped around what moves, whatever their depth", Range{0, 100});
    visit("mask_margin_px", self.mask_margin_px,
          "pixels dropped around what moves where their depth is alike", Range{0, 100});
    visit("mask_margin_depth_m", self.mask_margin_depth_m,
          "depth difference that counts as alike [m]", Range{0, 10});
    visit("unlabelled_confidence", self.unlabelled_confidence,
          "a pixel without label counts like a label of this confidence", Range{0, 1});
  }
};

/// The inverse sensor model; the defaults are OctoMap's (Hornung et al., Autonomous Robots 2013).
struct OccupancyOptions {
  double probability_hit = .7;     ///< of a voxel that a ray ends in
  double probability_miss = .4;    ///< of a voxel that a ray crosses
  double probability_min = .1192;  ///< lower clamp
  double probability_max = .971;   ///< upper clamp
  bool spare_neighbours = true;    ///< of a scan's hits: its rays do not free them

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("probability_hit", self.probability_hit, "occupancy of a voxel that a ray ends in",
          Range{.501, .999});
    visit("probability_miss", self.probability_miss, "occupancy of a voxel that a ray crosses",
          Range{.001, .499});
    visit("probability_min", self.probability_min, "lowest occupancy", Range{.0001, .499});
    visit("probability_max", self.probability_max, "highest occupancy", Range{.501, .9999});
    visit("spare_neighbours", self.spare_neighbours,
          "rays do not free the neighbours of voxels that their own scan hits; OctoMap's do");
  }
};

/// What may be a piece of somebody that no mask covers: see passing_voxels.h.
struct PassingOptions {
  double min_seen_s = 1;       ///< what was seen for so long is none; 0 = nothing is
  int max_hits = 2;            ///< nor is what has more log-odds than so many hits give
  double border_share = .025;  ///< of the image's width: along its border masks end too early

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("min_seen_s", self.min_seen_s,
          "what is over or under somebody who moves, or seen at the image's border alone, is not "
          "mapped unless it was seen for so long [s]; 0 = all is",
          Range{0, 1000});
    visit("max_hits", self.max_hits, "nor unless it is surer than so many hits make it",
          Range{1, 100});
    visit("border_share", self.border_share, "width of the border [share of the image's width]",
          Range{0, .45});
  }
};

/// What counts as a floor.
struct FloorOptions {
  double max_tilt_deg = 50;        ///< against what the cameras think is up, on average
  double min_area_m2 = .5;         ///< that must have been seen
  double max_share_beneath = .02;  ///< of the occupied voxels

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("max_tilt_deg", self.max_tilt_deg,
          "tilt against what the cameras think is up, on average [deg]", Range{0, 90});
    visit("min_area_m2", self.min_area_m2, "floor that must have been seen [m^2]", Range{0, 1e4});
    visit("max_share_beneath", self.max_share_beneath,
          "share of the occupied voxels that may lie beneath a floor", Range{0, 1});
  }
};

/// The 2-D occupancy grid.
struct NavigationOptions {
  double min_height_m = .1;   ///< over the floor; lower things are driven over
  double max_height_m = 1.5;  ///< higher things are driven under
  FloorOptions floor;

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("min_height_m", self.min_height_m, "height over the floor from which things obstruct [m]",
          Range{0, 10});
    visit("max_height_m", self.max_height_m,
          "height over the floor up to which things obstruct [m]", Range{0, 100});
    visit("floor", self.floor);
  }
};

/// Frames without what moved in them.
struct InpaintingOptions {
  int keyframes_before = 8, keyframes_after = 8;  ///< that fill a frame
  double agreement_sigmas = 4;     ///< depths nearer than this show one surface [depth sigmas]
  double min_agreeing_share = .3;  ///< of the keyframes that show a pixel; the nearest such wins

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("keyframes_before", self.keyframes_before, "keyframes before a frame that fill it",
          Range{0, 1000});
    visit("keyframes_after", self.keyframes_after, "keyframes after a frame that fill it",
          Range{0, 1000});
    visit("agreement_sigmas", self.agreement_sigmas,
          "depths nearer than this show one surface [depth sigmas]", Range{.1, 100});
    visit("min_agreeing_share", self.min_agreeing_share,
          "share of the keyframes that see a pixel and must agree on a surface", Range{0, 1});
  }
};

/// What the colours of a map tell.
enum class MapColor { kAppearance, kLabel };

inline EnumNameList<MapColor> EnumNames(MapColor) {
  static constexpr std::array<std::pair<MapColor, std::string_view>, 2> kNames{
      {{MapColor::kAppearance, "appearance"}, {MapColor::kLabel, "label"}}};
  return kNames;
}

/// When the octree is brought up to date.
enum class OctreeUpkeepTime { kWhileRunning, kAtEnd };

inline EnumNameList<OctreeUpkeepTime> EnumNames(OctreeUpkeepTime) {
  static constexpr std::array<std::pair<OctreeUpkeepTime, std::string_view>, 2> kNames{
      {{OctreeUpkeepTime::kWhileRunning, "while_running"}, {OctreeUpkeepTime::kAtEnd, "at_end"}}};
  return kNames;
}

/// How the octree is made and written.
struct OctreeOptions {
  OctreeUpkeepTime upkeep = OctreeUpkeepTime::kWhileRunning;
  MapColor color = MapColor::kAppearance;

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("upkeep", self.upkeep, "when key frames go into the octree");
    visit("color", self.color, "what the colours of map.ot show");
  }
};

enum class CloudFormat { kPly, kPcd, kBoth };

inline EnumNameList<CloudFormat> EnumNames(CloudFormat) {
  static constexpr std::array<std::pair<CloudFormat, std::string_view>, 3> kNames{
      {{CloudFormat::kPly, "ply"}, {CloudFormat::kPcd, "pcd"}, {CloudFormat::kBoth, "both"}}};
  return kNames;
}

/// How the cloud is written.
struct CloudFileOptions {
  CloudFormat format = CloudFormat::kPly;
  MapColor color = MapColor::kAppearance;

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("format", self.format, "which of map.ply and map.pcd to write");
    visit("color", self.color, "what the colours of the cloud show");
  }
};

struct DenseOptions {
  double resolution_m = .05;       ///< side of an octree voxel
  double range_m = 5;              ///< farther points only free the space before them
  int cloud_points_per_voxel = 2;  ///< cloud points along a voxel's side
  int max_spare_clouds = 1000;     ///< held of key frames that the map has let go
  KeyframeCloudOptions cloud;
  OccupancyOptions occupancy;
  PassingOptions passing;
  OctreeOptions octree;
  CloudFileOptions cloud_file;
  NavigationOptions navigation;
  InpaintingOptions inpainting;

  /// Side of a cloud voxel [m].
  double CloudResolution() const { return resolution_m / cloud_points_per_voxel; }
  /// Of an observation: what one point says of its voxel's label. A view of a surface puts this
  /// many points into a voxel, and they are of one mask.
  double LabelShare() const { return 1. / (cloud_points_per_voxel * cloud_points_per_voxel); }

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("resolution_m", self.resolution_m, "side of an octree voxel [m]", Range{.005, 1});
    visit("range_m", self.range_m, "farther points only free the space before them [m]",
          Range{.1, 50});
    visit("cloud_points_per_voxel", self.cloud_points_per_voxel,
          "points of the cloud along an octree voxel's side", Range{1, 8});
    visit("max_spare_clouds", self.max_spare_clouds,
          "clouds held of key frames that the map has let go; over it the oldest go",
          Range{0, 10000000});
    visit("cloud", self.cloud);
    visit("occupancy", self.occupancy);
    visit("passing", self.passing);
    visit("octree", self.octree);
    visit("cloud_file", self.cloud_file);
    visit("navigation", self.navigation);
    visit("inpainting", self.inpainting);
  }
};

/// Throws Error that names the field where a value is outside its range.
void CheckOptions(const DenseOptions& options);

}  // namespace ofm
