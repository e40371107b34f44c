#include "solid/operand_groups.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <compare>
#include <limits>
#include <utility>

#include "csgcore/blist.hpp"
#include "solid/extent_tests.hpp"
#include "tree/subtree_boxes.hpp"

namespace csgcore {
namespace {

/// If an operation has more than kManyOperands, they are put into groups of at most kGroupOperands.
/// Fewer than kFewOperands make no group.
constexpr size_t kManyOperands = 64;
constexpr size_t kGroupOperands = 32;
constexpr size_t kFewOperands = 4;

/// The extent of a ball of infinite radius that contains no cell, so that only the box decides.
Extent extent_of_box(const Box& box) {
  constexpr double kExtentRounding = 4 * std::numeric_limits<double>::epsilon();
  Extent extent{{}, {}, std::numeric_limits<double>::infinity(), 0.0};
  for (int axis = 0; axis < 3; ++axis) {
    const double center = 0.5 * box.min[axis] + 0.5 * box.max[axis];
    const double half = std::max(box.max[axis] - center, center - box.min[axis]);
    extent.center[axis] = center;
    extent.half[axis] = half + kExtentRounding * (half + std::abs(center));
  }
  return extent;
}

/// Returns, for each token, a box outside of which its subtree does not matter: it is false there,
/// or the operations above it do not depend on it.
std::vector<Box> relevant_boxes(std::span<const CsgToken> tokens, const Extents& extents) {
  std::vector<Box> boxes = subtree_boxes(tokens, [&](uint32_t i) { return box_of(extents[i]); });
  struct Above {
    size_t token;
    uint32_t operands_left;
  };
  std::vector<Above> above;
  for (size_t i = tokens.size(); i-- > 0;) {
    if (!above.empty()) {
      boxes[i] = intersection(boxes[i], boxes[above.back().token]);
      if (--above.back().operands_left == 0) above.pop_back();
    }
    if (!tokens[i].is_primitive) above.push_back({i, tokens[i].value});
  }
  return boxes;
}

/// Moves each of the lowest 6 bits i to bit 3·i.
constexpr uint32_t spread(uint32_t x) {
  uint32_t result = 0;
  for (uint32_t bit = 0; bit < 6; ++bit) result |= (x >> bit & 1) << 3 * bit;
  return result;
}
constexpr auto kSpread = [] {
  std::array<uint32_t, 64> table{};
  for (uint32_t i = 0; i < table.size(); ++i) table[i] = spread(i);
  return table;
}();

constexpr uint32_t kMortonBits = 18;

/// Returns the sorting key of an operand: its size class first (classes differ by a factor of 4;
/// `alike` puts all into one), then its place on a Morton curve.
uint32_t key_of(const Box& box, const Box& all, bool alike) {
  const Vec3 size = all.size();
  const double longest = std::max({size.x, size.y, size.z});
  const Vec3 own_size = box.size();
  const double own = std::max({own_size.x, own_size.y, own_size.z});
  uint32_t key = alike || 4 * own > longest ? 0
                 : 16 * own > longest       ? 1
                 : 64 * own > longest       ? 2
                                            : 3;
  key <<= kMortonBits;
  for (int axis = 0; axis < 3; ++axis) {
    const double share =
        longest > 0 ? (0.5 * box.min[axis] + 0.5 * box.max[axis] - all.min[axis]) / longest : 0;
    key |= kSpread[static_cast<size_t>(std::clamp(64 * share, 0.0, 63.0))] << axis;
  }
  return key;
}
uint32_t size_class(uint32_t key) { return key >> kMortonBits; }

/// Returns OperandGroups::Members::is_union for a group's list.
bool is_plain_union(const CellList& list) {
  for (uint32_t i = 0; i < list.count(); ++i) {
    const uint32_t next = i == 0 ? CellList::kFalse : i - 1 + CellList::kFirst;
    const bool complement = (list.primitive[i] & CellList::kComplementBit) != 0;
    if (complement || list.if_inside[i] != CellList::kTrue || list.if_outside[i] != next) {
      return false;
    }
  }
  return true;
}

struct Keyed {
  uint32_t key, index;
  auto operator<=>(const Keyed&) const = default;
};

}  // namespace

/// Rewrites a tree's tokens, with groups in place of operands.
class OperandGroups::Builder {
 public:
  Builder(OperandGroups& groups, std::span<const CsgToken> tokens)
      : groups_(groups), tokens_(tokens) {}

