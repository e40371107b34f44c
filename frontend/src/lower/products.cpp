#include "lower/products.hpp"

#include <algorithm>
#include <iterator>
#include <optional>
#include <utility>

namespace frontend {
namespace {

using csgcore::Box;
using csgcore::CsgToken;
using csgcore::CsgTreeBuilder;
using csgcore::Op;

struct SignedLeaf {
  uint32_t leaf;
  bool is_subtracted;
};

/// An intersection of leaves and of complements of leaves.
struct Term {
  std::vector<SignedLeaf> leaves;
  std::optional<Box> box;  // of the leaves that are not subtracted; none without such
};
using Terms = std::vector<Term>;

bool are_disjoint(const Box& a, const Box& b) { return csgcore::intersection(a, b).empty(); }

/// Writes subtrees as sums of terms.
class Multiplier {
 public:
  explicit Multiplier(std::span<const Box> boxes) : boxes_(boxes) {}

  /// Nothing: there would be more than kMostProducts terms, or they would take too long to write.
  std::optional<Terms> multiply(std::span<const CsgToken> tokens) {
    find_signs(tokens);
    std::vector<Terms> operands;
    for (size_t i = 0; i < tokens.size(); ++i) {
      const CsgToken& token = tokens[i];
      if (token.is_primitive) {
        Term term{{{token.value, is_subtracted_[i]}}, std::nullopt};
        if (!is_subtracted_[i]) term.box = boxes_[token.value];
        operands.push_back({std::move(term)});
        continue;
      }
      const auto first = operands.end() - token.value;
      // The complement of a union is an intersection, and the other way round.
      const bool is_sum = (token.op == Op::kUnion) != is_subtracted_[i];
      Terms terms = std::move(*first);
      for (auto operand = first + 1; operand != operands.end(); ++operand) {
        if (is_sum) {
          std::move(operand->begin(), operand->end(), std::back_inserter(terms));
        } else {
          terms = product(terms, *operand);
        }
        if (terms.size() > kMostProducts || steps_ > kMostSteps) return std::nullopt;
      }
      operands.erase(first, operands.end());
      operands.push_back(std::move(terms));
    }
    return std::move(operands.back());
  }

 private:
  /// Finds out whether each token stands under an odd number of subtractions.
  void find_signs(std::span<const CsgToken> tokens) {
    is_subtracted_.assign(tokens.size(), false);
    struct Operation {
      size_t token;
      uint32_t operands_left;  // the last operand comes first
    };
    std::vector<Operation> open;
    for (size_t i = tokens.size(); i-- > 0;) {
      if (!open.empty()) {
        const Operation& parent = open.back();
        const bool is_later =
            tokens[parent.token].op == Op::kDifference && parent.operands_left > 1;
        is_subtracted_[i] = is_subtracted_[parent.token] != is_later;
      }
      if (!tokens[i].is_primitive) {
        open.push_back({i, tokens[i].value});
        continue;
      }
      while (!open.empty() && --open.back().operands_left == 0) open.pop_back();
    }
  }

  Terms product(const Terms& a, const Terms& b) {
    Terms result;
    for (const Term& left : a) {
      for (const Term& right : b) {
        if (left.box && right.box && are_disjoint(*left.box, *right.box)) continue;
        Term term = left;
        term.leaves.insert(term.leaves.end(), right.leaves.begin(), right.leaves.end());
        if (left.box && right.box) {
          term.box = csgcore::intersection(*left.box, *right.box);
        } else if (right.box) {
          term.box = right.box;
        }
        result.push_back(std::move(term));
        steps_ += result.back().leaves.size();
        if (result.size() > kMostProducts || steps_ > kMostSteps) return result;
      }
    }
    return result;
  }

  // Leaves of terms that are written: nested differences have terms as long as they are deep.
  static constexpr size_t kMostSteps = 1'000'000;
  size_t steps_ = 0;
  std::span<const Box> boxes_;
  std::vector<bool> is_subtracted_;
};

/// Collects the products of a tree.
class ProductList {
 public:
  ProductList(std::span<const Box> boxes, const std::function<bool(uint32_t)>& is_translucent)
      : boxes_(boxes), is_translucent_(is_translucent) {}

