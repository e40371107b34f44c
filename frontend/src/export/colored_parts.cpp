#include "export/colored_parts.hpp"

#include <algorithm>
#include <array>
#include <set>
#include <utility>

#include "csgcore/stop_scope.hpp"
#include "solids/leaves.hpp"

namespace frontend {
namespace {

using csgcore::Box;
using csgcore::Color;
using csgcore::CsgToken;
using csgcore::CsgTreeBuilder;
using csgcore::Op;

/// How much of a subtree's volume has the colour at hand.
enum class Share : uint8_t { kNothing, kSome, kAll };

/// Writes the part of a tree that has one colour. A subtree is named by the index of its last
/// token.
class ColorDivider {
 public:
  ColorDivider(std::span<const CsgToken> tokens, std::span<const Box> boxes)
      : tokens_(tokens),
        subtrees_(tokens),
        boxes_(subtree_boxes(tokens, boxes)),
        shares_(tokens.size()) {}

  template <typename HasColor>
  csgcore::CsgTree part(const HasColor& has_color) {
    find_shares(has_color);
    if (tokens_.empty()) return {};
    push(Step::kColor, static_cast<uint32_t>(tokens_.size()) - 1);
    while (!steps_.empty()) {
      const Step step = steps_.back();
      steps_.pop_back();
      take(step);
    }
    return builder_.finish();
  }

 private:
  struct Step {
    enum Kind : uint8_t { kOpen, kWhole, kColor, kClose } kind;
    uint32_t subtree = 0;
    Op op = Op::kUnion;
  };

  void push(Step::Kind kind, uint32_t subtree = 0, Op op = Op::kUnion) {
    steps_.push_back({kind, subtree, op});
  }

  template <typename HasColor>
  void find_shares(const HasColor& has_color) {
    std::vector<Share> done;
    for (size_t i = 0; i < tokens_.size(); ++i) {
      const CsgToken& token = tokens_[i];
      if (token.is_primitive) {
        shares_[i] = has_color(token.value) ? Share::kAll : Share::kNothing;
      } else {
        const auto operands = std::span(done).last(token.value);
        const bool are_equal = token.op != Op::kUnion ||
                               std::all_of(operands.begin(), operands.end(),
                                           [&](Share share) { return share == operands.front(); });
        shares_[i] = are_equal ? operands.front() : Share::kSome;
        done.resize(done.size() - token.value);
      }
      done.push_back(shares_[i]);
    }
  }

  void take(const Step& step) {
    switch (step.kind) {
      case Step::kOpen:
        return builder_.open(step.op);
      case Step::kClose:
        return builder_.close();
      case Step::kWhole:
        return add_whole(step.subtree);
      case Step::kColor:
        break;
    }
    if (shares_[step.subtree] == Share::kNothing) return builder_.empty();
    if (shares_[step.subtree] == Share::kAll) return add_whole(step.subtree);
    if (tokens_[step.subtree].op == Op::kUnion) return divide_union(step.subtree);
    // The colour is that of the first operand.
    std::vector<uint32_t> operands = subtrees_.operands(step.subtree);
    push(Step::kClose);
    for (size_t i = operands.size(); i-- > 1;) push(Step::kWhole, operands[i]);
    push(Step::kColor, operands.front());
    push(Step::kOpen, 0, tokens_[step.subtree].op);
  }

  void add_whole(uint32_t subtree) { add_tree(subtrees_.tokens(subtree), builder_); }

  /// What the operands leave one after another: each adds its volume of the colour, and takes away
  /// the rest of its volume from what was there before.
  void divide_union(uint32_t subtree) {
    struct Run {
      Share share;
      std::vector<uint32_t> operands;
    };
    std::vector<Run> runs;
    Box box;  // of what is there before
    for (const uint32_t operand : subtrees_.operands(subtree)) {
      const Share share = shares_[operand];
      const bool meets = !csgcore::intersection(boxes_[operand], box).empty();
      if (share != Share::kAll && meets) {
        add_to_run(runs, Share::kNothing, operand);
      }
      if (share == Share::kNothing) continue;
      add_to_run(runs, Share::kAll, operand);
      box.merge(boxes_[operand]);
    }
    const size_t at = steps_.size();
    for (const Run& run : runs)
      push(Step::kOpen, 0, run.share == Share::kAll ? Op::kUnion : Op::kDifference);
    std::reverse(steps_.begin() + static_cast<long>(at), steps_.end());
    for (const Run& run : runs) {
      for (const uint32_t operand : run.operands) {
        push(run.share == Share::kAll ? Step::kColor : Step::kWhole, operand);
      }
      push(Step::kClose);
    }
    std::reverse(steps_.begin() + static_cast<long>(at), steps_.end());
  }

  template <typename Run>
  static void add_to_run(std::vector<Run>& runs, Share share, uint32_t operand) {
    if (runs.empty() || runs.back().share != share) runs.push_back({share, {}});
    runs.back().operands.push_back(operand);
  }

  std::span<const CsgToken> tokens_;
  CsgSubtrees subtrees_;
  std::vector<Box> boxes_;     // by subtree
  std::vector<Share> shares_;  // by subtree
  std::vector<Step> steps_;    // the next one last
  CsgTreeBuilder builder_;
};

}  // namespace

std::vector<ColoredTree> colored_trees(
    const csgcore::CsgTree& tree, std::span<const Box> boxes,
    const std::function<std::optional<Color>(uint32_t primitive)>& color_of) {
  std::vector<ColoredTree> parts;
  std::vector<std::optional<Color>> colors;
  std::set<std::array<float, 5>> known;
  for (const CsgToken& token : tree.tokens()) {
    if (!token.is_primitive) continue;
    const std::optional<Color> color = color_of(token.value);
    const Color c = color.value_or(Color{0, 0, 0, 0});
    if (known.insert({color ? 1.0f : 0.0f, c.r, c.g, c.b, c.a}).second) colors.push_back(color);
  }
  if (colors.size() == 1) return {{tree, colors.front()}};
  ColorDivider divider(tree.tokens(), boxes);
  for (const std::optional<Color>& color : colors) {
    csgcore::stop_point();
    csgcore::CsgTree part =
        divider.part([&](uint32_t primitive) { return color_of(primitive) == color; });
    if (!part.empty()) parts.push_back({std::move(part), color});
  }
  return parts;
}

}  // namespace frontend
