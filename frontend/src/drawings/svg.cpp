// SVG, as OpenSCAD 2021.01 reads it.
// - path, rect, circle, ellipse, line, polyline and polygon count, in whatever element they stand
//   but defs. transform counts on these and on g. Style sheets, use, text, fill, display and the
//   name space do not. An attribute's number with anything behind it is 0, and so is one beyond the
//   largest double, whose shape scadray leaves out with a warning.
// - What is closed is filled by the even-odd rule, one element by itself, and the elements are
//   united. A part of a path counts as closed if its ends are at most 0.1 apart, and its last part
//   also if any part has a z.
// - line, polyline and the parts of paths that are open are drawn by a pen, before any
//   transformation: stroke-width (1 if it is less than 0.01), stroke-linecap (square by default),
//   stroke-linejoin (a miter up to a limit of 2; a bevel keeps the distance from the corner), each
//   as an attribute or else in style. They are not inherited.
// - Lengths of the page: without a unit they are 25.4 mm / dpi, and mm, cm, in, px (96 an inch),
//   pt, pc. %, em and ex give the view box's size in mm. What is missing or cannot be read is the
//   view box's size without a unit.
// - Without a view box, coordinates are mm. The y axis is turned over at the page's height, which
//   is 0 where there is none.
// - A view box scales by preserveAspectRatio. Its y is subtracted after the axis is turned over.
//   With several svg elements, the last one's size and view box count for all.
// - center puts the middle of the drawing's box at minus the view box's corner.
// - With --facets=all, a circle has 40 chords, a Bézier curve 20 and an arc of a degrees ⌊a/18⌋ +
//   4, whatever $fn is.
#include "drawings/svg.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>
#include <pugixml.hpp>
#include <utility>

#include "base/angles.hpp"
#include "drawings/curve_path.hpp"
#include "drawings/drawing.hpp"
#include "plane/offset.hpp"
#include "plane/outlines.hpp"

