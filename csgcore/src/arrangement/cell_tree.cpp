#include "arrangement/cell_tree.hpp"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <optional>

#include "arrangement/sorted_by_key.hpp"
#include "csgcore/stop_scope.hpp"

namespace csgcore {

struct CellTree::Cell {
  // A branch: what lies below the plane, and what lies above it.
  size_t axis = 0;
  int64_t plane = 0;
  std::unique_ptr<Cell> low;
  std::unique_ptr<Cell> high;
  // A leaf.
  GridPoint corner{};  // the lowest
  GridPoint top{};     // the highest corner
  TreeTokens tokens;
  std::vector<uint32_t> facets;   // of the operands in the tree, in rising order
  std::optional<KeptFace> alone;  // if there is one operand only, which does not cross itself
};

class CellTree::Builder {
 public:
  Builder(CellTree& result, const std::vector<bool>& may_cross_itself,
          const std::vector<uint32_t>& needed)
      : facets_(result.facets_),
        trees_(result.trees_),
        may_cross_itself_(may_cross_itself),
        needed_(needed) {}

  void run(std::span<const CsgToken> tree, CellTree& result) {
    auto root = std::make_unique<Cell>();
    root->tokens.assign(tree.begin(), tree.end());
    root->facets.resize(needed_.size());
    std::iota(root->facets.begin(), root->facets.end(), 0u);
    for (const GridPoint& point : facets_.points) {
      for (size_t i = 0; i < 3; ++i) {
        root->corner[i] = std::min(root->corner[i], point[i] - 1);
        root->top[i] = std::max(root->top[i], point[i] + 1);
      }
    }
    build(*root, 0);
    result.root_ = std::move(root);
    for (Found& found : found_) {
      result.pairs_.insert(result.pairs_.end(), found.pairs.begin(), found.pairs.end());
      found.pairs = {};
      result.others_.insert(result.others_.end(), found.others.begin(), found.others.end());
      std::ranges::move(found.alone, std::back_inserter(result.alone_));
    }
    auto& pairs = result.pairs_;
    sort_by_key(pairs, facets_.facets.size(), [](const auto& pair) { return pair.first; });
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  }

 private:
  struct Found {
    std::vector<std::pair<uint32_t, uint32_t>> pairs;
    std::vector<uint32_t> others;
    std::vector<Alone> alone;
  };

  const FacetBox& box_of(uint32_t place) const { return trees_.facet_box(needed_[place]); }
  uint32_t operand_of(uint32_t place) const { return facets_.facets[needed_[place]].operand; }

