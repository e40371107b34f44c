#include "arrangement/tree_values.hpp"

#include <algorithm>
#include <optional>

namespace csgcore {
namespace {

/// The outcome of a subtree: a constant, or the tokens from `begin` on.
struct Outcome {
  std::optional<bool> constant;
  size_t begin;
};

constexpr CsgToken kAllOfSpace{true, Op::kUnion, kNoPlace};

class Restriction {
 public:
  explicit Restriction(const std::function<Held(uint32_t operand)>& held) : held_(held) {}

  TreeTokens run(std::span<const CsgToken> tokens) {
    for (const CsgToken& token : tokens) {
      token.is_primitive ? add_operand(token) : operate(token);
    }
    if (done_.empty() || done_.back().constant == false) return {};
    if (done_.back().constant == true) return {kAllOfSpace};
    return std::move(result_);
  }

 private:
  void add_operand(const CsgToken& token) {
    const Held held = token.value == kNoPlace ? Held::kYes : held_(token.value);
    if (held != Held::kHere) {
      done_.push_back({held == Held::kYes, result_.size()});
      return;
    }
    done_.push_back({std::nullopt, result_.size()});
    result_.push_back(token);
  }

  void operate(const CsgToken& token) {
    const std::span<const Outcome> operands = std::span(done_).subspan(done_.size() - token.value);
    const size_t begin = operands.front().begin;
    const bool is_difference = token.op == Op::kDifference;
    const Outcome& first = operands.front();
    const std::span<const Outcome> others = operands.subspan(is_difference ? 1 : 0);
    const auto is = [](bool value) {
      return [value](const Outcome& outcome) { return outcome.constant == value; };
    };
    std::optional<bool> constant;
    if (is_difference && (first.constant == false || std::ranges::any_of(others, is(true)))) {
      constant = false;
    } else if (token.op == Op::kUnion && std::ranges::any_of(others, is(true))) {
      constant = true;
    } else if (token.op == Op::kIntersection && std::ranges::any_of(others, is(false))) {
      constant = false;
    }
    const auto left = static_cast<uint32_t>(std::ranges::count_if(
        others, [](const Outcome& outcome) { return !outcome.constant.has_value(); }));
    if (!constant && left == 0 && !is_difference) constant = token.op == Op::kIntersection;
    if (!constant && left == 0 && is_difference) constant = first.constant;
    done_.resize(done_.size() - token.value);
    if (constant) {
      result_.resize(begin);
    } else if (is_difference && left > 0) {
      if (first.constant == true) {
        result_.insert(result_.begin() + static_cast<std::ptrdiff_t>(begin), kAllOfSpace);
      }
      result_.push_back({false, token.op, left + 1});
    } else if (!is_difference && left > 1) {
      result_.push_back({false, token.op, left});
    }
    done_.push_back({constant, begin});
  }

  const std::function<Held(uint32_t operand)>& held_;
  std::vector<Outcome> done_;  // subtrees that no operation has taken
  TreeTokens result_;
};

}  // namespace

TreeTokens restricted(std::span<const CsgToken> tokens,
                      const std::function<Held(uint32_t operand)>& held) {
  return Restriction(held).run(tokens);
}

TreeFace face_of(std::span<const CsgToken> tokens,
                 const std::function<bool(uint32_t operand)>& ahead,
                 const std::function<bool(uint32_t operand)>& behind) {
  struct Node {
    bool is_ahead;
    bool is_behind;
    size_t parent;
    bool is_subtracted;
  };
  TreeFace result{false, false};
  if (tokens.empty()) return result;
  std::vector<Node> nodes(tokens.size());
  std::vector<size_t> open;  // nodes without a parent so far
  for (size_t i = 0; i < tokens.size(); ++i) {
    const CsgToken& token = tokens[i];
    Node& node = nodes[i];
    if (token.is_primitive) {
      const bool is_all = token.value == kNoPlace;
      node = {is_all || ahead(token.value), is_all || behind(token.value), i, false};
      open.push_back(i);
      continue;
    }
    const size_t first = open.size() - token.value;
    node = {nodes[open[first]].is_ahead, nodes[open[first]].is_behind, i, false};
    nodes[open[first]].parent = i;
    for (size_t j = first + 1; j < open.size(); ++j) {
      Node& operand = nodes[open[j]];
      operand.parent = i;
      operand.is_subtracted = token.op == Op::kDifference;
      if (token.op == Op::kUnion) {
        node.is_ahead = node.is_ahead || operand.is_ahead;
        node.is_behind = node.is_behind || operand.is_behind;
      } else {
        node.is_ahead = node.is_ahead && operand.is_ahead != operand.is_subtracted;
        node.is_behind = node.is_behind && operand.is_behind != operand.is_subtracted;
      }
    }
    open.resize(first);
    open.push_back(i);
  }
  const auto turn = [&](size_t i) { return int{nodes[i].is_ahead} - int{nodes[i].is_behind}; };
  const size_t root = tokens.size() - 1;
  result.is_held_ahead = nodes[root].is_ahead;
  result.is_held_behind = nodes[root].is_behind;
  if (turn(root) == 0) return result;
  // From the root down, a turn is due to those operands that turned the same way, or, if they are
  // subtracted, the other way.
  std::vector<bool> is_due(tokens.size(), false);
  is_due[root] = true;
  for (size_t i = tokens.size(); i-- > 0;) {
    const Node& node = nodes[i];
    if (i != root) {
      is_due[i] = is_due[node.parent] &&
                  turn(i) == (node.is_subtracted ? -turn(node.parent) : turn(node.parent));
    }
    if (!is_due[i] || !tokens[i].is_primitive || tokens[i].value == kNoPlace) continue;
    if (result.shown == kNoPlace || tokens[i].value > result.shown) result.shown = tokens[i].value;
  }
  return result;
}

}  // namespace csgcore
