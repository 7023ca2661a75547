#include "ofm/report/svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <vector>

namespace ofm {
namespace {

/// What stays of consecutive points in one half column: first, extremes and last, in order.
void AppendThinned(std::span<const Eigen::Vector2d> column, std::vector<Eigen::Vector2d>& kept) {
  const auto [low, high] = std::minmax_element(
      column.begin(), column.end(), [](const auto& a, const auto& b) { return a.y() < b.y(); });
  std::vector<std::ptrdiff_t> indices = {0, low - column.begin(), high - column.begin(),
                                         static_cast<std::ptrdiff_t>(column.size()) - 1};
  std::sort(indices.begin(), indices.end());
  indices.erase(std::unique(indices.begin(), indices.end()), indices.end());
  for (const std::ptrdiff_t i : indices) kept.push_back(column[i]);
}

std::vector<Eigen::Vector2d> Thinned(std::span<const Eigen::Vector2d> points) {
  const auto column_of = [](const Eigen::Vector2d& p) { return std::floor(2 * p.x()); };
  std::vector<Eigen::Vector2d> kept;
  for (std::size_t begin = 0; begin < points.size();) {
    std::size_t end = begin + 1;
    while (end < points.size() && column_of(points[end]) == column_of(points[begin])) ++end;
    AppendThinned(points.subspan(begin, end - begin), kept);
    begin = end;
  }
  return kept;
}

void AddRun(pugi::xml_node parent, const std::string& css_class,
            std::span<const Eigen::Vector2d> points) {
  if (points.empty()) return;
  std::string text;
  for (const Eigen::Vector2d& point : Thinned(points)) {
    text +=
        fmt::format("{}{},{}", text.empty() ? "" : " ", SvgNumber(point.x()), SvgNumber(point.y()));
  }
  pugi::xml_node line = parent.append_child("polyline");
  line.append_attribute("class") = css_class.c_str();
  line.append_attribute("points") = text.c_str();
}

void AddPlace(pugi::xml_node node, const char* x, const char* y, const Eigen::Vector2d& place) {
  node.append_attribute(x) = SvgNumber(place.x()).c_str();
  node.append_attribute(y) = SvgNumber(place.y()).c_str();
}

}  // namespace

std::string SvgNumber(double px) {
  std::string text = fmt::format("{:.1f}", px);
  if (text.ends_with(".0")) text.resize(text.size() - 2);
  return text == "-0" ? "0" : text;
}

pugi::xml_node AddSvg(pugi::xml_document& document, const Eigen::Vector2d& size_px,
                      const std::string& alternative) {
  pugi::xml_node svg = document.append_child("svg");
  svg.append_attribute("xmlns") = "http://www.w3.org/2000/svg";
  svg.append_attribute("viewBox") =
      fmt::format("0 0 {} {}", SvgNumber(size_px.x()), SvgNumber(size_px.y())).c_str();
  svg.append_attribute("class") = "plot";
  svg.append_attribute("role") = "img";
  svg.append_attribute("aria-label") = alternative.c_str();
  return svg;
}

pugi::xml_node AddSvgLine(pugi::xml_node parent, const char* css_class, const Eigen::Vector2d& from,
                          const Eigen::Vector2d& to) {
  pugi::xml_node line = parent.append_child("line");
  line.append_attribute("class") = css_class;
  AddPlace(line, "x1", "y1", from);
  AddPlace(line, "x2", "y2", to);
  return line;
}

pugi::xml_node AddSvgRectangle(pugi::xml_node parent, const std::string& css_class,
                               const Eigen::Vector2d& corner, const Eigen::Vector2d& size) {
  pugi::xml_node rectangle = parent.append_child("rect");
  rectangle.append_attribute("class") = css_class.c_str();
  AddPlace(rectangle, "x", "y", corner);
  AddPlace(rectangle, "width", "height", size);
  return rectangle;
}

pugi::xml_node AddSvgText(pugi::xml_node parent, const char* css_class, const Eigen::Vector2d& at,
                          SvgAnchor anchor, const std::string& text) {
  pugi::xml_node node = parent.append_child("text");
  node.append_attribute("class") = css_class;
  AddPlace(node, "x", "y", at);
  if (anchor != SvgAnchor::kStart) {
    node.append_attribute("text-anchor") = anchor == SvgAnchor::kMiddle ? "middle" : "end";
  }
  node.text() = text.c_str();
  return node;
}

void AddSvgPath(pugi::xml_node parent, const std::string& css_class,
                std::span<const Eigen::Vector2d> points) {
  std::size_t begin = 0;
  for (std::size_t i = 0; i <= points.size(); ++i) {
    if (i < points.size() && points[i].allFinite()) continue;
    AddRun(parent, css_class, points.subspan(begin, i - begin));
    begin = i + 1;
  }
}

std::string SvgText(const pugi::xml_document& document) {
  std::ostringstream stream;
  document.save(stream, "", pugi::format_raw | pugi::format_no_declaration);
  return stream.str();
}

double SvgTextWidth(const std::string& text) {
  constexpr double kMeanWidth_px = 7;
  // Bytes that continue a UTF-8 character are not characters.
  const auto characters =
      std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; });
  return kMeanWidth_px * static_cast<double>(characters);
}

}  // namespace ofm
