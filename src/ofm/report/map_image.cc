#include "ofm/report/map_image.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <opencv2/imgcodecs.hpp>

#include "ofm/dense/label_color.h"

namespace ofm {
namespace {

constexpr double kLeastCell_m = 0.04, kHeadroom_m = 0.3;
constexpr int kMostCells = 500;     // along a side
constexpr double kTrimmed = 0.002;  // of the points, on each side: far strays would shrink the map
constexpr double kPointsPerCell = 2;  // wanted

struct FlatPoint {
  Eigen::Vector2d at;
  double height = 0;
  const LabelledPoint* point = nullptr;
};

double HighestCamera(const RunView& run, const PlanView& plan) {
  double highest = -std::numeric_limits<double>::infinity();
  for (const StampedPose& pose : run.trajectory) {
    highest = std::max(highest, plan.up.dot(pose.world_from_camera.translation()));
  }
  return std::isfinite(highest) ? highest : std::numeric_limits<double>::infinity();
}

std::vector<FlatPoint> Flatten(const LabelledCloud& cloud, const PlanView& plan,
                               const RunView& run) {
  const double most = HighestCamera(run, plan) + kHeadroom_m;
  std::vector<FlatPoint> flat;
  for (const LabelledPoint& point : cloud.points) {
    const Eigen::Vector3d place = run.report_from_run * point.position.cast<double>();
    const double height = plan.up.dot(place);
    if (height <= most) flat.push_back({plan(place), height, &point});
  }
  return flat;
}

/// The interval along `axis` without the outermost points.
Interval Trimmed(const std::vector<FlatPoint>& points, int axis) {
  std::vector<double> values;
  for (const FlatPoint& point : points) values.push_back(point.at[axis]);
  std::sort(values.begin(), values.end());
  const auto skipped = static_cast<std::size_t>(kTrimmed * static_cast<double>(values.size()));
  return Padded({values[skipped], values[values.size() - 1 - skipped]}, 0.01);
}

struct Cell {
  double height = -std::numeric_limits<double>::infinity();
  Rgb color;
  std::map<std::uint8_t, int> votes;
};

cv::Vec4b Paint(const Cell& cell) {
  Rgb color = cell.color;
  if (cell.votes.empty()) {
    const auto pale = [](std::uint8_t c) { return static_cast<std::uint8_t>(0.6 * c + 82); };
    color = {pale(color.r), pale(color.g), pale(color.b)};
  } else {
    const auto most =
        std::max_element(cell.votes.begin(), cell.votes.end(),
                         [](const auto& a, const auto& b) { return a.second < b.second; });
    color = LabelColor(most->first);
  }
  return {color.b, color.g, color.r, 255};
}

}  // namespace

std::optional<PlotImage> DrawMapFromAbove(const LabelledCloud& cloud, const PlanView& plan,
                                          const RunView& run) {
  const std::vector<FlatPoint> points = Flatten(cloud, plan, run);
  if (points.size() < 2) return {};
  PlotImage image{{}, Trimmed(points, 0), Trimmed(points, 1)};
  const double width_m = image.x.length(), height_m = image.y.length();
  const double cell_m = std::max(
      {kLeastCell_m, std::max(width_m, height_m) / kMostCells,
       std::sqrt(width_m * height_m * kPointsPerCell / static_cast<double>(points.size()))});
  const int columns = std::max(1, static_cast<int>(std::ceil(width_m / cell_m)));
  const int rows = std::max(1, static_cast<int>(std::ceil(height_m / cell_m)));
  image.x.max = image.x.min + columns * cell_m;
  image.y.max = image.y.min + rows * cell_m;
  std::vector<Cell> cells(static_cast<std::size_t>(columns) * rows);
  for (const FlatPoint& point : points) {
    const int column = static_cast<int>(std::floor((point.at.x() - image.x.min) / cell_m));
    const int row = static_cast<int>(std::floor((image.y.max - point.at.y()) / cell_m));
    if (column < 0 || row < 0 || column >= columns || row >= rows) continue;
    Cell& cell = cells[static_cast<std::size_t>(row) * columns + column];
    if (point.point->class_id != kNoLabel) ++cell.votes[point.point->class_id];
    if (point.height <= cell.height) continue;
    cell.height = point.height;
    cell.color = point.point->color;
  }
  cv::Mat picture(rows, columns, CV_8UC4, cv::Scalar::all(0));
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (std::isinf(cells[i].height)) continue;
    picture.at<cv::Vec4b>(static_cast<int>(i) / columns, static_cast<int>(i) % columns) =
        Paint(cells[i]);
  }
  cv::imencode(".png", picture, image.png);
  return image;
}

}  // namespace ofm
