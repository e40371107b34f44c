// DXF as plane figures.

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <optional>
#include <utility>

#include "base/angles.hpp"
#include "drawings/curve_path.hpp"
#include "drawings/drawing.hpp"
#include "language/dxf_chains.hpp"
#include "plane/outlines.hpp"

namespace frontend {
namespace {

Vec2 vec2(const language::DxfPoint& point) { return {point.x, point.y}; }
language::DxfPoint dxf_point(const Vec2& point) { return {point.x, point.y}; }
EllipseArc ellipse_arc(const language::DxfArc& arc) {
  return {vec2(arc.center), vec2(arc.u), vec2(arc.v), arc.start, arc.sweep};
}

/// A line, or an arc, between two points.
struct DxfStroke {
  Vec2 start{0.0};
  Vec2 end{0.0};
  std::optional<EllipseArc> arc{};
};

/// Joins strokes as language::DxfChains does.
class DxfPaths {
 public:
  /// An arc between two equal points becomes a line. Others are moved so that they end on the grid.
  /// All coordinates must be at most kFarthest.
  void add(const DxfStroke& stroke);

  /// Returns the chains, each a path to be closed by a line. Their arcs are what they were.
  std::vector<CurvePath> join();

 private:
  using Step = language::DxfChains::Step;

  Vec2 place(uint32_t point) const { return vec2(chains_.place(point)); }
  void add_step(const Step& from, const Step& to, CurvePath& path) const;

  language::DxfChains chains_;
  std::vector<std::optional<EllipseArc>> arcs_;  // by link
};

/// The similar map that takes two points to two others; the first two differ.
PlaneMap map_of_points(const Vec2& a, const Vec2& b, const Vec2& to_a, const Vec2& to_b) {
  const Vec2 from = b - a;
  const Vec2 to = to_b - to_a;
  const double size = glm::dot(from, from);
  const double c = glm::dot(from, to) / size;
  const double s = cross(from, to) / size;
  PlaneMap map;
  map.linear = glm::dmat2(c, s, -s, c);
  map.translation = to_a - map.linear * a;
  return map;
}

/// A message need not hold all of a long line.
std::string shortened(std::string_view word) {
  constexpr size_t kMost = 60;
  return std::string(word.substr(0, kMost)) + (word.size() > kMost ? "..." : "");
}

class DxfReader {
 public:
  DxfReader(const std::string& name, const DxfSettings& settings)
      : name_(name), settings_(settings) {}

  Drawing read(std::string_view text) {
    const language::DxfSettings settings = {
        settings_.layer,
        {settings_.origin.x, settings_.origin.y},
        settings_.scale > 0 ? settings_.scale : 1,
        [&](double radius) { return csgcore::fragment_count(radius, settings_.facets); },
        [&](const language::DxfProblem& problem) { note(problem); }};
    strokes_ = language::read_dxf(text, settings).strokes;
    tell_unsupported();
    return finish();
  }

 private:
  /// Tells the first problem of each kind.
  void tell(const std::string& what, const std::string& todo) {
    const std::string_view kind = std::string_view(what).substr(0, what.find(' '));
    for (const DrawingProblem& problem : drawing_.problems) {
      if (problem.what.starts_with(kind)) return;
    }
    drawing_.problems.push_back({what, todo});
  }

  void note(const language::DxfProblem& problem) {
    const std::string word = shortened(problem.word);
    switch (problem.kind) {
      case language::DxfProblem::Kind::kIllegalCode:
        if (word.empty()) {
          return tell("'" + name_ + "' is no DXF", "export the drawing again, as text");
        }
        return tell("Illegal ID '" + word + "' in '" + name_ + "'",
                    "what follows is not read; export the drawing again, as text");
      case language::DxfProblem::Kind::kIllegalValue:
        return tell("Illegal value '" + word + "' in '" + name_ + "'",
                    "it is left out; write numbers with a decimal point");
      case language::DxfProblem::Kind::kMissingPoints:
        return tell("Not enough input values for " + word + ". in '" + name_ + "'",
                    "the entity before it is damaged: export the drawing again");
      case language::DxfProblem::Kind::kTooManyStrokes:
        return tell("Blocks of '" + name_ + "' are left out: they would make more than " +
                        std::to_string(language::kMostDxfStrokes) + " lines",
                    "explode fewer blocks within blocks");
      case language::DxfProblem::Kind::kUnsupported:
        unsupported_[word] += problem.count;
        return;
    }
  }

  void tell_unsupported() {
    if (unsupported_.empty()) return;
    constexpr size_t kMostNames = 20;
    std::string list;
    size_t names = 0;
    for (const auto& [name, count] : unsupported_) {
      if (++names > kMostNames) break;
      list += (list.empty() ? "'" : ", '") + name + "' (" + std::to_string(count) + ")";
    }
    const std::string place = settings_.layer.empty()
                                  ? "in '" + name_ + "'"
                                  : "in layer '" + settings_.layer + "' of '" + name_ + "'";
    tell("Unsupported DXF Entity " + list + " " + place,
         "it is left out; explode it to lines, arcs and polylines");
  }

