#include "drawings/drawing.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <iterator>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

#include "plane/outlines.hpp"

namespace frontend {
namespace {

/// So many figures that meet cost no more than their union by chords.
constexpr size_t kFewFigures = 32;

/// Sets of figures whose boxes meet, directly or by others.
class MeetingFigures {
 public:
  explicit MeetingFigures(const std::vector<Figure>& figures) : parent_(figures.size()) {
    std::iota(parent_.begin(), parent_.end(), size_t{0});
    for (const Figure& figure : figures) boxes_.push_back(bounds_of(figure));
    sweep();
  }

  std::vector<std::vector<size_t>> sets() {
    std::vector<std::vector<size_t>> by_root(parent_.size());
    for (size_t i = 0; i < parent_.size(); ++i) by_root[root(i)].push_back(i);
    std::erase_if(by_root, [](const std::vector<size_t>& set) { return set.empty(); });
    return by_root;
  }

 private:
  /// Beyond so many steps, which take about a second, all are taken to meet.
  static constexpr size_t kMostSteps = 1 << 29;

  size_t root(size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }

  void sweep() {
    std::vector<size_t> order(parent_.size());
    std::iota(order.begin(), order.end(), size_t{0});
    std::sort(order.begin(), order.end(), [&](size_t a, size_t b) {
      return std::pair(boxes_[a].min.x, a) < std::pair(boxes_[b].min.x, b);
    });
    std::vector<size_t> open;
    size_t steps = 0;
    for (const size_t i : order) {
      const Rectangle& box = boxes_[i];
      std::erase_if(open, [&](size_t other) { return boxes_[other].max.x < box.min.x; });
      steps += open.size();
      for (const size_t other : open) {
        const bool meets = boxes_[other].min.y <= box.max.y && box.min.y <= boxes_[other].max.y;
        if (meets || steps > kMostSteps) parent_[root(other)] = root(i);
      }
      if (steps > kMostSteps) open.clear();
      open.push_back(i);
    }
  }

  std::vector<size_t> parent_;
  std::vector<Rectangle> boxes_;
};

void append(const Figure& figure, Outline& outline) {
  Outline part = outline_of(figure);
  std::move(part.loops.begin(), part.loops.end(), std::back_inserter(outline.loops));
}

/// The union of polygons; nothing if that cannot be afforded.
std::optional<Outline> united_outline(const std::vector<Figure>& figures) {
  std::optional<SimplePolygons> polygons = united(figures);
  if (!polygons) return std::nullopt;
  return outline_of(std::move(*polygons));
}

size_t edge_count(const Figure& figure) {
  const Outline* outline = std::get_if<Outline>(&figure);
  size_t count = 0;
  if (outline == nullptr) return count;
  for (const csgcore::ProfileLoop& loop : outline->loops) count += loop.size();
  return count;
}

csgcore::ProfileLoop reversed(const csgcore::ProfileLoop& loop) {
  csgcore::ProfileLoop result(loop.rbegin(), loop.rend());
  for (size_t i = 0; i < result.size(); ++i) {
    // An edge ended where the one after it began, and that comes first now.
    result[i].end = loop[(2 * loop.size() - i - 2) % loop.size()].end;
    result[i].is_counterclockwise = !result[i].is_counterclockwise;
  }
  return result;
}

/// Adds the figure's loops, so that its winding number is 1 inside, and 0 outside. A loop that
/// crosses nothing keeps its curves. False: edges cross too often.
bool add_wound(const Figure& figure, Outline& outline) {
  std::optional<SimplePolygons> polygons = united({&figure, 1});
  if (!polygons) return false;
  const Outline loops = outline_of(figure);
  if (loops.loops.size() == 1 && polygons->size() == 1) {
    constexpr double kRounding = 1e-6;  // of the polygons' grid
    const double area = signed_area(chords_of(figure).front());
    if (std::abs(std::abs(area) - signed_area(polygons->front())) <= kRounding * std::abs(area)) {
      const csgcore::ProfileLoop& loop = loops.loops.front();
      outline.loops.push_back(area > 0 ? loop : reversed(loop));
      return true;
    }
  }
  append(outline_of(std::move(*polygons)), outline);
  return true;
}

std::optional<Outline> wound_outline(const std::vector<Figure>& figures) {
  Outline outline;
  outline.fill_rule = csgcore::FillRule::kNonZero;
  for (const Figure& figure : figures) {
    if (!add_wound(figure, outline)) return std::nullopt;
  }
  return outline;
}

/// Replaces sets of many figures by their unions.
std::vector<Figure> without_large_sets(std::vector<Figure> figures) {
  std::vector<Figure> result;
  for (const std::vector<size_t>& set : MeetingFigures(figures).sets()) {
    std::vector<Figure> members;
    for (const size_t i : set) members.push_back(std::move(figures[i]));
    std::optional<Outline> whole;
    if (members.size() > kFewFigures) whole = wound_outline(members);
    if (whole) {
      result.push_back(std::move(*whole));
    } else {
      std::move(members.begin(), members.end(), std::back_inserter(result));
    }
  }
  return result;
}

/// One figure of each set becomes a part of the first outline, another one of the second. What is
/// filled by another rule stays alone.
std::vector<Figure> joined(std::vector<Figure> figures) {
  std::vector<Outline> outlines;
  const auto first_wound =
      std::stable_partition(figures.begin(), figures.end(), [](const Figure& figure) {
        const Outline* outline = std::get_if<Outline>(&figure);
        return outline == nullptr || outline->fill_rule == csgcore::FillRule::kEvenOdd;
      });
  std::vector<Figure> wound(std::make_move_iterator(first_wound),
                            std::make_move_iterator(figures.end()));
  figures.erase(first_wound, figures.end());
  for (const std::vector<size_t>& set : MeetingFigures(figures).sets()) {
    if (outlines.size() < set.size()) outlines.resize(set.size());
    for (size_t i = 0; i < set.size(); ++i) append(figures[set[i]], outlines[i]);
  }
  std::move(outlines.begin(), outlines.end(), std::back_inserter(wound));
  return wound;
}

/// How long edges are, for their number: the cells that their boxes reach, of a grid with as many
/// cells as there are edges. Outlines that do not cross themselves have short edges, or few. And
/// how many loops lie over each other, by the areas of their boxes.
class EdgeGrid {
 public:
  explicit EdgeGrid(const Outline& outline) : box_(bounds_of(Figure(outline))) {
    const auto edges = static_cast<double>(edge_count(outline));
    side_ = std::max(1.0, std::floor(std::sqrt(edges)));
    most_ = kMostCellsOfEdge * edges;
    for (const csgcore::ProfileLoop& loop : outline.loops) {
      Vec2 start = loop.empty() ? Vec2(0.0) : loop.back().end;
      Rectangle box;
      for (const csgcore::ProfileEdge& edge : loop) {
        box.merge(edge.end);
        const Vec2 cells = reach(glm::abs(edge.end - start), box_.max - box_.min);
        cells_ += cells.x * cells.y;
        start = edge.end;
      }
      covered_ += area(box);
    }
  }