  void build() {
    const std::vector<Box> boxes = relevant_boxes(tokens_, groups_.extents_);
    for (size_t i = 0; i < tokens_.size(); ++i) {
      const CsgToken& token = tokens_[i];
      const uint32_t end = static_cast<uint32_t>(output_.size());
      if (!token.is_primitive) {
        close(token, boxes[i]);
      } else if (boxes[i].empty()) {
        operands_.push_back({end, end, boxes[i]});
      } else {
        output_.push_back(token);
        operands_.push_back({end, end + 1, boxes[i]});
      }
    }
    if (!output_.empty()) assign(groups_.list_, compile(std::span<const CsgToken>(output_)).tests);
    find_common();
    groups_.balls_.resize(groups_.row_size());
    for (uint32_t group = groups_.first_group_; group < groups_.count(); ++group) {
      groups_.place_members(group);
    }
    groups_.primitive_.insert(groups_.primitive_.end(), kVectorPadding, 0);
  }

 private:
  using Chosen = std::span<const Keyed>;

  /// An operand is the tokens [first, end) of the output. An empty one has none.
  struct Operand {
    uint32_t first, end;
    Box box;
    bool is_empty() const { return first == end; }
  };

  /// Replaces the last operands by one, which is the operation on them.
  void close(const CsgToken& operation, const Box& box) {
    const size_t from = operands_.size() - operation.value;
    const uint32_t first = operands_[from].first;
    const auto operands = operands_.begin() + static_cast<long>(from);
    const bool has_empty = std::any_of(operands, operands_.end(),
                                       [](const Operand& operand) { return operand.is_empty(); });
    const bool is_empty = box.empty() || (operation.op == Op::kIntersection && has_empty) ||
                          (operation.op == Op::kDifference && operands->is_empty());
    if (is_empty) output_.resize(first);
    operands_.erase(std::remove_if(operands, operands_.end(),
                                   [&](const Operand& o) { return is_empty || o.is_empty(); }),
                    operands_.end());
    if (operation.op != Op::kIntersection) {
      group(from + (operation.op == Op::kDifference && !is_empty ? 1 : 0));
    }
    const uint32_t count = static_cast<uint32_t>(operands_.size() - from);
    if (count > 1) output_.push_back({false, operation.op, count});
    operands_.resize(from);
    operands_.push_back({first, static_cast<uint32_t>(output_.size()), box});
  }

  /// Groups the operands from `from` on, which form a union, until they are not many. Those left
  /// without a group, the largest among them, come first in the list.
  void group(size_t from) {
    bool are_groups = false;
    while (operands_.size() - from > kManyOperands) {
      const size_t before = operands_.size();
      from += group_once(from, are_groups);
      are_groups = true;
      if (operands_.size() == before) return;
    }
  }

  /// Groups once. Returns how many operands are left without a group; they come first.
  size_t group_once(size_t from, bool are_groups) {
    Box all;
    for (size_t i = from; i < operands_.size(); ++i) all.merge(operands_[i].box);
    keyed_.clear();
    for (size_t i = from; i < operands_.size(); ++i) {
      keyed_.push_back({key_of(operands_[i].box, all, are_groups), static_cast<uint32_t>(i)});
    }
    std::ranges::sort(keyed_);
    given_.assign(operands_.begin() + static_cast<long>(from), operands_.end());
    const uint32_t first = operands_[from].first;
    given_tokens_.assign(output_.begin() + first, output_.end());
    for (Operand& operand : given_) operand.first -= first, operand.end -= first;
    operands_.resize(from);
    output_.resize(first);
    chosen_.clear();
    divide(keyed_);
    const auto few = std::stable_partition(chosen_.begin(), chosen_.end(),
                                           [](const Chosen& c) { return c.size() < kFewOperands; });
    for (const Chosen& chosen : std::span(chosen_.begin(), few)) {
      for (const Keyed& keyed : chosen) {
        const Operand& operand = given_[keyed.index - from];
        operands_.push_back(append(operand, output_));
      }
    }
    const size_t left = operands_.size() - from;
    for (const Chosen& chosen : std::span(few, chosen_.end())) add_group(chosen, from);
    return left;
  }

