// Divides a solid by the colours of its parts.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "csgcore/csg_tree.hpp"
#include "csgcore/geometry.hpp"
#include "csgcore/primitive.hpp"

namespace frontend {

struct ColoredTree {
  csgcore::CsgTree tree;
  std::optional<csgcore::Color> color;
};

/// Returns trees of one colour each, in the order in which the tree has them, that share no volume
/// and are the solid together. A point has the colour of the last operand of a union that holds it,
/// and of the first operand of a difference or an intersection. `boxes` and `color_of` tell of the
/// primitives; no channel is nan.
std::vector<ColoredTree> colored_trees(
    const csgcore::CsgTree& tree, std::span<const csgcore::Box> boxes,
    const std::function<std::optional<csgcore::Color>(uint32_t primitive)>& color_of);

}  // namespace frontend
