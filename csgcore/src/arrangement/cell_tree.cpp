#include "arrangement/cell_tree.hpp"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <optional>

#include "csgcore/stop_scope.hpp"

namespace csgcore {
namespace {

float rounded_down(int64_t x) {
  const auto result = static_cast<float>(x);
  constexpr float kLowest = -std::numeric_limits<float>::infinity();
  return static_cast<double>(result) > static_cast<double>(x) ? std::nextafter(result, kLowest)
                                                              : result;
}

int turn_moved(const GridPoint& a, const GridPoint& b, const GridPoint& point, int axis) {
  const int result = turn(a, b, point, axis);
  return result != 0 ? result : turn_of_moved(a, b, axis);
}

int side_moved(const GridPlane& plane, const GridPoint& point) {
  const int result = side(plane, point);
  return result != 0 ? result : side_of_moved(plane);
}

/// Adds to a winding number what a way along an axis changes, from the side of a facet's plane on
/// which it starts to the one on which it ends: a way that leaves by the front ends outside.
int change(int side_before, int side_after) { return (side_before - side_after) / 2; }

/// Returns whether the point's column along the axis passes the facet.
template <class Turn>
bool is_in_column(const std::array<GridPoint, 3>& corners, Turn turn) {
  const int first = turn(corners[0], corners[1]);
  return turn(corners[1], corners[2]) == first && turn(corners[2], corners[0]) == first;
}

}  // namespace

struct CellTree::Cell {
  /// An operand that matters in a cell, and its winding number at the cell's lowest corner: in the
  /// cell, but for a move by far the longest along x, and longer along y than along z, that keeps
  /// the point off all surfaces (simulation of simplicity).
  struct Winding {
    uint32_t operand;
    int number;
  };

  // A branch: what lies below the plane, and what lies above it.
  size_t axis = 0;
  int64_t plane = 0;
  std::unique_ptr<Cell> low;
  std::unique_ptr<Cell> high;
  // A leaf.
  GridPoint corner{};  // the lowest
  GridPoint top{};     // the highest corner
  TreeTokens tokens;
  std::vector<Winding> windings;  // of the operands in the tree, which are in rising order
  std::vector<uint32_t> facets;   // of these operands, in rising order
  std::optional<KeptFace> alone;  // if there is one operand only
};

class CellTree::Builder {
 public:
  Builder(CellTree& result, const std::vector<bool>& may_cross_itself)
      : facets_(result.facets_),
        may_cross_itself_(may_cross_itself),
        boxes_(result.facets_.facets.size()) {
    tbb::parallel_for(tbb::blocked_range<size_t>(0, boxes_.size(), 4096), [&](const auto& range) {
      for (size_t i = range.begin(); i < range.end(); ++i) {
        boxes_[i] = box_of(facets_.corners(static_cast<uint32_t>(i)));
      }
    });
  }

  void run(std::span<const CsgToken> tree, CellTree& result) {
    auto root = std::make_unique<Cell>();
    root->tokens.assign(tree.begin(), tree.end());
    root->facets.resize(boxes_.size());
    std::iota(root->facets.begin(), root->facets.end(), 0u);
    for (const GridPoint& point : facets_.points) {
      for (size_t i = 0; i < 3; ++i) {
        root->corner[i] = std::min(root->corner[i], point[i] - 1);
        root->top[i] = std::max(root->top[i], point[i] + 1);
      }
    }
    for (const Facet& facet : facets_.facets) {
      auto& windings = root->windings;
      if (windings.empty() || windings.back().operand != facet.operand) {
        windings.push_back({facet.operand, 0});
      }
    }
    build(*root, 0);
    result.root_ = std::move(root);
    for (Found& found : found_) {
      result.pairs_.insert(result.pairs_.end(), found.pairs.begin(), found.pairs.end());
      result.others_.insert(result.others_.end(), found.others.begin(), found.others.end());
      std::ranges::move(found.alone, std::back_inserter(result.alone_));
    }
    auto& pairs = result.pairs_;
    // In one comparison, where that of std::pair takes several that are hard to predict.
    const auto number = [](const auto& pair) { return uint64_t{pair.first} << 32 | pair.second; };
    tbb::parallel_sort(pairs.begin(), pairs.end(),
                       [&](const auto& a, const auto& b) { return number(a) < number(b); });
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  }

 private:
  /// A box in single precision, rounded outwards.
  struct FacetBox {
    std::array<float, 3> min;
    std::array<float, 3> max;

    bool meets(const FacetBox& other) const {
      for (size_t i = 0; i < 3; ++i) {
        if (min[i] > other.max[i] || max[i] < other.min[i]) return false;
      }
      return true;
    }
  };

