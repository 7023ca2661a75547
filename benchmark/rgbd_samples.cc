#include "rgbd_samples.h"

#include <fstream>
#include <map>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <sstream>

#include "ofm/base/random.h"

namespace ofm {
namespace {

using PosesByTime = std::map<double, RigidTransform>;

PosesByTime ReadPoses(const std::string& path) {
  PosesByTime poses;
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    std::istringstream fields(line);
    double time, x, y, z, qx, qy, qz, qw;
    if (fields >> time >> x >> y >> z >> qx >> qy >> qz >> qw) {
      poses.emplace(time,
                    RigidTransform(Eigen::Quaterniond(qw, qx, qy, qz), Eigen::Vector3d(x, y, z)));
    }
  }
  return poses;
}

/// Interpolated; false outside the recorded time.
bool PoseAt(const PosesByTime& poses, double time, RigidTransform& pose) {
  const auto after = poses.lower_bound(time);
  if (after == poses.begin() || after == poses.end()) return false;
  const auto before = std::prev(after);
  if (after->first - before->first > 0.05) return false;
  pose = Interpolate(before->second, after->second,
                     (time - before->first) / (after->first - before->first));
  return true;
}

constexpr double kWallDistance_m = 1.5;
constexpr double kTexelsPerMetre = 400;

/// Rectangles and discs of any grey, smoothed a little.
cv::Mat MakeTexture() {
  cv::Mat texture(2048, 2048, CV_8UC1, cv::Scalar(128));
  RandomEngine engine = MakeRandomEngine(1, 0);
  const auto draw = [&](int bound) { return static_cast<int>(UniformIndex(engine, bound)); };
  for (int i = 0; i < 6000; ++i) {
    const cv::Point corner(draw(2048), draw(2048));
    if (i % 3 == 0) {
      cv::circle(texture, corner, 3 + draw(20), draw(256), cv::FILLED);
    } else {
      const cv::Size size(4 + draw(50), 4 + draw(50));
      cv::rectangle(texture, {corner, size}, draw(256), cv::FILLED);
    }
  }
  cv::GaussianBlur(texture, texture, {}, 1.0);
  return texture;
}

/// The wall z = kWallDistance_m seen by a camera without distortion.
RgbdSample RenderWall(const cv::Mat& texture, const PinholeCamera& camera,
                      const RigidTransform& world_from_camera) {
  RgbdSample sample;
  sample.world_from_camera = world_from_camera;
  sample.depth_m.create(camera.height, camera.width, CV_32FC1);
  cv::Mat texels(camera.height, camera.width, CV_32FC2);
  for (int y = 0; y < camera.height; ++y) {
    for (int x = 0; x < camera.width; ++x) {
      const Eigen::Vector3d ray = world_from_camera.rotation() * camera.UnprojectIdeal({x, y}, 1.0);
      const Eigen::Vector3d& origin = world_from_camera.translation();
      const double depth = (kWallDistance_m - origin.z()) / ray.z();
      const Eigen::Vector3d hit = origin + depth * ray;
      sample.depth_m.at<float>(y, x) = static_cast<float>(depth);
      texels.at<cv::Vec2f>(y, x) = {static_cast<float>(hit.x() * kTexelsPerMetre + 1024),
                                    static_cast<float>(hit.y() * kTexelsPerMetre + 1024)};
    }
  }
  cv::remap(texture, sample.gray, texels, {}, cv::INTER_LINEAR, cv::BORDER_REFLECT);
  return sample;
}

}  // namespace

RgbdSampleSource::RgbdSampleSource(const std::string& folder, const PinholeCamera& camera)
    : camera_(camera) {
  is_real_ = ReadFolder(folder);
  if (is_real_) return;
  camera_ = PinholeCamera();
  texture_ = MakeTexture();
  MakeSyntheticPoses();
}

bool RgbdSampleSource::ReadFolder(const std::string& folder) {
  const PosesByTime poses = ReadPoses(folder + "/groundtruth.txt");
  std::ifstream file(folder + "/associations.txt");
  for (std::string line; std::getline(file, line);) {
    std::istringstream fields(line);
    double color_time, depth_time;
    Entry entry;
    if (!(fields >> color_time >> entry.color_path >> depth_time >> entry.depth_path)) continue;
    if (!PoseAt(poses, color_time, entry.world_from_camera)) continue;
    entry.color_path = folder + "/" + entry.color_path;
    entry.depth_path = folder + "/" + entry.depth_path;
    entries_.push_back(entry);
  }
  return !entries_.empty();
}

void RgbdSampleSource::MakeSyntheticPoses() {
  for (int i = 0; i < 60; ++i) {
    const double t = i / 30.0;
    const Eigen::Vector3d axis_angle(0.1 * std::sin(t), 0.15 * std::sin(1.3 * t), 0.4 * t);
    entries_.push_back({"", "", {ExpSo3(axis_angle), Eigen::Vector3d(0.3 * t, 0.1 * t, 0.2 * t)}});
  }
}

RgbdSample RgbdSampleSource::Read(int index) const {
  const Entry& entry = entries_.at(index);
  if (!is_real_) return RenderWall(texture_, camera_, entry.world_from_camera);
  RgbdSample sample;
  sample.world_from_camera = entry.world_from_camera;
  sample.gray = cv::imread(entry.color_path, cv::IMREAD_GRAYSCALE);
  cv::imread(entry.depth_path, cv::IMREAD_UNCHANGED)
      .convertTo(sample.depth_m, CV_32F, 1.0 / camera_.depth_scale);
  return sample;
}

}  // namespace ofm
