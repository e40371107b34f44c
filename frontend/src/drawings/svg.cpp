// SVG, as OpenSCAD reads it: first 2021.01.
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
//
// What 2026 does otherwise:
// - `use` draws an element that stands in `defs` before it: a shape, a g, or a `use`. It is moved
// by
//   transform, and by x and y within that. Both href and xlink:href name it, by # and its id.
// - What has display: none is left out, with all below it if it is a g or a use.
// - `id` and `layer` choose elements: those of that id, and those with that inkscape:label and the
//   inkscape:groupmode of layers, with what is in their groups and uses. With both, the id must
//   stand within the layer. What stands around a chosen element does not hide it.
// - A page's size in % is that share of the view box's, as if that had no unit, and the view box's
//   corner has the same share. Blanks may stand before units, and around names and values in style.
// - Ends are butt unless stroke-linecap says otherwise.
// - Chords are more where $fn asks for more, or $fa and $fs do, but for Bézier curves.
// fill-rule, visibility, fill and text do not count there either.
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

/// Reads the document's shapes.
class SvgReader {
 public:
  SvgReader(const std::string& name, const SvgSettings& settings)
      : name_(name),
        settings_(settings),
        dialect_(settings.language),
        chords_(svg_chords(settings)),
        page_(valid_dpi(settings.dpi), dialect_) {}

  Drawing read(const pugi::xml_document& document) {
    collect(document.document_element());
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

  void collect(const pugi::xml_node& root) {
    const auto take_page = [&](const pugi::xml_node& svg) { page_.take(svg); };
    for (const SvgElement& element :
         drawn_svg_elements(root, name_, settings_, take_page, drawing_.problems)) {
      std::optional<SvgShape> shape = read_svg_shape(element.node, settings_);
      if (!shape) continue;
      shape->map = element.map;
      shapes_.push_back(std::move(*shape));
    }
  }

  /// Returns whether nothing is left of an area, up to rounding.
  static bool is_flat(const PlaneMap& map) {
    constexpr double kRounding = 1e-12;
    return std::abs(map.determinant()) <=
           kRounding * glm::length(map.linear[0]) * glm::length(map.linear[1]);
  }

  /// Pens draw before anything is moved.
  void place(const PlaneMap& page) {
    bool are_near = true;
    for (SvgShape& shape : shapes_) {
      shape.map = compose(page, shape.map);
      if (is_flat(shape.map)) shape.path = {};
      for (CurvePath& path : shape.path.filled) path = path.mapped(shape.map);
      if (is_in_range(shape)) continue;
      shape.path = {};
      are_near = false;
    }
    if (are_near) return;
    drawing_.problems.push_back({"Range check failed for a shape of '" + name_ + "'",
                                 "it has coordinates that are too large, or not finite"});
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
      if (settings_.is_faceted) settings.chords = dialect_.pen_chords;
      const Polygon line = settings_.is_faceted ? openscad_points(path) : chords(path, fineness);
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

  Polygon openscad_points(const CurvePath& path) const {
    return path.openscad_points(chords_.bezier(), most_chords_);
  }

  void add_chords() {
    constexpr size_t kMostChords = 1 << 20;  // of all curves; to unite so many takes some seconds
    constexpr size_t kLeastChords = 40;      // of one: 2021.01's of a circle
    size_t count = 1;
    for_each_path([&](const CurvePath& path) { count += path.curves(); });
    most_chords_ = static_cast<int>(std::max(kMostChords / count, kLeastChords));
    for (const SvgShape& shape : shapes_) {
      Polygons polygons;
      for (const CurvePath& path : shape.path.filled) polygons.push_back(openscad_points(path));
      Outline outline = outline_of(std::move(polygons));
      add_strokes(shape, {}, outline);
      add_figure(std::move(outline));
    }
  }

  /// Calls visit(path) with all paths of the shapes.
  template <typename Visit>
  void for_each_path(const Visit& visit) const {
    for (const SvgShape& shape : shapes_) {
      for (const auto* paths : {&shape.path.filled, &shape.path.open}) {
        for (const CurvePath& path : *paths) visit(path);
      }
    }
  }

  void add_curves() {
    Rectangle box;
    size_t count = 1;
    for_each_path([&](const CurvePath& path) {
      box.merge(path.bounds());
      count += path.curves();
    });
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
  const SvgDialect dialect_;
  const SvgChords chords_;
  SvgPage page_;
  std::vector<SvgShape> shapes_;
  std::vector<Figure> figures_;
  int most_chords_ = 0;
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
