// The CSG tree of a solid: n-ary set operations over primitives, in postfix order.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace csgcore {

/// Regularised set operations (NUMERICS.md). A difference is its first operand minus all others.
enum class Op : uint8_t { kUnion, kIntersection, kDifference };

/// One token of the postfix form: either a primitive's index or an operation over the
/// `operand_count` subtrees that precede it.
struct CsgToken {
  bool is_primitive;
  Op op;           // meaningful for operations only
  uint32_t value;  // the primitive's index, or the operand count (≥ 2)
};

/// A CSG tree in postfix order, in normal form: no empty operands, no operation with fewer than
/// two operands, no union directly under a union, no intersection under an intersection, no
/// difference as the first operand of a difference, no union as a later operand of a difference.
/// No tokens: the empty set. Made by CsgTreeBuilder. Nesting may be arbitrarily deep: nothing that
/// walks a tree may recurse.
class CsgTree {
 public:
  CsgTree() = default;
  bool empty() const { return tokens_.empty(); }
  std::span<const CsgToken> tokens() const { return tokens_; }

 private:
  friend class CsgTreeBuilder;
  friend CsgTree subtract(const CsgTree& tree, uint32_t primitive);
  friend CsgTree renamed(const CsgTree& tree, const std::function<uint32_t(uint32_t)>& name);
  std::vector<CsgToken> tokens_;
};

/// The tree minus one more primitive: a section plane, for one. Nothing minus something is empty.
CsgTree subtract(const CsgTree& tree, uint32_t primitive);

/// The tree with each primitive named as `name` says, which is asked in the tree's order.
CsgTree renamed(const CsgTree& tree, const std::function<uint32_t(uint32_t primitive)>& name);

/// Builds a tree from the outside in, without recursion:
///   builder.open(Op::kDifference); builder.primitive(0); builder.primitive(1); builder.close();
/// Operands that turn out empty are dropped by OpenSCAD's rules: an empty operand leaves a union,
/// empties an intersection, and empties a difference if it is its first.
class CsgTreeBuilder {
 public:
  void open(Op op);
  void primitive(uint32_t index);
  /// An operand that is the empty set (an invalid primitive, an empty group).
  void empty();
  /// Closes the innermost open operation. Precondition: one is open.
  void close();
  /// The tree: the union of what was added at the top level. Precondition: every open() is closed.
  /// Leaves the builder empty.
  CsgTree finish();

 private:
  struct Frame {
    Op op;
    uint32_t first_token;    // where this operation's operands start
    uint32_t operand_count;  // operands that are not empty, after flattening
    bool is_empty;           // the result is known to be the empty set
    bool has_first;          // the first operand was seen
  };
  enum class Operand { kEmpty, kTokens };
  void add_operand(Operand operand);

  std::vector<CsgToken> tokens_;
  std::vector<Frame> frames_;
  uint32_t top_level_operands_ = 0;
};

}  // namespace csgcore
