// The drawings that OpenSCAD's import() and extrusions read as plane figures.
// Unless facets are kept, circles, arcs and quadratic curves are exact; ellipses and cubic curves
// are cut into quadratic ones that are at most 2⁻²⁴ of the drawing's size away. An outline of more
// than 262,144 edges that are long for their number, or whose parts lie over each other more than
// 64 deep, is left out, with a warning.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "csgcore/facets.hpp"
#include "language/language_version.hpp"
#include "plane/figure.hpp"

namespace frontend {

/// What is wrong with a drawing; the messages are OpenSCAD's where it has one.
struct DrawingProblem {
  std::string what;
  std::string todo;
};

/// What a file holds: the union of the figures. After a problem there may be figures, too.
struct Drawing {
  std::vector<Figure> figures;
  std::vector<DrawingProblem> problems;
};

struct DxfSettings {
  std::string layer{};  // empty: all layers
  Vec2 origin{0.0};
  double scale = 1;  // ≤ 0 or nan: 1
  bool is_centered = false;
  csgcore::FacetSettings facets{};
  /// Curves are OpenSCAD's chords; else they are exact.
  bool is_faceted = false;
};

struct SvgSettings {
  bool is_centered = false;
  double dpi = 72;  // < 0.001 or nan: 72
  bool is_faceted = false;
  language::LanguageVersion language = language::LanguageVersion::k2021;
  // These count by the rules of 2026 alone:
  std::optional<std::string> id{};     // of the elements that are drawn; nothing: all are
  std::optional<std::string> layer{};  // the label of Inkscape's layers that are drawn
  csgcore::FacetSettings facets{};     // of the chords
};

/// Leaves out the figures that would take too long to draw, and tells of it, and of others that are
/// left out already.
void leave_out_tangles(const std::string& name, bool are_others_left_out, Drawing& drawing);

/// These read the bytes of a file, whose name is for messages. No file makes them take memory or
/// time out of proportion to its size.

/// DXF, in text: lines, polylines without bulges, circles, arcs, ellipses and inserted blocks.
/// Their ends are joined where they meet on OpenSCAD's grid of 1/1024.
Drawing read_dxf(std::string_view bytes, const std::string& name, const DxfSettings& settings);
/// SVG: paths, rectangles, circles, ellipses, lines, polylines, polygons and groups; by 2026's
/// rules uses of what `defs` hold, too.
Drawing read_svg(std::string_view bytes, const std::string& name, const SvgSettings& settings);

/// Moves the middle of the figures' box to a place.
void move_middle_to(const Vec2& place, std::vector<Figure>& figures);

/// Returns figures with the union of these: those whose boxes are disjoint become one outline, and
/// so do polygons that meet, and any figures that meet if there are many. If there are few discs,
/// they stay discs.
std::vector<Figure> disjoint_figures(std::vector<Figure> figures);

/// Returns whether the figure has very many edges, most of which cross so many others that it would
/// take too long to draw. To tell takes time in proportion to the edges.
bool is_tangle(const Figure& figure);

}  // namespace frontend
