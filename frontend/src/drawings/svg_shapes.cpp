// The shapes of SVG elements, as OpenSCAD reads them (svg.cpp).
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <optional>
#include <utility>

#include "base/angles.hpp"
#include "drawings/svg.hpp"

namespace frontend {
namespace {

StrokeSettings read_stroke(const pugi::xml_node& element, const SvgDialect& dialect) {
  StrokeSettings settings;
  settings.ends = dialect.line_ends;
  constexpr double kLeastWidth = 0.01;  // what is thinner has OpenSCAD's width of 1
  const double width = svg_number(svg_style(element, "stroke-width", dialect));
  if (width >= kLeastWidth && std::isfinite(width)) settings.width = width;
  const std::string_view ends = svg_style(element, "stroke-linecap", dialect);
  if (ends == "butt") settings.ends = LineEnds::kButt;
  if (ends == "square") settings.ends = LineEnds::kSquare;
  if (ends == "round") settings.ends = LineEnds::kRound;
  const std::string_view corners = svg_style(element, "stroke-linejoin", dialect);
  if (corners == "bevel") settings.corners = CornerStyle::kSquare;
  if (corners == "round") settings.corners = CornerStyle::kRound;
  return settings;
}

std::optional<CurvePath> read_points(const pugi::xml_node& element) {
  std::string_view text = element.attribute("points").value();
  std::optional<CurvePath> path;
  while (true) {
    const std::string_view x = take_svg_word(text);
    const std::string_view y = take_svg_word(text);
    if (y.empty()) return path;
    const Vec2 point(svg_number(x), svg_number(y));
    if (path) {
      path->line_to(point);
    } else {
      path.emplace(point);
    }
  }
}

CurvePath ellipse(const Vec2& center, const Vec2& radii, const SvgChords& chords) {
  const EllipseArc arc{center, Vec2(radii.x, 0), Vec2(0, radii.y), chords.circle_start(), kTurn};
  CurvePath path(arc.first());
  path.arc_to(arc, chords.circle(radii), arc.first());
  return path;
}

CurvePath read_line(const pugi::xml_node& element) {
  CurvePath path({svg_number(element, "x1"), svg_number(element, "y1")});
  path.line_to({svg_number(element, "x2"), svg_number(element, "y2")});
  return path;
}

/// A corner of a rectangle, a quarter of an ellipse.
void add_corner(const Vec2& center, const Vec2& radii, double start, const Vec2& end,
                const SvgChords& chords, CurvePath& path) {
  constexpr double kQuarterTurn = kTurn / 4;
  const EllipseArc arc{center, Vec2(radii.x, 0), Vec2(0, radii.y), start * kQuarterTurn,
                       kQuarterTurn};
  path.arc_to(arc, chords.arc(kQuarterTurn, radii), end);
}

CurvePath read_rectangle(const pugi::xml_node& element, const SvgChords& chords) {
  const Vec2 min(svg_number(element, "x"), svg_number(element, "y"));
  const Vec2 size(svg_number(element, "width"), svg_number(element, "height"));
  const Vec2 max = min + size;
  Vec2 r(svg_number(element, "rx"), svg_number(element, "ry"));
  if (r.y == 0) r.y = r.x;
  if (r.x == 0) r.x = r.y;
  r = glm::min(r, size / 2.0);
  if (!(r.x > 0 && r.y > 0)) {
    CurvePath path(min);
    for (const Vec2& corner : {Vec2(max.x, min.y), max, Vec2(min.x, max.y)}) path.line_to(corner);
    return path;
  }
  CurvePath path({min.x + r.x, min.y});
  path.line_to({max.x - r.x, min.y});
  add_corner({max.x - r.x, min.y + r.y}, r, 3, {max.x, min.y + r.y}, chords, path);
  path.line_to({max.x, max.y - r.y});
  add_corner({max.x - r.x, max.y - r.y}, r, 0, {max.x - r.x, max.y}, chords, path);
  path.line_to({min.x + r.x, max.y});
  add_corner({min.x + r.x, max.y - r.y}, r, 1, {min.x, max.y - r.y}, chords, path);
  path.line_to({min.x, min.y + r.y});
  add_corner({min.x + r.x, min.y + r.y}, r, 2, {min.x + r.x, min.y}, chords, path);
  return path;
}

}  // namespace

std::string_view svg_style(const pugi::xml_node& element, const char* name,
                           const SvgDialect& dialect) {
  if (const pugi::xml_attribute own = element.attribute(name)) return own.value();
  const auto tidy = [&](std::string_view word) {  // 2021.01 takes no blanks
    return dialect.trims_words ? trimmed_svg(word) : word;
  };
  std::string_view style = element.attribute("style").value();
  const std::string_view wanted(name);
  while (!style.empty()) {
    const std::string_view entry = style.substr(0, style.find(';'));
    style.remove_prefix(std::min(style.size(), entry.size() + 1));
    const size_t colon = entry.find(':');
    if (colon != std::string_view::npos && tidy(entry.substr(0, colon)) == wanted) {
      return tidy(entry.substr(colon + 1));
    }
  }
  return {};
}

std::optional<SvgShape> read_svg_shape(const pugi::xml_node& element, const SvgSettings& settings) {
  const SvgChords chords = svg_chords(settings);
  const std::string_view name = element.name();
  SvgShape shape;
  if (name == "path") {
    shape.path = read_svg_path(element.attribute("d").value(), chords);
  } else if (name == "rect") {
    shape.path.filled.push_back(read_rectangle(element, chords));
  } else if (name == "circle" || name == "ellipse") {
    shape.is_circle = true;
    const bool has_one_radius = name == "circle";
    const Vec2 radii(svg_number(element, has_one_radius ? "r" : "rx"),
                     svg_number(element, has_one_radius ? "r" : "ry"));
    if (radii.x == 0 || radii.y == 0) return std::nullopt;
    const Vec2 center(svg_number(element, "cx"), svg_number(element, "cy"));
    shape.path.filled.push_back(ellipse(center, radii, chords));
  } else if (name == "line") {
    shape.path.open.push_back(read_line(element));
  } else if (name == "polyline" || name == "polygon") {
    std::optional<CurvePath> path = read_points(element);
    if (!path) return std::nullopt;
    (name == "polygon" ? shape.path.filled : shape.path.open).push_back(std::move(*path));
  } else {
    return std::nullopt;
  }
  shape.stroke = read_stroke(element, SvgDialect(settings.language));
  return shape;
}

}  // namespace frontend
