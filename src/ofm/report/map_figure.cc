#include "ofm/report/map_figure.h"

#include <fmt/format.h>

#include <set>

#include "ofm/report/map_image.h"

namespace ofm {
namespace {

/// The four lower corners of a box, as the plan shows them.
PlotOutline FootprintOf(const OrientedBox& box, const RunView& run, const PlanView& plan) {
  PlotOutline outline;
  for (const auto& [x, y] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
    const Eigen::Vector3d corner =
        box.center_in_world +
        box.world_from_box * Eigen::Vector3d(.5 * x * box.size_m.x(), .5 * y * box.size_m.y(), 0);
    outline.corners.push_back(plan(run.report_from_run * corner));
  }
  return outline;
}

void AddObjects(const ReportData& data, const RunView& run, Plot& plot) {
  if (!run.record.objects) return;
  const ObjectInventory& inventory = *run.record.objects;
  for (const SceneObject& object : inventory.objects) {
    plot.outlines.push_back(FootprintOf(object.box, run, data.plan));
    const std::uint32_t id = object.class_id().value;
    plot.labels.push_back(
        {data.plan(run.report_from_run * object.box.center_in_world),
         id < inventory.class_names.size() ? inventory.class_names[id] : std::string("?")});
  }
}

Plot PlotMap(const ReportData& data, std::size_t index, PlotImage image) {
  const RunView& run = data.runs[index];
  Plot plot;
  plot.title = fmt::format("Semantic map from above: {}", run.record.name);
  plot.description =
      "The static scene's points, coloured by class where they have one, the boxes "
      "of objects, and the camera's path.";
  plot.x_label = data.plan.x_label, plot.y_label = data.plan.y_label;
  plot.shape = PlotShape::kEqualScales;
  plot.image = std::move(image);
  PlotSeries path{"", fmt::format("run{}", index), SeriesStyle::kLine, {}};
  for (const StampedPose& pose : run.trajectory) {
    path.points.push_back(data.plan(pose.world_from_camera.translation()));
  }
  plot.series.push_back(std::move(path));
  AddObjects(data, run, plot);
  return plot;
}

}  // namespace

Figure MapFigure(const ReportData& data) {
  Figure figure;
  for (std::size_t i = 0; i < data.runs.size(); ++i) {
    const RunRecord& record = data.runs[i].record;
    if (!record.cloud) {
      figure.missing.push_back(record.name +
                               ": has no map.ply; run with --set build_semantic_map=true.");
      continue;
    }
    std::optional<PlotImage> image = DrawMapFromAbove(*record.cloud, data.plan, data.runs[i]);
    if (!image) {
      figure.missing.push_back(record.name + ": its map.ply has no point.");
      continue;
    }
    figure.plots.push_back(PlotMap(data, i, std::move(*image)));
  }
  return figure;
}

std::map<int, std::string> ClassesShown(const ReportData& data) {
  std::map<int, std::string> names;
  std::set<int> seen;
  for (const RunView& run : data.runs) {
    if (run.record.cloud) {
      names.insert(run.record.cloud->class_names.begin(), run.record.cloud->class_names.end());
      for (const LabelledPoint& point : run.record.cloud->points) seen.insert(point.class_id);
    }
    if (!run.record.voxels) continue;
    for (const LabelledVoxel& voxel : run.record.voxels->voxels) seen.insert(voxel.class_id);
  }
  seen.erase(kNoLabel);
  std::map<int, std::string> shown;
  for (const int id : seen) {
    const auto name = names.find(id);
    shown[id] = name == names.end() ? fmt::format("class {}", id) : name->second;
  }
  return shown;
}

}  // namespace ofm
