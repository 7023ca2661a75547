#include "ofm/io/trajectory_file.h"

#include <fmt/format.h>

#include <iterator>

#include "ofm/base/time.h"
#include "ofm/io/atomic_file.h"
#include "ofm/io/table_file.h"

namespace ofm {
namespace {

constexpr std::string_view kColumns = "timestamp tx ty tz qx qy qz qw";

RigidTransform ReadPose(const TableFile& file, const TableFile::Row& row) {
  double values[7];
  for (std::size_t i = 0; i < 7; ++i) values[i] = file.Number(row, i + 1);
  const Eigen::Vector3d translation(values[0], values[1], values[2]);
  const Eigen::Quaterniond rotation(values[6], values[3], values[4], values[5]);
  if (rotation.norm() < 1e-6) file.Fail(row, "the quaternion qx qy qz qw is zero: no rotation");
  return {rotation, translation};
}

}  // namespace

Trajectory LoadTrajectory(const std::filesystem::path& path) {
  const TableFile file(path);
  Trajectory trajectory;
  trajectory.reserve(file.rows().size());
  StampOrder order;
  for (const TableFile::Row& row : file.rows()) {
    file.RequireColumns(row, kColumns);
    const std::int64_t stamp_ns = file.Stamp(row, 0);
    order.Require(file, row, stamp_ns);
    trajectory.push_back({stamp_ns, ReadPose(file, row)});
  }
  return trajectory;
}

std::string FormatTrajectory(const Trajectory& trajectory) {
  std::string text = fmt::format("# {} of world_from_camera [s, m, unit quaternion]\n", kColumns);
  for (const auto& [stamp_ns, pose] : trajectory) {
    const Eigen::Vector3d& t = pose.translation();
    const Eigen::Quaterniond& q = pose.rotation();
    fmt::format_to(std::back_inserter(text),
                   "{} {:.9f} {:.9f} {:.9f} {:.9f} {:.9f} {:.9f} {:.9f}\n", FormatSeconds(stamp_ns),
                   t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w());
  }
  return text;
}

void SaveTrajectory(const std::filesystem::path& path, const Trajectory& trajectory) {
  WriteFileAtomically(path, FormatTrajectory(trajectory));
}

}  // namespace ofm
