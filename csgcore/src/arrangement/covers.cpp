#include "arrangement/covers.hpp"

#include <tbb/parallel_for.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "arrangement/exact_center.hpp"
#include "csgcore/stop_scope.hpp"

namespace csgcore {

Decisions::Decisions(std::span<const CsgToken> tokens, size_t operands)
    : leaf_of_(operands, kNowhere), decided_(operands), parent_of_(tokens.size(), kNowhere) {
  std::vector<size_t> begin_of(tokens.size());
  std::vector<bool> is_first(tokens.size(), false);
  std::vector<size_t> open;  // subtrees that no operation has taken
  for (size_t i = 0; i < tokens.size(); ++i) {
    begin_of[i] = i;
    if (!tokens[i].is_primitive) {
      const size_t first = open.size() - tokens[i].value;
      begin_of[i] = begin_of[open[first]];
      is_first[open[first]] = true;
      for (size_t j = first; j < open.size(); ++j) parent_of_[open[j]] = i;
      open.resize(first);
    }
    open.push_back(i);
  }
  // By token and its value: the largest subtree that has one value wherever it has that.
  std::vector<std::array<size_t, 2>> largest(tokens.size());
  for (size_t i = tokens.size(); i-- > 0;) {
    for (const bool value : {false, true}) {
      largest[i][value ? 1 : 0] = i;
      if (parent_of_[i] == kNowhere) continue;
      const Op op = tokens[parent_of_[i]].op;
      const bool is_subtracted = op == Op::kDifference && !is_first[i];
      if (value != (op == Op::kUnion || is_subtracted)) continue;
      const bool parent_value = op == Op::kUnion;
      largest[i][value ? 1 : 0] = largest[parent_of_[i]][parent_value ? 1 : 0];
    }
  }
  outside_at_.resize(tokens.size());
  std::vector<bool> is_known(operands, false);
  for (size_t i = 0; i < tokens.size(); ++i) {
    if (!tokens[i].is_primitive) continue;
    const uint32_t operand = tokens[i].value;
    // What the tree has twice is not judged.
    leaf_of_[operand] = is_known[operand] ? kNowhere : i;
    is_known[operand] = true;
  }
  for (uint32_t operand = 0; operand < operands; ++operand) {
    const size_t leaf = leaf_of_[operand];
    if (leaf == kNowhere) continue;
    for (const size_t value : {0u, 1u}) {
      const size_t node = largest[leaf][value];
      if (node == leaf) continue;
      decided_[operand][value] = {begin_of[node], node + 1};
      if (value == 0) outside_at_[node].push_back(operand);
    }
  }
}

Covers::Covers(const Facets& facets, const FacetTrees& trees, std::span<const CsgToken> tokens,
               const std::vector<bool>& may_cross_itself)
    : trees_(trees),
      decisions_(tokens, trees.size()),
      behind_(trees.size()),
      last_before_(trees.size()) {
  std::vector<uint32_t> operands;
  std::vector<FacetBox> boxes;
  for (uint32_t i = 0; i < trees.size(); ++i) {
    if (trees.is_empty(i)) continue;
    operands.push_back(i);
    boxes.push_back(trees.box(i));
  }
  operands_ = BoxTree(boxes, placed_);
  for (uint32_t& place : placed_) place = operands[place];
  // The facets of finer surfaces have boxes that are close to them.
  constexpr uint32_t kMostFacets = 256;
  const std::stop_token* const stop = stop_of_work;
  tbb::parallel_for(size_t{0}, operands.size(), [&](size_t place) {
    const StopScope scope(stop);
    stop_point();
    const uint32_t operand = operands[place];
    const uint32_t first = trees.first(operand);
    const uint32_t count = trees.end(operand) - first;
    if (may_cross_itself[operand] || count > kMostFacets) return;
    behind_[operand].reserve(count);
    for (uint32_t i = 0; i < count; ++i) {
      const GridPlane plane = facets.plane(first + i);
      const Vec3 normal = glm::normalize(plane.rounded_normal);
      behind_[operand].push_back({normal, glm::dot(normal, to_vec3(plane.point))});
    }
  });
}

bool Covers::hold(uint32_t operand, std::span<const Vec3> points) const {
  // Far more than all is rounded by: 2^-53 of 2^kGridBits a few times, and the points.
  constexpr double kBehind = 1;
  const std::vector<Behind>& all = behind_[operand];
  if (all.empty()) return false;
  const auto are_behind = [&](const Behind& facet) {
    return std::ranges::all_of(points, [&](const Vec3& point) {
      return glm::dot(facet.normal, point) < facet.offset - kBehind;
    });
  };
  // What lies before a facet often lies before that of the last points, too.
  std::atomic<uint32_t>& last = last_before_[operand];
  if (!are_behind(all[last.load(std::memory_order_relaxed)])) return false;
  const auto before = std::ranges::find_if_not(all, are_behind);
  if (before == all.end()) return true;
  last.store(static_cast<uint32_t>(before - all.begin()), std::memory_order_relaxed);
  return false;
}

bool Covers::hide(const std::array<Vec3, 2>& ends, uint32_t a, uint32_t b, uint32_t& last) const {
  GridPoint least;
  GridPoint most;
  for (size_t i = 0; i < 3; ++i) {
    const auto [low, high] =
        std::minmax(ends[0][static_cast<int>(i)], ends[1][static_cast<int>(i)]);
    least[i] = std::llrint(low) - 1;
    most[i] = std::llrint(high) + 1;
  }
  const FacetBox box = box_between(least, most);
  const auto hides = [&](uint32_t operand) {
    if (operand == a || operand == b || !trees_.box(operand).holds(box) ||
        !decisions_.decides(operand, true, a) || !decisions_.decides(operand, true, b)) {
      return false;
    }
    if (!behind_[operand].empty()) return hold(operand, ends);
    const auto none = [](uint32_t) { return false; };
    return !trees_.meet(operand, box) && trees_.winding(operand, MovedPoint(least), 0, none) != 0;
  };
  if (last != kNoPlace && hides(last)) return true;
  const auto may_hide = [&](const FacetBox& other) { return other.holds(box); };
  return operands_.visit(may_hide, [&](uint32_t begin, uint32_t end) {
    const auto place = std::find_if(placed_.begin() + begin, placed_.begin() + end, hides);
    if (place == placed_.begin() + end) return false;
    last = *place;
    return true;
  });
}

}  // namespace csgcore