  void build(Cell& cell, int depth) {
    stop_point();
    const FacetBox box = box_between(cell.corner, cell.top);
    std::erase_if(cell.facets, [&](uint32_t place) {
      return !box.holds(box_of(place)) && !trees_.may_meet(needed_[place], box);
    });
    restrict(cell);
    if (cell.facets.empty()) return;
    if (cell.alone) {
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
      if (!is_small) pairs = pairs_of(cell.facets);
      Found& found = found_.local();
      for (const uint32_t place : cell.facets) found.others.push_back(needed_[place]);
      for (const auto& [a, b] : pairs) found.pairs.push_back({needed_[a], needed_[b]});
      cell.facets = std::vector<uint32_t>();
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

  /// Leaves out what does not matter in the cell. An operand without a facet there, needed or not,
  /// holds all of the cell or nothing of it.
  void restrict(Cell& cell) const {
    std::vector<uint32_t> here;
    for (const uint32_t place : cell.facets) {
      const uint32_t operand = operand_of(place);
      if (here.empty() || here.back() != operand) here.push_back(operand);
    }
    const FacetBox box = box_between(cell.corner, cell.top);
    const auto held = [&](uint32_t operand) {
      if (std::ranges::binary_search(here, operand)) return Held::kHere;
      if (trees_.is_empty(operand) || !trees_.box(operand).meets(box)) return Held::kNo;
      if (trees_.meet(operand, box)) return Held::kHere;
      const auto none = [](uint32_t) { return false; };
      const int winding = trees_.winding(operand, MovedPoint(cell.corner), 0, none);
      return winding != 0 ? Held::kYes : Held::kNo;
    };
    cell.tokens = restricted(cell.tokens, held);
    std::vector<uint32_t> matters;
    for (const CsgToken& token : cell.tokens) {
      if (token.is_primitive && token.value != kNoPlace) matters.push_back(token.value);
    }
    std::ranges::sort(matters);
    const auto is_left_out = [&](uint32_t place) {
      return !std::ranges::binary_search(matters, operand_of(place));
    };
    if (!std::ranges::includes(matters, here)) std::erase_if(cell.facets, is_left_out);
    if (matters.size() == 1 && !may_cross_itself_[matters.front()]) {
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
      const FacetBox& box = box_of(list[i]);
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
      return static_cast<double>(box_of(facet).min[axis]) <= at;
    };
    const auto is_high = [&](uint32_t facet) {
      return static_cast<double>(box_of(facet).max[axis]) >= at;
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
    cell.high = std::make_unique<Cell>();
    cell.high->corner = cell.corner;
    cell.high->corner[axis] = plane;
    cell.high->top = cell.top;
    cell.high->facets = std::move(high);
    cell.high->tokens = std::move(cell.tokens);
    cell.facets = std::vector<uint32_t>();  // no memory for them
    return true;
  }

  /// Facets whose boxes meet the cell need not do so themselves: those with a corner in it do.
  void add_alone(Cell& cell) {
    const auto has_corner_in = [&](uint32_t place) {
      return std::ranges::any_of(facets_.corners(needed_[place]), [&](const GridPoint& point) {
        for (size_t i = 0; i < 3; ++i) {
          if (point[i] < cell.corner[i] || point[i] > cell.top[i]) return false;
        }
        return true;
      });
    };
    Found& found = found_.local();
    Alone alone{{}, *cell.alone};
    for (const uint32_t place : cell.facets) {
      (has_corner_in(place) ? alone.facets : found.others).push_back(needed_[place]);
    }
    if (!alone.facets.empty()) found.alone.push_back(std::move(alone));
    cell.facets = std::vector<uint32_t>();
  }

  /// Returns the pairs whose boxes meet, of different operands or of one that may cross itself.
  std::vector<std::pair<uint32_t, uint32_t>> pairs_of(const std::vector<uint32_t>& places) const {
    struct Boxed {
      FacetBox box;
      uint32_t place;
      uint32_t operand;  // kNoPlace if it may cross itself: it is compared with all
    };
    std::vector<std::pair<uint32_t, uint32_t>> pairs;
    const uint32_t first = operand_of(places.front());
    if (operand_of(places.back()) == first && !may_cross_itself_[first]) return pairs;
    std::vector<Boxed> boxed;
    boxed.reserve(places.size());
    for (const uint32_t place : places) {
      const uint32_t operand = operand_of(place);
      boxed.push_back({box_of(place), place, may_cross_itself_[operand] ? kNoPlace : operand});
    }
    std::ranges::sort(boxed, {}, [](const Boxed& item) { return item.box.min[0]; });
    for (size_t i = 0; i < boxed.size(); ++i) {
      const Boxed& item = boxed[i];
      for (size_t j = i + 1; j < boxed.size() && boxed[j].box.min[0] <= item.box.max[0]; ++j) {
        const Boxed& other = boxed[j];
        if (item.operand == other.operand && item.operand != kNoPlace) continue;
        if (item.box.meets(other.box) && trees_.may_meet(needed_[item.place], other.box) &&
            trees_.may_meet(needed_[other.place], item.box)) {
          pairs.push_back(std::minmax(item.place, other.place));
        }
      }
    }
    return pairs;
  }

  const Facets& facets_;
  const FacetTrees& trees_;
  const std::vector<bool>& may_cross_itself_;
  const std::vector<uint32_t>& needed_;  // facets, whose places in it the cells hold
  tbb::enumerable_thread_specific<Found> found_;
};

CellTree::CellTree(const Facets& facets, const FacetTrees& trees, std::span<const CsgToken> tree,
                   const std::vector<bool>& may_cross_itself, const std::vector<uint32_t>& divided)
    : facets_(facets), trees_(trees) {
  Builder(*this, may_cross_itself, divided).run(tree, *this);
}

CellTree::~CellTree() = default;

KeptFace CellTree::kept(const std::array<const ArrangedPoint*, 3>& triangle, int axis,
                        std::span<const uint32_t> over) const {
  const MovedCenter center(facets_, triangle);
  const Cell* cell = root_.get();
  // Rounding may choose the cell beside the right one. A facet in it reaches the plane between
  // them, too, or stands a unit away from it.
  while (cell->low) {
    const double x = center.position()[static_cast<int>(cell->axis)];
    cell = (x < static_cast<double>(cell->plane) ? cell->low : cell->high).get();
  }
  const auto facing = [&](uint32_t facet) {
    const auto [a, b, c] = facets_.corners(facet);
    return turn(a, b, c, axis);
  };
  if (cell->alone) {
    const auto place = std::ranges::find_if(over, [&](uint32_t facet) {
      return facets_.facets[facet].operand == cell->alone->operand;
    });
    if (place == over.end()) return {};
    return {cell->alone->sign * facing(*place) * facing(over.front()), cell->alone->operand};
  }
  if (cell->tokens.empty()) return {};
  // Ahead of the triangle, along the axis, are the facets beyond those over it. Behind it is what
  // these leave by their fronts, too.
  struct Winding {
    uint32_t operand;
    int ahead;
    int behind;
  };
  std::vector<Winding> windings;
  const auto is_over = [&](uint32_t facet) { return std::ranges::find(over, facet) != over.end(); };
  for (const CsgToken& token : cell->tokens) {
    if (!token.is_primitive || token.value == kNoPlace) continue;
    const int ahead = trees_.winding(token.value, center, axis, is_over);
    windings.push_back({token.value, ahead, ahead});
    for (const uint32_t facet : over) {
      if (facets_.facets[facet].operand == token.value) windings.back().behind += facing(facet);
    }
  }
  const auto winding_of = [&](uint32_t operand) {
    return *std::ranges::find(windings, operand, &Winding::operand);
  };
  const TreeFace face = face_of(
      cell->tokens, [&](uint32_t operand) { return winding_of(operand).ahead != 0; },
      [&](uint32_t operand) { return winding_of(operand).behind != 0; });
  if (face.is_held_ahead == face.is_held_behind) return {};
  return {(face.is_held_behind ? 1 : -1) * facing(over.front()), face.shown};
}

}  // namespace csgcore
