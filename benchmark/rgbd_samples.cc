#include "rgbd_samples.h"

#include <opencv2/imgproc.hpp>

#include "ofm/base/random.h"
#include "ofm/io/trajectory_file.h"

namespace ofm {
namespace {

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

RgbdSampleSource::RgbdSampleSource(const std::filesystem::path& folder, const PinholeCamera& camera)
    : camera_(camera) {
  if (std::filesystem::exists(folder)) {
    ReadFolder(folder);
  } else {
    camera_ = PinholeCamera();
    texture_ = MakeTexture();
    MakeSyntheticPoses();
  }
}

void RgbdSampleSource::ReadFolder(const std::filesystem::path& folder) {
  constexpr std::int64_t kMaxGap_ns = 50'000'000;
  sequence_.emplace(folder, camera_);
  const Trajectory truth = LoadTrajectory(folder / "groundtruth.txt");
  for (std::size_t i = 0; i < sequence_->size(); ++i) {
    const std::int64_t stamp_ns = sequence_->entries()[i].color.stamp_ns;
    const auto pose = InterpolatePose(truth, stamp_ns, kMaxGap_ns);
    if (pose) entries_.push_back({i, stamp_ns, *pose});
  }
}

void RgbdSampleSource::MakeSyntheticPoses() {
  for (std::size_t i = 0; i < 60; ++i) {
    const double t = static_cast<double>(i) / 30;
    const Eigen::Vector3d axis_angle(0.1 * std::sin(t), 0.15 * std::sin(1.3 * t), 0.4 * t);
    entries_.push_back({i,
                        static_cast<std::int64_t>(i) * 1'000'000'000 / 30,
                        {ExpSo3(axis_angle), Eigen::Vector3d(0.3 * t, 0.1 * t, 0.2 * t)}});
  }
}

RgbdSample RgbdSampleSource::Read(int index) const {
  const Entry& entry = entries_.at(index);
  if (!sequence_) {
    RgbdSample sample = RenderWall(texture_, camera_, entry.world_from_camera);
    sample.stamp_ns = entry.stamp_ns;
    return sample;
  }
  const RgbdFrame frame = sequence_->Load(entry.frame);
  return {entry.stamp_ns, frame.gray, frame.depth_m, entry.world_from_camera};
}

}  // namespace ofm
