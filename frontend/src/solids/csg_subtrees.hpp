// The subtrees of a CSG tree, and trees that are written anew.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "csgcore/csg_tree.hpp"
#include "csgcore/geometry.hpp"

namespace frontend {

/// The subtrees of a tree in postfix order. Each is named by its root: the index of its last token.
class CsgSubtrees {
 public:
  /// Keeps a reference to the tokens.
  explicit CsgSubtrees(std::span<const csgcore::CsgToken> tokens);

  /// Returns the index of the subtree's first token.
  uint32_t first(uint32_t root) const { return firsts_[root]; }
  std::span<const csgcore::CsgToken> tokens(uint32_t root) const {
    return tokens_.subspan(firsts_[root], root + 1 - firsts_[root]);
  }
  /// Returns the operands of the subtree, which is no primitive.
  std::vector<uint32_t> operands(uint32_t root) const;

 private:
  std::span<const csgcore::CsgToken> tokens_;
  std::vector<uint32_t> firsts_;
};

/// Returns the boxes of all subtrees, by root. `boxes` holds those of the primitives.
std::vector<csgcore::Box> subtree_boxes(std::span<const csgcore::CsgToken> tokens,
                                        std::span<const csgcore::Box> boxes);

/// Returns the primitives that the tokens name, each once, ascending.
std::vector<uint32_t> primitives_of(std::span<const csgcore::CsgToken> tokens);

/// Returns whether the tree has no operation but unions.
bool is_union(const csgcore::CsgTree& tree);

/// Calls `builder` as for the subtree whose tokens these are, with add(builder, index) for each
/// primitive. Subtrees whose root is_empty(root) is true for are empty operands.
template <typename Add, typename IsEmpty>
void rebuild(std::span<const csgcore::CsgToken> tokens, csgcore::CsgTreeBuilder& builder,
             const Add& add, const IsEmpty& is_empty) {
  constexpr uint32_t kNone = std::numeric_limits<uint32_t>::max();
  const CsgSubtrees subtrees(tokens);
  // Of the operations whose first operand starts at a token, the outermost one; and of each such
  // operation the next one within.
  std::vector<uint32_t> outermost(tokens.size(), kNone), within(tokens.size(), kNone);
  for (uint32_t i = 0; i < tokens.size(); ++i) {
    if (!tokens[i].is_primitive) within[i] = std::exchange(outermost[subtrees.first(i)], i);
  }
  uint32_t next = 0;  // the first token that no empty subtree has taken
  for (uint32_t i = 0; i < tokens.size(); ++i) {
    for (uint32_t root = outermost[i]; root != kNone && i >= next; root = within[root]) {
      if (is_empty(root)) {
        builder.empty();
        next = root + 1;
      } else {
        builder.open(tokens[root].op);
      }
    }
    if (i < next) continue;
    if (!tokens[i].is_primitive) {
      builder.close();
    } else if (is_empty(i)) {
      builder.empty();
    } else {
      add(builder, tokens[i].value);
    }
  }
}

template <typename Add>
void rebuild(std::span<const csgcore::CsgToken> tokens, csgcore::CsgTreeBuilder& builder,
             const Add& add) {
  rebuild(tokens, builder, add, [](uint32_t) { return false; });
}

/// Adds the subtree whose tokens these are.
void add_tree(std::span<const csgcore::CsgToken> tokens, csgcore::CsgTreeBuilder& builder);

}  // namespace frontend
