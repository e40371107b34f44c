// The products of a tree: OpenSCAD's preview writes a design as a union of products, each an
// intersection of leaves minus others, and draws one after another (frontend/OPENSCAD.md,
// "Translucency").
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "solids/leaves.hpp"

namespace frontend {

/// What is drawn at once.
struct Product {
  LeafTree solid;
  bool is_opaque = true;
  bool is_leaf = false;  // one leaf alone
};

struct Products {
  std::vector<Product> list;  // from the first that is drawn
  /// The tree has more than kMostProducts: each operand of its topmost unions stands as one
  /// product.
  bool are_too_many = false;
};

/// More products take OpenSCAD tens of seconds, and cannot be told apart in a picture.
constexpr size_t kMostProducts = 2000;

/// Opaque products that follow one another are one, without being multiplied out: a tree whose
/// leaves are all opaque is one product. `boxes` holds the boxes of all leaves: a subtracted leaf
/// that misses the others of its product is left out of it, and so is a product of leaves that miss
/// one another.
Products products_of(const LeafTree& tree, std::span<const csgcore::Box> boxes,
                     const std::function<bool(uint32_t leaf)>& is_translucent);

}  // namespace frontend
