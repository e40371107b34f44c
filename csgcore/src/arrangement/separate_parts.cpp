#include "arrangement/separate_parts.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <glm/common.hpp>
#include <utility>

namespace csgcore {
namespace {

/// Closer ones count as touching, in shares of the longest side of the box of all: rounding to the
/// grid, which has 2^-37 of it or finer, moves a point by less.
constexpr double kLeastGap = 0x1p-32;

/// An operand of the union: tokens, and a box that holds what they make.
struct Operand {
  size_t begin, end;
  Box box;
};

/// Returns the operands of the union that the tree is.
std::vector<Operand> operands_of(std::span<const CsgToken> tokens, const std::vector<Box>& boxes) {
  const bool is_union =
      !tokens.empty() && !tokens.back().is_primitive && tokens.back().op == Op::kUnion;
  std::vector<Operand> open;  // subtrees that no operation has taken
  for (size_t i = 0; i < tokens.size() - (is_union ? 1 : 0); ++i) {
    const CsgToken& token = tokens[i];
    if (token.is_primitive) {
      open.push_back({i, i + 1, boxes[token.value]});
      continue;
    }
    const size_t first = open.size() - token.value;
    for (size_t j = first + 1; j < open.size(); ++j) {
      if (token.op == Op::kUnion) open[first].box.merge(open[j].box);
      if (token.op == Op::kIntersection) {
        open[first].box = intersection(open[first].box, open[j].box);
      }
    }
    open[first].end = i + 1;
    open.resize(first + 1);
  }
  std::erase_if(open, [](const Operand& operand) { return operand.box.empty(); });
  return open;
}

/// Divides operands at gaps between them along one axis after the other, until there are none.
class Division {
 public:
  Division(std::vector<Operand>& operands, double least_gap)
      : operands_(operands), least_gap_(least_gap) {}

  /// Returns where each part begins among the operands, whose order changes, and their end.
  std::vector<size_t> run() {
    std::vector<size_t> begins;
    std::vector<Group> open{{0, operands_.size(), 0, 0}};
    while (!open.empty()) {
      const Group group = open.back();
      open.pop_back();
      if (group.end - group.begin < 2 || group.axes_without_gap == 3) {
        begins.push_back(group.begin);
      } else {
        divide(group, open);
      }
    }
    std::ranges::sort(begins);
    begins.push_back(operands_.size());
    return begins;
  }

 private:
  struct Group {
    size_t begin, end;
    int axis;
    int axes_without_gap;
  };

  void divide(const Group& group, std::vector<Group>& open) {
    const auto first = operands_.begin();
    std::stable_sort(first + static_cast<std::ptrdiff_t>(group.begin),
                     first + static_cast<std::ptrdiff_t>(group.end),
                     [axis = group.axis](const Operand& a, const Operand& b) {
                       return a.box.min[axis] < b.box.min[axis];
                     });
    const int next = (group.axis + 1) % 3;
    size_t begin = group.begin;
    double reach = operands_[begin].box.max[group.axis];
    for (size_t i = begin + 1; i < group.end; ++i) {
      const Box& box = operands_[i].box;
      if (box.min[group.axis] - reach > least_gap_) {
        open.push_back({begin, i, next, 0});
        begin = i;
      }
      reach = std::max(reach, box.max[group.axis]);
    }
    const bool is_whole = begin == group.begin;
    open.push_back({begin, group.end, next, is_whole ? group.axes_without_gap + 1 : 0});
  }

  std::vector<Operand>& operands_;
  double least_gap_;
};

SeparatePart part_of(std::span<const Operand> operands, std::span<const CsgToken> tokens) {
  SeparatePart part;
  for (const Operand& operand : operands) {
    for (const CsgToken& token : tokens.subspan(operand.begin, operand.end - operand.begin)) {
      part.tokens.push_back(token);
      if (token.is_primitive) part.operands.push_back(token.value);
    }
  }
  if (operands.size() > 1) {
    part.tokens.push_back({false, Op::kUnion, static_cast<uint32_t>(operands.size())});
  }
  std::ranges::sort(part.operands);
  part.operands.erase(std::unique(part.operands.begin(), part.operands.end()), part.operands.end());
  for (CsgToken& token : part.tokens) {
    if (!token.is_primitive) continue;
    const auto place = std::ranges::lower_bound(part.operands, token.value);
    token.value = static_cast<uint32_t>(place - part.operands.begin());
  }
  return part;
}

}  // namespace

std::vector<SeparatePart> separate_parts(std::span<const TriangleSet> operands,
                                         const CsgTree& tree) {
  std::vector<Box> boxes(operands.size());
  tbb::parallel_for(size_t{0}, operands.size(), [&](size_t i) {
    for (const Vec3& vertex : operands[i].vertices) boxes[i].merge(vertex);
  });
  const std::span<const CsgToken> tokens = tree.tokens();
  std::vector<Operand> united = operands_of(tokens, boxes);
  Box all;
  for (const Operand& operand : united) all.merge(operand.box);
  const Vec3 size = all.empty() ? Vec3(0.0) : all.size();
  const std::vector<size_t> begins =
      Division(united, kLeastGap * std::max({size.x, size.y, size.z})).run();
  std::vector<SeparatePart> parts(begins.size() - 1);
  tbb::parallel_for(size_t{0}, parts.size(), [&](size_t i) {
    const std::span<Operand> own = std::span(united).subspan(begins[i], begins[i + 1] - begins[i]);
    std::ranges::sort(own, {}, &Operand::begin);
    parts[i] = part_of(own, tokens);
  });
  std::erase_if(parts, [](const SeparatePart& part) { return part.operands.empty(); });
  std::ranges::sort(parts, {}, [](const SeparatePart& part) { return part.operands.front(); });
  return parts;
}

}  // namespace csgcore