  /// Divides the range at the bits of the keys, from the highest on, until few are left in each
  /// part and they are in one size class.
  void divide(Chosen range) {
    const uint32_t difference = range.front().key ^ range.back().key;
    if (range.size() <= kGroupOperands && size_class(difference) == 0) {
      chosen_.push_back(range);
      return;
    }
    size_t half = range.size() / 2;
    if (difference != 0) {
      const uint32_t bit = std::bit_floor(difference);
      const auto above = std::partition_point(
          range.begin(), range.end(), [bit](const Keyed& keyed) { return (keyed.key & bit) == 0; });
      half = static_cast<size_t>(above - range.begin());
    }
    divide(range.first(half));
    divide(range.subspan(half));
  }

  /// Appends the operand to `tokens`, and returns it with its place there.
  Operand append(const Operand& given, std::vector<CsgToken>& tokens) const {
    const uint32_t first = static_cast<uint32_t>(tokens.size());
    tokens.insert(tokens.end(), given_tokens_.begin() + given.first,
                  given_tokens_.begin() + given.end);
    return {first, static_cast<uint32_t>(tokens.size()), given.box};
  }

  void add_group(Chosen chosen, size_t from) {
    Box box;
    group_tokens_.clear();
    for (const Keyed& keyed : chosen) {
      box.merge(append(given_[keyed.index - from], group_tokens_).box);
    }
    group_tokens_.push_back({false, Op::kUnion, static_cast<uint32_t>(chosen.size())});
    const uint32_t first = static_cast<uint32_t>(output_.size());
    output_.push_back({true, Op::kUnion, make_group(box)});
    operands_.push_back({first, first + 1, box});
  }

  /// Makes a group of the union in group_tokens_, and returns its index.
  uint32_t make_group(const Box& box) {
    const Blist list = compile(std::span<const CsgToken>(group_tokens_));
    assign(list_, list.tests);
    const uint32_t count = list_.count();
    const auto append = [count](std::vector<uint32_t>& to, const std::vector<uint32_t>& from) {
      to.insert(to.end(), from.begin(), from.begin() + count);
    };
    groups_.members_.push_back(
        {static_cast<uint32_t>(groups_.primitive_.size()), count, is_plain_union(list_)});
    append(groups_.primitive_, list_.primitive);
    append(groups_.if_inside_, list_.if_inside);
    append(groups_.if_outside_, list_.if_outside);
    groups_.extents_.push_back(extent_of_box(box));
    return static_cast<uint32_t>(groups_.extents_.size() - 1);
  }

  void find_common() {
    constexpr uint8_t kMany = 2;
    std::vector<uint8_t> uses(groups_.extents_.size());
    for (const uint32_t entry : groups_.primitive_) {
      uint8_t& number = uses[entry & kPrimitiveBits];
      number = std::min<uint8_t>(number + 1, kMany);
    }
    for (const uint32_t entry : groups_.list_.primitives()) uses[entry & kPrimitiveBits] = kMany;
    for (uint32_t index = 0; index < uses.size(); ++index) {
      if (uses[index] == kMany) groups_.common_.push_back(index);
    }
  }

  OperandGroups& groups_;
  std::span<const CsgToken> tokens_;
  std::vector<CsgToken> output_;
  std::vector<Operand> operands_;  // those that wait for their operation
  // Working memory of group_once():
  std::vector<Keyed> keyed_;
  std::vector<Chosen> chosen_;  // of keyed_
  std::vector<Operand> given_;
  std::vector<CsgToken> given_tokens_, group_tokens_;
  CellList list_;
};

OperandGroups::OperandGroups(const CsgTree& tree, Extents extents)
    : extents_(std::move(extents)), first_group_(static_cast<uint32_t>(extents_.size())) {
  Builder(*this, tree.tokens()).build();
}

BallRows OperandGroups::balls(uint32_t group) const {
  const auto [x, y, z, radius] = members(group).rows(balls_.data());
  return {x, y, z, radius};
}

void OperandGroups::place_members(uint32_t group) {
  const Extent& whole = extents_[group];
  const Members all = members(group);
  const std::array<float*, 4> rows = all.rows(balls_.data());
  for (size_t i = 0; i < all.primitive.size(); ++i) {
    const Extent& extent = extents_[all.primitive[i] & kPrimitiveBits];
    for (size_t axis = 0; axis < 3; ++axis) {
      rows[axis][i] = static_cast<float>(extent.center[axis] - whole.center[axis]);
    }
    const bool is_ball = std::isfinite(extent.outside2);
    rows[3][i] =
        static_cast<float>(is_ball ? std::sqrt(extent.outside2)
                                   : std::hypot(extent.half[0], extent.half[1], extent.half[2]));
  }
}

}  // namespace csgcore