namespace frontend {
namespace {

constexpr int kOpenScadChordsOfCircle = 40;

/// An element that is drawn, by the even-odd rule.
struct SvgShape {
  PlaneMap map;  // to the document's coordinates
  SvgPath path;
  StrokeSettings stroke;  // of what is open
  bool is_circle = false;
};

/// The value that an attribute gives, or else the attribute `style`; empty where neither does.
std::string_view style_of(const pugi::xml_node& element, const char* name) {
  if (const pugi::xml_attribute own = element.attribute(name)) return own.value();
  std::string_view style = element.attribute("style").value();
  const std::string_view wanted(name);
  while (!style.empty()) {
    const std::string_view entry = style.substr(0, style.find(';'));
    style.remove_prefix(std::min(style.size(), entry.size() + 1));
    const size_t colon = entry.find(':');
    if (colon != std::string_view::npos && entry.substr(0, colon) == wanted) {
      return entry.substr(colon + 1);
    }
  }
  return {};
}

StrokeSettings read_stroke(const pugi::xml_node& element) {
  StrokeSettings settings;
  constexpr double kLeastWidth = 0.01;  // what is thinner has OpenSCAD's width of 1
  const double width = svg_number(style_of(element, "stroke-width"));
  if (width >= kLeastWidth && std::isfinite(width)) settings.width = width;
  const std::string_view ends = style_of(element, "stroke-linecap");
  if (ends == "butt") settings.ends = LineEnds::kButt;
  if (ends == "round") settings.ends = LineEnds::kRound;
  const std::string_view corners = style_of(element, "stroke-linejoin");
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

CurvePath ellipse(const Vec2& center, const Vec2& radii) {
  const EllipseArc arc{center, Vec2(radii.x, 0), Vec2(0, radii.y), 0, kTurn};
  CurvePath path(arc.first());
  path.arc_to(arc, kOpenScadChordsOfCircle, arc.first());
  return path;
}

CurvePath read_line(const pugi::xml_node& element) {
  CurvePath path({svg_number(element, "x1"), svg_number(element, "y1")});
  path.line_to({svg_number(element, "x2"), svg_number(element, "y2")});
  return path;
}

/// A corner of a rectangle, a quarter of an ellipse.
void add_corner(const Vec2& center, const Vec2& radii, double start, const Vec2& end,
                CurvePath& path) {
  constexpr double kQuarterTurn = kTurn / 4;
  const EllipseArc arc{center, Vec2(radii.x, 0), Vec2(0, radii.y), start * kQuarterTurn,
                       kQuarterTurn};
  path.arc_to(arc, svg_arc_pieces(kQuarterTurn), end);
}

CurvePath read_rectangle(const pugi::xml_node& element) {
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
  add_corner({max.x - r.x, min.y + r.y}, r, 3, {max.x, min.y + r.y}, path);
  path.line_to({max.x, max.y - r.y});
  add_corner({max.x - r.x, max.y - r.y}, r, 0, {max.x - r.x, max.y}, path);
  path.line_to({min.x + r.x, max.y});
  add_corner({min.x + r.x, max.y - r.y}, r, 1, {min.x, max.y - r.y}, path);
  path.line_to({min.x, min.y + r.y});
  add_corner({min.x + r.x, min.y + r.y}, r, 2, {min.x + r.x, min.y}, path);
  return path;
}

/// Returns the element's shape in its own coordinates; nothing if it is none.
std::optional<SvgShape> read_shape(const pugi::xml_node& element) {
  const std::string_view name = element.name();
  SvgShape shape;
  if (name == "path") {
    shape.path = read_svg_path(element.attribute("d").value());
  } else if (name == "rect") {
    shape.path.filled.push_back(read_rectangle(element));
  } else if (name == "circle" || name == "ellipse") {
    shape.is_circle = true;
    const bool has_one_radius = name == "circle";
    const Vec2 radii(svg_number(element, has_one_radius ? "r" : "rx"),
                     svg_number(element, has_one_radius ? "r" : "ry"));
    if (radii.x == 0 || radii.y == 0) return std::nullopt;
    const Vec2 center(svg_number(element, "cx"), svg_number(element, "cy"));
    shape.path.filled.push_back(ellipse(center, radii));
  } else if (name == "line") {
    shape.path.open.push_back(read_line(element));
  } else if (name == "polyline" || name == "polygon") {
    std::optional<CurvePath> path = read_points(element);
    if (!path) return std::nullopt;
    (name == "polygon" ? shape.path.filled : shape.path.open).push_back(std::move(*path));
  } else {
    return std::nullopt;
  }
  shape.stroke = read_stroke(element);
  return shape;
}

/// Walks the document, in its order.
class SvgReader {
 public:
  SvgReader(const std::string& name, const SvgSettings& settings)
      : name_(name), settings_(settings), page_(valid_dpi(settings.dpi)) {}

  Drawing read(const pugi::xml_document& document) {
    collect(document);
    PlaneMap map = page_.map();
    place(map);
    if (settings_.is_faceted) {
      add_chords();
    } else {
      add_curves();
    }
    if (settings_.is_centered) move_middle_to(page_.middle(), figures_);
    drawing_.figures = disjoint_figures(std::move(figures_));
    leave_out_tangles(name_, has_tangles_, drawing_);
    return std::move(drawing_);
  }

 private:
  static double valid_dpi(double dpi) {
    constexpr double kDefault = 72;
    constexpr double kLeast = 0.001;
    return dpi >= kLeast && std::isfinite(dpi) ? dpi : kDefault;
  }

  void collect(const pugi::xml_document& document) {
    const pugi::xml_node root = document.document_element();
    std::vector<PlaneMap> maps{{}};  // of the nodes around
    bool is_hidden = false;          // by `defs`
    pugi::xml_node node = root;
    while (node) {
      enter(node, node == root, maps.back(), is_hidden);
      if (pugi::xml_node child = node.first_child()) {
        maps.push_back(map_within(node, node == root, maps.back()));
        node = child;
        continue;
      }
      while (node != root && !node.next_sibling()) {
        node = node.parent();
        maps.pop_back();
        if (std::string_view(node.name()) == "defs") is_hidden = false;
      }
      if (node == root) return;
      node = node.next_sibling();
    }
  }

  /// Only groups move what is in them, but not the root.
  static PlaneMap map_within(const pugi::xml_node& node, bool is_root, const PlaneMap& around) {
    if (is_root || std::string_view(node.name()) != "g") return around;
    return compose(around, read_svg_transform(node.attribute("transform").value()));
  }

  void enter(const pugi::xml_node& node, bool is_root, const PlaneMap& around, bool& is_hidden) {
    const std::string_view name = node.name();
    if (name == "defs") is_hidden = static_cast<bool>(node.first_child());
    if (name == "svg") page_.take(node);
    if (is_hidden) return;
    std::optional<SvgShape> shape = read_shape(node);
    if (!shape) return;
    shape->map = around;
    if (!is_root) {
      shape->map = compose(around, read_svg_transform(node.attribute("transform").value()));
    }
    shapes_.push_back(std::move(*shape));
  }

  /// Returns whether nothing is left of an area, up to rounding.
  static bool is_flat(const PlaneMap& map) {
    constexpr double kRounding = 1e-12;
    return std::abs(map.determinant()) <=
           kRounding * glm::length(map.linear[0]) * glm::length(map.linear[1]);
  }

  /// Pens draw before anything is moved.
  void place(const PlaneMap& page) {
    for (SvgShape& shape : shapes_) {
      shape.map = compose(page, shape.map);
      if (is_flat(shape.map)) shape.path = {};
      for (CurvePath& path : shape.path.filled) path = path.mapped(shape.map);
      if (is_in_range(shape)) continue;
      shape.path = {};
      drawing_.problems.assign(1, {"Range check failed for a shape of '" + name_ + "'",
                                   "it has coordinates that are too large, or not finite"});
    }
  }

  static bool is_in_range(const SvgShape& shape) {
    const auto is_near = [](const CurvePath& path) { return path.is_in_range(); };
    return std::all_of(shape.path.filled.begin(), shape.path.filled.end(), is_near) &&
           std::all_of(shape.path.open.begin(), shape.path.open.end(), [&](const CurvePath& path) {
             return path.is_in_range() && path.mapped(shape.map).is_in_range();
           });
  }

  /// Adds what pens draw to the outline, by the even-odd rule. A line that is alone in its shape is
  /// a figure by itself, with the pen's curves, and so is one that crosses itself too often.
  void add_strokes(const SvgShape& shape, const CurveFineness& fineness, Outline& outline) {
    const bool is_alone = shape.path.filled.empty() && shape.path.open.size() == 1;
    for (const CurvePath& path : shape.path.open) {
      StrokeSettings settings = shape.stroke;
      settings.is_coarse = settings_.is_faceted;
      const Polygon line = settings_.is_faceted ? path.openscad_points() : chords(path, fineness);
      std::optional<SimplePolygons> polygons;
      if (settings_.is_faceted || !is_alone) polygons = stroked(line, settings);
      if (!polygons && crosses_itself(line, settings.width, kMostCrossingsOfPath)) {
        has_tangles_ = true;
        continue;
      }
      if (!polygons) {
        figures_.push_back(mapped(shape.map, pen_trace(line, settings)));
        continue;
      }
      for (Polygon& polygon : *polygons) {
        for (Vec2& point : polygon) point = shape.map.point(point);
        outline.loops.push_back(std::move(outline_of(Polygons{std::move(polygon)}).loops.front()));
      }
    }
  }

  /// The path by chords, without the line that would close it.
  static Polygon chords(const CurvePath& path, const CurveFineness& fineness) {
    Outline outline;
    outline.loops.push_back(path.loop(fineness));
    Polygon points{path.first()};
    for (const Polygon& polygon : chords_of(Figure(outline))) {
      points.insert(points.end(), polygon.begin(), polygon.end());
    }
    if (path.last() != path.first()) points.pop_back();
    return points;
  }

  void add_chords() {
    for (const SvgShape& shape : shapes_) {
      Polygons polygons;
      for (const CurvePath& path : shape.path.filled) polygons.push_back(path.openscad_points());
      Outline outline = outline_of(std::move(polygons));
      add_strokes(shape, {}, outline);
      add_figure(std::move(outline));
    }
  }

  void add_curves() {
    Rectangle box;
    size_t count = 1;
    for (const SvgShape& shape : shapes_) {
      for (const auto* paths : {&shape.path.filled, &shape.path.open}) {
        for (const CurvePath& path : *paths) {
          box.merge(path.bounds());
          count += path.curves();
        }
      }
    }
    const CurveFineness fineness = fineness_of(box, count);
    for (const SvgShape& shape : shapes_) {
      if (const std::optional<Disc> disc = disc_of(shape)) {
        figures_.push_back(*disc);
        continue;
      }
      Outline outline;
      for (const CurvePath& path : shape.path.filled) outline.loops.push_back(path.loop(fineness));
      add_strokes(shape, fineness, outline);
      add_figure(std::move(outline));
    }
  }

  static std::optional<Disc> disc_of(const SvgShape& shape) {
    if (!shape.is_circle || shape.path.filled.empty()) return std::nullopt;
    const csgcore::ProfileLoop loop = shape.path.filled.front().loop({});
    const csgcore::ProfileEdge& edge = loop.front();
    if (edge.kind != csgcore::ProfileEdge::Kind::kArc) return std::nullopt;
    return Disc{edge.control, glm::length(edge.end - edge.control)};
  }

  void add_figure(Outline outline) {
    if (!outline.loops.empty()) figures_.push_back(std::move(outline));
  }

  const std::string& name_;
  SvgSettings settings_;
  SvgPage page_;
  std::vector<SvgShape> shapes_;
  std::vector<Figure> figures_;
  bool has_tangles_ = false;  // which are none of the figures
  Drawing drawing_;
};

}  // namespace

Drawing read_svg(std::string_view bytes, const std::string& name, const SvgSettings& settings) {
  if (bytes.empty()) return {};
  pugi::xml_document document;
  if (!document.load_buffer(bytes.data(), bytes.size())) {
    return {{},
            {{"Error parsing file '" + name + "'", "it is no well-formed SVG: export it again"}}};
  }
  return SvgReader(name, settings).read(document);
}

}  // namespace frontend