  Drawing finish() {
    const auto is_near = [](const language::DxfPoint& p) {
      return std::abs(p.x) <= kFarthest && std::abs(p.y) <= kFarthest;
    };
    const bool is_in_range = std::all_of(strokes_.begin(), strokes_.end(), [&](const auto& stroke) {
      return is_near(stroke.start) && is_near(stroke.end) && is_near(stroke.arc.center) &&
             is_near(stroke.arc.u) && is_near(stroke.arc.v);
    });
    if (!is_in_range) {
      tell("Range check failed for '" + name_ + "'",
           "it has coordinates that are too large, or not finite");
      return std::move(drawing_);
    }
    Outline outline = settings_.is_faceted ? chords() : curves();
    std::erase_if(outline.loops, is_line_and_back);
    if (outline.loops.empty()) return std::move(drawing_);
    drawing_.figures = disjoint_figures({std::move(outline)});
    leave_out_tangles(name_, false, drawing_);
    return std::move(drawing_);
  }

  static bool is_line_and_back(const csgcore::ProfileLoop& loop) {
    return loop.size() <= 2 && std::all_of(loop.begin(), loop.end(), [](const auto& edge) {
             return edge.kind == csgcore::ProfileEdge::Kind::kLine;
           });
  }

  Outline chords() {
    language::DxfChains chains;
    for (const language::DxfStroke& stroke : strokes_) chains.add_chords(stroke);
    Polygons polygons;
    for (const language::DxfChains::Chain& chain : chains.join()) {
      Polygon& polygon = polygons.emplace_back();
      for (size_t i = 0; i < chain.size(); ++i) {
        if (i > 0 && chain[i].point == chain[i - 1].point) continue;
        polygon.push_back(vec2(chains.place(chain[i].point)));
      }
    }
    return outline_of(std::move(polygons));
  }

  Outline curves() {
    DxfPaths joined;
    std::vector<CurvePath> paths;
    for (const language::DxfStroke& stroke : strokes_) {
      if (stroke.is_arc && stroke.arc.sweep >= kTurn * (1 - kRoundingOfTurn)) {
        paths.push_back(whole_turn(ellipse_arc(stroke.arc)));
      } else if (stroke.is_arc) {
        add_arc(stroke, joined);
      } else {
        joined.add({vec2(stroke.start), vec2(stroke.end)});
      }
    }
    for (CurvePath& path : joined.join()) paths.push_back(std::move(path));
    Outline outline;
    Rectangle box;
    size_t count = 1;
    for (const CurvePath& path : paths) {
      box.merge(path.bounds());
      count += path.curves();
    }
    const CurveFineness fineness = fineness_of(box, count);
    for (const CurvePath& path : paths) outline.loops.push_back(path.loop(fineness));
    return outline;
  }

  /// Files give 2π with as few as six digits.
  static constexpr double kRoundingOfTurn = 1e-5;

  /// In two halves: the ends of an arc may lie so near to each other that they are one point.
  static void add_arc(const language::DxfStroke& stroke, DxfPaths& joined) {
    EllipseArc half = ellipse_arc(stroke.arc);
    half.sweep /= 2;
    const Vec2 middle = half.last();
    joined.add({vec2(stroke.start), middle, half});
    half.start += half.sweep;
    joined.add({middle, vec2(stroke.end), half});
  }

  static CurvePath whole_turn(const EllipseArc& arc) {
    CurvePath path(arc.first());
    path.arc_to({arc.center, arc.u, arc.v, arc.start, kTurn}, 1, arc.first());
    return path;
  }

  const std::string& name_;
  const DxfSettings& settings_;
  Drawing drawing_;
  std::vector<language::DxfStroke> strokes_;
  std::map<std::string, uint64_t> unsupported_;
};

}  // namespace

void DxfPaths::add(const DxfStroke& stroke) {
  const uint32_t link = chains_.add(dxf_point(stroke.start), dxf_point(stroke.end));
  const auto& [start, end] = chains_.ends(link);
  arcs_.emplace_back();
  if (!stroke.arc || start == end) return;
  const PlaneMap map = map_of_points(stroke.start, stroke.end, place(start), place(end));
  arcs_.back() = mapped(map, *stroke.arc);
}

void DxfPaths::add_step(const Step& from, const Step& to, CurvePath& path) const {
  if (from.point == to.point) return;
  const Vec2 end = place(to.point);
  const std::optional<EllipseArc>& arc = arcs_[to.link];
  if (!arc) return path.line_to(end);
  const bool is_forward = chains_.ends(to.link)[0] == from.point;
  path.arc_to(is_forward ? *arc : reversed(*arc), 1, end);
}

std::vector<CurvePath> DxfPaths::join() {
  std::vector<CurvePath> paths;
  for (const language::DxfChains::Chain& chain : chains_.join()) {
    CurvePath& path = paths.emplace_back(place(chain.front().point));
    for (size_t i = 1; i < chain.size(); ++i) add_step(chain[i - 1], chain[i], path);
  }
  return paths;
}

Drawing read_dxf(std::string_view bytes, const std::string& name, const DxfSettings& settings) {
  return DxfReader(name, settings).read(bytes);
}

}  // namespace frontend
