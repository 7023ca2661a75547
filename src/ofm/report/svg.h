// Parts of an SVG drawing, in pixels from the upper left corner.
#pragma once

#include <Eigen/Core>
#include <pugixml.hpp>
#include <span>
#include <string>

namespace ofm {

/// A coordinate with one decimal at most.
std::string SvgNumber(double px);

/// The root of a drawing in `document`, with a text alternative.
pugi::xml_node AddSvg(pugi::xml_document& document, const Eigen::Vector2d& size_px,
                      const std::string& alternative);

pugi::xml_node AddSvgLine(pugi::xml_node parent, const char* css_class, const Eigen::Vector2d& from,
                          const Eigen::Vector2d& to);

pugi::xml_node AddSvgRectangle(pugi::xml_node parent, const std::string& css_class,
                               const Eigen::Vector2d& corner, const Eigen::Vector2d& size);

enum class SvgAnchor { kStart, kMiddle, kEnd };

pugi::xml_node AddSvgText(pugi::xml_node parent, const char* css_class, const Eigen::Vector2d& at,
                          SvgAnchor anchor, const std::string& text);

/// Lines through the points, broken where one is not finite. Points that cannot be told apart at
/// half a pixel are thinned out: the first, lowest, highest and last of each half column stay.
void AddSvgPath(pugi::xml_node parent, const std::string& css_class,
                std::span<const Eigen::Vector2d> points);

/// The text of a drawing, without an XML declaration.
std::string SvgText(const pugi::xml_document& document);

/// About as wide as `text` is in the plots' font [px].
double SvgTextWidth(const std::string& text);

}  // namespace ofm
