// Plots as data: what is drawn, not how.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "ofm/report/axis_scale.h"

namespace ofm {

enum class SeriesStyle { kLine, kDashed, kDots };

/// A line, or dots, with a name for the legend.
struct PlotSeries {
  std::string name;   ///< empty: not in the legend
  std::string color;  ///< a class of plot.css: "run0" to "run5", "truth", "mark"
  SeriesStyle style = SeriesStyle::kLine;
  /// In the axes' units; a value that is not finite breaks the line.
  std::vector<Eigen::Vector2d> points;
};

/// A word at a place.
struct PlotLabel {
  Eigen::Vector2d at = {0, 0};
  std::string text;
};

/// A closed outline.
struct PlotOutline {
  std::vector<Eigen::Vector2d> corners;
};

/// A PNG that fills a rectangle of the axes' plane, under all else.
struct PlotImage {
  std::vector<unsigned char> png;
  Interval x, y;
};

enum class PlotShape {
  kFree,         ///< each axis fills its side
  kEqualScales,  ///< a metre is as long on both axes
};

enum class PlotBaseline {
  kData,  ///< the vertical axis spans the data
  kZero,  ///< it begins at 0, or ends there
};

/// Lines and dots over two axes.
struct Plot {
  std::string title;
  std::string description;       ///< for who cannot see it: what it shows, with its main figures
  std::string x_label, y_label;  ///< with units
  PlotShape shape = PlotShape::kFree;
  PlotBaseline baseline = PlotBaseline::kData;
  std::vector<PlotSeries> series;
  std::vector<PlotLabel> labels;
  std::vector<PlotOutline> outlines;
  std::optional<PlotImage> image;
};

/// A row of a bar chart: a bar for each run, with a whisker.
struct BarGroup {
  std::string name;
  struct Bar {
    std::size_t run = 0;  ///< index into BarChart::runs
    double value = 0, whisker = 0;
  };
  std::vector<Bar> bars;
};

struct BarChart {
  std::string title, description, x_label;
  std::vector<std::string> runs;  ///< names; bar i has the colour "run<i>"
  std::vector<BarGroup> groups;   ///< from top to bottom
};

}  // namespace ofm