  struct Found {
    std::vector<std::pair<uint32_t, uint32_t>> pairs;
    std::vector<uint32_t> others;
    std::vector<Alone> alone;
  };

  static FacetBox box_of(const std::array<GridPoint, 3>& corners) {
    FacetBox box;
    for (size_t i = 0; i < 3; ++i) {
      const auto [least, most] = std::minmax({corners[0][i], corners[1][i], corners[2][i]});
      box.min[i] = rounded_down(least);
      box.max[i] = -rounded_down(-most);
    }
    return box;
  }

  void build(Cell& cell, int depth) {
    stop_point();
    restrict(cell);
    if (cell.facets.empty()) return;
    if (cell.alone && !may_cross_itself_[cell.windings.front().operand]) {
      add_alone(cell);
      return;
    }
    constexpr size_t kFew = 128;
    constexpr int kDeepest = 60;
    // Few facets are compared, unless they are apart: then each may be alone in a smaller cell.
    std::vector<std::pair<uint32_t, uint32_t>> pairs;
    const bool is_small = cell.facets.size() <= kFew;
    if (is_small) pairs = pairs_of(cell.facets);
    if (!pairs.empty() || depth == kDeepest || !divide(cell)) {
      Found& found = found_.local();
      found.others.insert(found.others.end(), cell.facets.begin(), cell.facets.end());
      if (!is_small) pairs = pairs_of(cell.facets);
      found.pairs.insert(found.pairs.end(), pairs.begin(), pairs.end());
      cell.facets.shrink_to_fit();
      return;
    }
    const size_t facets = cell.low->facets.size() + cell.high->facets.size();
    constexpr size_t kManyAtOnce = 4096;
    if (facets < kManyAtOnce) {
      build(*cell.low, depth + 1);
      build(*cell.high, depth + 1);
      return;
    }
    const std::stop_token* const stop = stop_of_work;
    const auto build_child = [&](Cell& child) {
      const StopScope scope(stop);
      build(child, depth + 1);
    };
    tbb::parallel_invoke([&] { build_child(*cell.low); }, [&] { build_child(*cell.high); });
  }

  /// Leaves out what does not matter in the cell. An operand without a facet there holds all of the
  /// cell or nothing of it.
  void restrict(Cell& cell) const {
    std::vector<uint32_t> here;
    for (const uint32_t facet : cell.facets) {
      const uint32_t operand = facets_.facets[facet].operand;
      if (here.empty() || here.back() != operand) here.push_back(operand);
    }
    const auto held = [&](uint32_t operand) {
      if (std::ranges::binary_search(here, operand)) return Held::kHere;
      const auto place =
          std::ranges::lower_bound(cell.windings, operand, {}, &Cell::Winding::operand);
      const bool is_held =
          place != cell.windings.end() && place->operand == operand && place->number != 0;
      return is_held ? Held::kYes : Held::kNo;
    };
    cell.tokens = restricted(cell.tokens, held);
    std::vector<uint32_t> matters;
    for (const CsgToken& token : cell.tokens) {
      if (token.is_primitive && token.value != kNoPlace) matters.push_back(token.value);
    }
    std::ranges::sort(matters);
    const auto is_left_out = [&](uint32_t operand) {
      return !std::ranges::binary_search(matters, operand);
    };
    std::erase_if(cell.windings,
                  [&](const Cell::Winding& winding) { return is_left_out(winding.operand); });
    if (matters.size() < here.size()) {
      std::erase_if(cell.facets,
                    [&](uint32_t facet) { return is_left_out(facets_.facets[facet].operand); });
    }
    if (matters.size() == 1) {
      const bool is_subtracted = cell.tokens.size() > 1;
      cell.alone = KeptFace{is_subtracted ? -1 : 1, matters.front()};
    }
  }

  /// Divides the cell by a plane; facets that reach both sides go to both. Returns whether that
  /// leaves enough fewer facets in each of them.
  bool divide(Cell& cell) const {
    const std::vector<uint32_t>& list = cell.facets;
    constexpr size_t kSamples = 64;
    const size_t step = std::max<size_t>(list.size() / kSamples, 1);
    std::array<std::vector<float>, 3> centers;
    for (auto& values : centers) values.reserve(2 * kSamples);
    for (size_t i = 0; i < list.size(); i += step) {
      const FacetBox& box = boxes_[list[i]];
      for (size_t axis = 0; axis < 3; ++axis) {
        centers[axis].push_back((box.min[axis] + box.max[axis]) / 2);
      }
    }
    std::array<float, 3> spread{};
    for (size_t axis = 0; axis < 3; ++axis) {
      const auto [least, most] = std::ranges::minmax(centers[axis]);
      spread[axis] = most - least;
    }
    std::array<size_t, 3> axes{0, 1, 2};
    std::ranges::sort(axes, std::greater(), [&](size_t axis) { return spread[axis]; });
    for (const size_t axis : axes) {
      std::vector<float>& values = centers[axis];
      const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
      std::nth_element(values.begin(), middle, values.end());
      // Between two centres, so that it need not touch what stands apart.
      const float below =
          middle == values.begin() ? *middle : *std::max_element(values.begin(), middle);
      if (divide(cell, axis, std::llrint((below + *middle) / 2))) return true;
    }
    return false;
  }

