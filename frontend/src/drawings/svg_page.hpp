// Where an SVG document's coordinates lie, in mm: lengths, the view box and transformations.
#pragma once

#include <pugixml.hpp>
#include <string_view>

#include "plane/plane_map.hpp"

namespace frontend {

/// What OpenSCAD 2021.01 makes of the attributes of `svg` elements (svg.cpp). If there are several,
/// the last one places all that is drawn.
class SvgPage {
 public:
  /// `dpi` is that of lengths without a unit.
  explicit SvgPage(double dpi) : dpi_(dpi) {}

  void take(const pugi::xml_node& svg);

  /// Returns the map from the document's coordinates to the plane's. Its y axis points upwards.
  PlaneMap map() const;
  /// Returns where the middle of a centred drawing lies.
  Vec2 middle() const { return {-origin_.x * scale_.x, -origin_.y * scale_.y}; }

 private:
  double dpi_;
  double height_ = 0;
  Vec2 scale_{1.0};
  Vec2 origin_{0.0};  // of the view box
  Vec2 margin_{0.0};
};

/// Returns the map that a `transform` attribute stands for. A transformation with a wrong count of
/// numbers is left out.
PlaneMap read_svg_transform(std::string_view text);

}  // namespace frontend
