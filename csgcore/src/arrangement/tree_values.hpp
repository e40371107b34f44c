// What a CSG tree is worth where some of its operands are known.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "arrangement/facet_grid.hpp"
#include "csgcore/csg_tree.hpp"

namespace csgcore {

/// In postfix order, as in a CsgTree. The primitive kNoPlace is all of space. Without tokens it is
/// the empty set.
using TreeTokens = std::vector<CsgToken>;

enum class Held : uint8_t {
  kNo,
  kYes,
  kHere,  // the operand's surface is here: it holds some points and does not hold others
};

/// Returns the tree where each operand holds what `held` says. It has no operand that is known, or
/// that makes no difference: it is empty, all of space, or holds some points and others not.
TreeTokens restricted(std::span<const CsgToken> tokens,
                      const std::function<Held(uint32_t operand)>& held);

/// What a face is to the solid that the tree makes.
struct TreeFace {
  bool is_held_ahead;
  bool is_held_behind;
  uint32_t shown = kNoPlace;  // if the two differ: the operand whose face it is (NUMERICS.md §1.4)
};

/// `ahead` and `behind` return whether an operand holds the points on the two sides of the face.
TreeFace face_of(std::span<const CsgToken> tokens,
                 const std::function<bool(uint32_t operand)>& ahead,
                 const std::function<bool(uint32_t operand)>& behind);

}  // namespace csgcore