  bool divide(Cell& cell, size_t axis, int64_t plane) const {
    if (plane <= cell.corner[axis]) return false;
    const auto at = static_cast<double>(plane);
    const auto is_low = [&](uint32_t facet) {
      return static_cast<double>(boxes_[facet].min[axis]) <= at;
    };
    const auto is_high = [&](uint32_t facet) {
      return static_cast<double>(boxes_[facet].max[axis]) >= at;
    };
    size_t low_count = 0;
    size_t high_count = 0;
    for (const uint32_t facet : cell.facets) {
      low_count += is_low(facet) ? 1 : 0;
      high_count += is_high(facet) ? 1 : 0;
    }
    // Where most facets reach both sides, planes do not tell them apart.
    const size_t all = cell.facets.size();
    if (10 * std::max(low_count, high_count) > 9 * all ||
        10 * (low_count + high_count) > 16 * all) {
      return false;
    }
    std::vector<uint32_t> low(low_count);
    std::vector<uint32_t> high(high_count);
    std::ranges::copy_if(cell.facets, low.begin(), is_low);
    std::ranges::copy_if(cell.facets, high.begin(), is_high);
    cell.axis = axis;
    cell.plane = plane;
    cell.low = std::make_unique<Cell>();
    cell.low->corner = cell.corner;
    cell.low->top = cell.top;
    cell.low->top[axis] = plane;
    cell.low->facets = std::move(low);
    cell.low->tokens = cell.tokens;
    cell.low->windings = cell.windings;
    cell.high = std::make_unique<Cell>();
    cell.high->corner = cell.corner;
    cell.high->corner[axis] = plane;
    cell.high->top = cell.top;
    cell.high->facets = std::move(high);
    cell.high->windings = std::move(cell.windings);
    move_corner(cell, *cell.high);
    cell.high->tokens = std::move(cell.tokens);
    cell.facets = std::vector<uint32_t>();  // no memory for them
    return true;
  }

  /// Has the windings of `to` change as on the way from one cell's corner to the other's.
  void move_corner(const Cell& from, Cell& to) const {
    const size_t axis = from.axis;
    const auto u = static_cast<size_t>(u_axis(static_cast<int>(axis)));
    const auto v = static_cast<size_t>(v_axis(static_cast<int>(axis)));
    const auto is_over = [&](const FacetBox& box, size_t i) {
      const auto x = static_cast<double>(from.corner[i]);
      return static_cast<double>(box.min[i]) <= x && x <= static_cast<double>(box.max[i]);
    };
    size_t at = 0;  // in the windings: facets are in the order of operands
    for (const uint32_t facet : from.facets) {
      const FacetBox& box = boxes_[facet];
      if (!is_over(box, u) || !is_over(box, v) ||
          static_cast<double>(box.min[axis]) > static_cast<double>(from.plane)) {
        continue;
      }
      const auto corners = facets_.corners(facet);
      const auto turn = [&](const GridPoint& a, const GridPoint& b) {
        return turn_moved(a, b, from.corner, static_cast<int>(axis));
      };
      if (!is_in_column(corners, turn)) continue;
      while (to.windings[at].operand != facets_.facets[facet].operand) ++at;
      const GridPlane plane = facets_.plane(facet);
      to.windings[at].number +=
          change(side_moved(plane, from.corner), side_moved(plane, to.corner));
    }
  }

  /// Facets whose boxes meet the cell need not do so themselves: those with a corner in it do.
  void add_alone(Cell& cell) {
    const auto has_corner_in = [&](uint32_t facet) {
      return std::ranges::any_of(facets_.corners(facet), [&](const GridPoint& point) {
        for (size_t i = 0; i < 3; ++i) {
          if (point[i] < cell.corner[i] || point[i] > cell.top[i]) return false;
        }
        return true;
      });
    };
    Found& found = found_.local();
    const auto middle = std::partition(cell.facets.begin(), cell.facets.end(), has_corner_in);
    found.others.insert(found.others.end(), middle, cell.facets.end());
    cell.facets.erase(middle, cell.facets.end());
    if (!cell.facets.empty()) found.alone.push_back({std::move(cell.facets), *cell.alone});
    cell.facets = std::vector<uint32_t>();
  }