  bool is_piled_up() const { return covered_ > kMostLayers * area(box_); }
  bool is_crowded() const { return cells_ > most_ || is_piled_up(); }

 private:
  static constexpr double kMostCellsOfEdge = 64;
  static constexpr double kMostLayers = 64;

  static double area(const Rectangle& box) {
    return box.empty() ? 0 : (box.max.x - box.min.x) * (box.max.y - box.min.y);
  }

  Vec2 reach(const Vec2& size, const Vec2& whole) const {
    const Vec2 least(std::numeric_limits<double>::min());
    return 1.0 + side_ * size / glm::max(whole, least);
  }

  Rectangle box_;
  double side_ = 1, most_ = 0, cells_ = 0, covered_ = 0;
};

bool is_disc(const Figure& figure) { return std::holds_alternative<Disc>(figure); }

}  // namespace

void move_middle_to(const Vec2& place, std::vector<Figure>& figures) {
  Rectangle box;
  for (const Figure& figure : figures) box.merge(bounds_of(figure));
  if (box.empty()) return;
  const PlaneMap map{glm::dmat2(1.0), place - (box.min + box.max) / 2.0};
  for (Figure& figure : figures) figure = mapped(map, figure);
}

std::vector<Figure> disjoint_figures(std::vector<Figure> figures) {
  if (figures.empty()) return figures;
  constexpr size_t kManyEdges = 1 << 18;  // to unite so many polygons takes about a second
  size_t edges = 0;
  for (const Figure& figure : figures) edges += edge_count(figure);
  if (edges > kManyEdges) {
    // What is a tangle anyway is not united.
    Outline all;
    for (const Figure& figure : figures) append(figure, all);
    if (EdgeGrid(all).is_piled_up()) return {std::move(all)};
  }
  if (edges <= kManyEdges && std::all_of(figures.begin(), figures.end(), is_polygonal)) {
    if (std::optional<Outline> whole = united_outline(figures)) {
      figures.clear();
      if (std::optional<Figure> kept = cleaned(std::move(*whole))) figures.push_back(*kept);
      return figures;
    }
  }
  std::vector<Figure> discs;
  const auto first_disc = std::stable_partition(figures.begin(), figures.end(),
                                                [](const Figure& f) { return !is_disc(f); });
  if (figures.end() - first_disc <= static_cast<std::ptrdiff_t>(kFewFigures)) {
    discs.assign(std::make_move_iterator(first_disc), std::make_move_iterator(figures.end()));
    figures.erase(first_disc, figures.end());
  }
  if (figures.size() > 1) figures = joined(without_large_sets(std::move(figures)));
  std::move(discs.begin(), discs.end(), std::back_inserter(figures));
  return figures;
}

bool is_tangle(const Figure& figure) {
  constexpr size_t kFewEdges = 1 << 18;
  if (edge_count(figure) <= kFewEdges) return false;
  return EdgeGrid(std::get<Outline>(figure)).is_crowded();
}

void leave_out_tangles(const std::string& name, bool are_others_left_out, Drawing& drawing) {
  if (std::erase_if(drawing.figures, is_tangle) == 0 && !are_others_left_out) return;
  drawing.problems.push_back(
      {"Outlines of '" + name + "' are left out: their edges cross too often",
       "draw outlines that do not cross"});
}

}  // namespace frontend