  /// A subtree of opaque leaves, as it is.
  void add_opaque(std::span<const CsgToken> subtree) {
    add_tree(subtree, opaque_);
    has_opaque_ = true;
  }

  void add_translucent(std::span<const CsgToken> subtree) {
    if (!result_.are_too_many) {
      const std::optional<Terms> terms = Multiplier(boxes_).multiply(subtree);
      if (terms && result_.list.size() + terms->size() <= kMostProducts) {
        for (const Term& term : *terms) add_term(term);
        return;
      }
      result_.are_too_many = true;
    }
    CsgTreeBuilder builder;
    add_tree(subtree, builder);
    add({builder.finish(), false, subtree.size() == 1});
  }

  Products finish() {
    end_opaque();
    return std::move(result_);
  }

 private:
  void add_term(const Term& term) {
    // Every term of a sum that is not subtracted has a leaf that is not.
    CsgTreeBuilder builder;
    bool is_opaque = true;
    size_t count = 0;
    const auto add_leaf = [&](uint32_t leaf) {
      builder.primitive(leaf);
      is_opaque = is_opaque && !is_translucent_(leaf);
      ++count;
    };
    builder.open(Op::kDifference);
    builder.open(Op::kIntersection);
    for (const auto& [leaf, is_subtracted] : term.leaves) {
      if (!is_subtracted) add_leaf(leaf);
    }
    builder.close();
    for (const auto& [leaf, is_subtracted] : term.leaves) {
      if (is_subtracted && !are_disjoint(boxes_[leaf], *term.box)) add_leaf(leaf);
    }
    builder.close();
    add({builder.finish(), is_opaque, count == 1});
  }

  void add(Product product) {
    end_opaque();
    result_.list.push_back(std::move(product));
  }

  void end_opaque() {
    if (!std::exchange(has_opaque_, false)) return;
    LeafTree tree = opaque_.finish();
    const bool is_leaf = tree.tokens().size() == 1;
    if (!tree.empty()) result_.list.push_back({std::move(tree), true, is_leaf});
  }

  std::span<const Box> boxes_;
  const std::function<bool(uint32_t)>& is_translucent_;
  CsgTreeBuilder opaque_;  // those that follow one another
  bool has_opaque_ = false;
  Products result_;
};

}  // namespace

Products products_of(const LeafTree& whole, std::span<const Box> boxes,
                     const std::function<bool(uint32_t)>& is_translucent) {
  const LeafTree tree = pruned(whole, boxes);
  const std::span<const CsgToken> tokens = tree.tokens();
  const CsgSubtrees subtrees(tokens);
  std::vector<uint32_t> translucent_before(tokens.size() + 1, 0);  // leaves
  for (size_t i = 0; i < tokens.size(); ++i) {
    const bool is_one = tokens[i].is_primitive && is_translucent(tokens[i].value);
    translucent_before[i + 1] = translucent_before[i] + (is_one ? 1 : 0);
  }
  ProductList products(boxes, is_translucent);
  std::vector<uint32_t> summands;  // the roots of those to come, the next one last
  if (!tokens.empty()) summands.push_back(static_cast<uint32_t>(tokens.size()) - 1);
  while (!summands.empty()) {
    const uint32_t root = summands.back();
    summands.pop_back();
    if (translucent_before[root + 1] == translucent_before[subtrees.first(root)]) {
      products.add_opaque(subtrees.tokens(root));
    } else if (tokens[root].is_primitive || tokens[root].op != Op::kUnion) {
      products.add_translucent(subtrees.tokens(root));
    } else {
      const std::vector<uint32_t> operands = subtrees.operands(root);
      summands.insert(summands.end(), operands.rbegin(), operands.rend());
    }
  }
  return products.finish();
}

}  // namespace frontend
