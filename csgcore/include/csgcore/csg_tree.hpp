// The CSG tree of a solid: n-ary set operations over primitives, in postfix order.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace csgcore {

/// Regularised set operations (NUMERICS.md). A difference is its first operand minus all others.
enum class Op : uint8_t { kUnion, kIntersection, kDifference };

/// One token of the postfix form: either a primitive or an operation on the `value` subtrees that
/// precede it.
struct CsgToken {
  bool is_primitive;
  Op op;           // meaningful for operations only
  uint32_t value;  // the primitive's index, or the number of operands (≥ 2)
};

/// A CSG tree in postfix order and in normal form: no empty operands, no operation with fewer than
/// two operands, no union directly under a union, no intersection under an intersection, no
/// difference as the first operand of a difference, no union as a later operand of a difference. A
/// tree without tokens is the empty set. CsgTreeBuilder makes trees. They may be nested to any
/// depth, so that code must not recurse over a tree.
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

/// Returns the tree minus one more primitive, for example a section plane. The empty tree stays
/// empty.
CsgTree subtract(const CsgTree& tree, uint32_t primitive);

/// Returns the tree with each primitive named as `name` says, which is asked in the tree's order.
CsgTree renamed(const CsgTree& tree, const std::function<uint32_t(uint32_t primitive)>& name);

/// Builds a tree, in normal form, from the outside in and without recursion:
///   builder.open(Op::kDifference); builder.primitive(0); builder.primitive(1); builder.close();
/// Empty operands are dropped by OpenSCAD's rules: in a union they count for nothing, in an
/// intersection any of them makes the result empty, and in a difference the first one does.
class CsgTreeBuilder {
 public:
  void open(Op op);
  void primitive(uint32_t index);
  /// Adds an operand that is the empty set (an invalid primitive, an empty group).
  void empty();
  /// Closes the innermost open operation. Precondition: one is open.
  void close();
  /// Returns the union of what was added at the top level, and leaves the builder empty.
  /// Precondition: every open() is closed.
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