  /// Returns the pairs whose boxes meet, of different operands or of one that may cross itself.
  std::vector<std::pair<uint32_t, uint32_t>> pairs_of(std::vector<uint32_t> facets) const {
    std::vector<std::pair<uint32_t, uint32_t>> pairs;
    std::ranges::sort(facets, {}, [&](uint32_t facet) { return boxes_[facet].min[0]; });
    for (size_t i = 0; i < facets.size(); ++i) {
      const FacetBox& box = boxes_[facets[i]];
      const uint32_t operand = facets_.facets[facets[i]].operand;
      for (size_t j = i + 1; j < facets.size(); ++j) {
        const FacetBox& other = boxes_[facets[j]];
        if (other.min[0] > box.max[0]) break;
        if (!box.meets(other)) continue;
        if (operand == facets_.facets[facets[j]].operand && !may_cross_itself_[operand]) continue;
        pairs.push_back(std::minmax(facets[i], facets[j]));
      }
    }
    return pairs;
  }

  const Facets& facets_;
  const std::vector<bool>& may_cross_itself_;
  std::vector<FacetBox> boxes_;
  tbb::enumerable_thread_specific<Found> found_;
};

CellTree::CellTree(const Facets& facets, std::span<const CsgToken> tree,
                   const std::vector<bool>& may_cross_itself)
    : facets_(facets) {
  Builder(*this, may_cross_itself).run(tree, *this);
}

CellTree::~CellTree() = default;

KeptFace CellTree::kept(const std::array<const ArrangedPoint*, 3>& triangle, int axis,
                        std::span<const uint32_t> over) const {
  const Vec3 center = (triangle[0]->position + triangle[1]->position + triangle[2]->position) / 3.0;
  const Cell* cell = root_.get();
  // Rounding may choose the cell beside the right one. A facet in it reaches the plane between
  // them, too, or stands a unit away from it.
  while (cell->low) {
    const bool is_low = center[static_cast<int>(cell->axis)] < static_cast<double>(cell->plane);
    cell = (is_low ? cell->low : cell->high).get();
  }
  const auto facing = [&](uint32_t facet) {
    const auto [a, b, c] = facets_.corners(facet);
    return turn(a, b, c, axis);
  };
  if (cell->alone && cell->facets.empty()) {
    const auto place = std::ranges::find_if(over, [&](uint32_t facet) {
      return facets_.facets[facet].operand == cell->alone->operand;
    });
    if (place == over.end()) return {};
    return {cell->alone->sign * facing(*place) * facing(over.front()), cell->alone->operand};
  }
  if (cell->tokens.empty()) return {};
  std::vector<Cell::Winding> near = cell->windings;
  WayPoint from(triangle, cell->corner);
  const auto winding_of = [](std::vector<Cell::Winding>& windings, uint32_t operand) {
    const auto place = std::ranges::lower_bound(windings, operand, {}, &Cell::Winding::operand);
    return place != windings.end() && place->operand == operand ? &*place : nullptr;
  };
  bool comes_from_behind = true;
  for (const int along : {u_axis(axis), v_axis(axis), axis}) {
    if (along == axis) {
      comes_from_behind = from.side(facets_.plane(over.front())) == -facing(over.front());
    }
    WayPoint to = from;
    to.move(along);
    for (const uint32_t facet : cell->facets) {
      // The last way ends on them.
      if (along == axis && std::ranges::find(over, facet) != over.end()) continue;
      const auto turn_of_column = [&](const GridPoint& a, const GridPoint& b) {
        return from.turn(a, b, along);
      };
      if (!is_in_column(facets_.corners(facet), turn_of_column)) continue;
      const GridPlane plane = facets_.plane(facet);
      winding_of(near, facets_.facets[facet].operand)->number +=
          change(from.side(plane), to.side(plane));
    }
    from = to;
  }
  // The way ends where the triangle begins. Behind it, seen along the axis, is what its facets
  // leave by their fronts.
  std::vector<Cell::Winding> far = near;
  for (const uint32_t facet : over) {
    Cell::Winding* const winding = winding_of(far, facets_.facets[facet].operand);
    if (winding != nullptr) winding->number -= (comes_from_behind ? 1 : -1) * facing(facet);
  }
  std::vector<Cell::Winding>& behind = comes_from_behind ? near : far;
  std::vector<Cell::Winding>& ahead = comes_from_behind ? far : near;
  const auto is_in = [&](std::vector<Cell::Winding>& windings) {
    return [&](uint32_t operand) { return winding_of(windings, operand)->number != 0; };
  };
  const TreeFace face = face_of(cell->tokens, is_in(ahead), is_in(behind));
  if (face.is_held_ahead == face.is_held_behind) return {};
  return {(face.is_held_behind ? 1 : -1) * facing(over.front()), face.shown};
}

}  // namespace csgcore
