// A made result folder with everything that a report can show. Tests only.
#pragma once

#include <cmath>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <pugixml.hpp>
#include <string>

#include "ofm/dense/octree_file.h"
#include "ofm/dense/ply_file.h"
#include "ofm/io/test_folder.h"
#include "ofm/io/trajectory_file.h"
#include "ofm/objects/object_database.h"
#include "ofm/objects/test_inventory.h"
#include "ofm/pipeline/frame_table.h"

namespace ofm::test {

/// The names that files may bring into a page.
inline constexpr const char* kNastyName = "<script>alert('x')</script>&\"";

/// A camera that goes along a curve for `count` frames, 0.1 s apart, `offset_m` off in y.
inline Trajectory MadeTrajectory(int count, double offset_m) {
  Trajectory trajectory;
  for (int i = 0; i < count; ++i) {
    const double t = 0.1 * i;
    trajectory.push_back(
        {1'000'000'000'000 + i * 100'000'000LL,
         {ExpSo3({0, 0.1 * t, 0}), {std::sin(t), offset_m * std::sin(9 * t), 0.2 * t}}});
  }
  return trajectory;
}

/// A floor and a box, the box of class 1.
inline std::vector<LabelledPoint> MadeCloud() {
  std::vector<LabelledPoint> cloud;
  for (int x = -20; x < 20; ++x) {
    for (int z = 0; z < 40; ++z) {
      const bool is_box = x > 5 && z > 20;
      cloud.push_back({{.05F * x, is_box ? .5F : 1.F, .05F * z},
                       {200, 180, static_cast<std::uint8_t>(4 * z)},
                       is_box ? std::uint8_t(1) : kNoLabel,
                       255});
    }
  }
  return cloud;
}

inline std::string MadeSummary() {
  return R"({"version": "0.1", "input": "/nowhere/<desk>", "runner": "sequential", "seed": 3,
  "error": null, "counts": {"frames": 60, "frames_tracked": 60, "losses": 0, "keyframes": 6,
  "landmarks": 1234, "mean_masked_share": 0.25}, "loops": {"closed": 1},
  "submaps": {"unjoined": []}, "wall_s": 2.5, "process_cpu_s": 3.0, "peak_memory_mib": 150.5,
  "stages": {"tracking": {"cpu": {"count": 60, "median_ms": 2.5, "p99_ms": 6.0, "max_ms": 7.0}},
  "features": {"cpu": {"count": 60, "median_ms": 4.0, "p99_ms": 5.0, "max_ms": 7.0}}}})";
}

/// Writes all files of a run of 60 frames into `folder`.
inline void WriteMadeResults(const std::filesystem::path& folder, double offset_m = 0.01) {
  std::filesystem::create_directories(folder / "keyframes");
  const Trajectory trajectory = MadeTrajectory(60, offset_m);
  SaveTrajectory(folder / "trajectory.txt", trajectory);
  SaveTrajectory(folder / "trajectory_live.txt", trajectory);
  SaveTrajectory(folder / "keyframes.txt", {trajectory.begin(), trajectory.begin() + 6});
  std::ofstream(folder / "summary.json") << MadeSummary();
  std::vector<FrameRecord> frames;
  StageTimes times;
  for (const StampedPose& pose : trajectory) {
    frames.push_back({pose.stamp_ns, TrackingStatus::kTracked, false, 0.25, 1, 700, 100});
    times.Add("tracking", 3, 2.5);
  }
  std::ofstream(folder / "frames.csv") << FormatFrames(frames);
  std::ofstream(folder / "times.csv") << FormatFrameTimes(TimesOfFrames(frames, times));
  const std::vector<LabelledPoint> cloud = MadeCloud();
  const std::vector<std::string> names = {"person", kNastyName, "cup", "book"};
  std::ofstream ply(folder / "map.ply"), tree(folder / "map.ot"), labels(folder / "map_labels.csv");
  WritePly(ply, cloud, names);
  SemanticOctree octree(0.1, {});
  octree.InsertScan({{.01F, -1.F, .01F}, cloud, {}});
  WriteColorOcTree(tree, octree);
  WriteVoxelLabels(labels, octree, names);
  ObjectInventory inventory = MadeInventory();
  inventory.class_names[1] = kNastyName;
  SaveObjects(folder / "objects.db", inventory);
  cv::imwrite((folder / "keyframes" / "1000.500000.jpg").string(),
              cv::Mat(18, 24, CV_8UC3, cv::Scalar(9, 90, 200)));
}

/// The truth of the made runs, as a file in `folder`.
inline std::filesystem::path WriteMadeTruth(const std::filesystem::path& folder) {
  SaveTrajectory(folder / "truth.txt", MadeTrajectory(60, 0));
  return folder / "truth.txt";
}

/// How many elements of a name there are in well-formed XML; -1 where it is none.
inline int CountElements(const std::string& xml, const char* name) {
  pugi::xml_document document;
  if (!document.load_string(xml.c_str())) return -1;
  return static_cast<int>(document.select_nodes((std::string("//") + name).c_str()).size());
}

}  // namespace ofm::test
