#include "drawings/disjoint_figures.hpp"

#include <algorithm>
#include <iterator>
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

/// Replaces sets of many figures by their unions.
std::vector<Figure> without_large_sets(std::vector<Figure> figures) {
  std::vector<Figure> result;
  for (const std::vector<size_t>& set : MeetingFigures(figures).sets()) {
    std::vector<Figure> members;
    for (const size_t i : set) members.push_back(std::move(figures[i]));
    std::optional<Outline> whole;
    if (members.size() > kFewFigures) whole = united_outline(members);
    if (whole) {
      result.push_back(std::move(*whole));
    } else {
      std::move(members.begin(), members.end(), std::back_inserter(result));
    }
  }
  return result;
}

/// One figure of each set becomes a part of the first outline, another one of the second.
std::vector<Figure> joined(const std::vector<Figure>& figures) {
  std::vector<Outline> outlines;
  for (const std::vector<size_t>& set : MeetingFigures(figures).sets()) {
    if (outlines.size() < set.size()) outlines.resize(set.size());
    for (size_t i = 0; i < set.size(); ++i) append(figures[set[i]], outlines[i]);
  }
  return {std::make_move_iterator(outlines.begin()), std::make_move_iterator(outlines.end())};
}

bool is_disc(const Figure& figure) { return std::holds_alternative<Disc>(figure); }

}  // namespace

std::vector<Figure> disjoint_figures(std::vector<Figure> figures) {
  if (figures.empty()) return figures;
  if (std::all_of(figures.begin(), figures.end(), is_polygonal)) {
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
  figures = joined(without_large_sets(std::move(figures)));
  std::move(discs.begin(), discs.end(), std::back_inserter(figures));
  return figures;
}

}  // namespace frontend
