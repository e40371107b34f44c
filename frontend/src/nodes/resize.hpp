// The sizes of a resize node.
#pragma once

#include <array>

#include "csgcore/geometry.hpp"
#include "nodes/node_reader.hpp"

namespace frontend {

/// A plane figure has no z.
struct ResizeArguments {
  std::array<double, 3> size{};
  std::array<bool, 3> follows{};  // `auto`

  /// Returns the factors by which a box of that size is scaled, of the first `axes` axes; those of
  /// others are 1.
  csgcore::Vec3 factors(const csgcore::Vec3& box_size, int axes) const;
};
ResizeArguments read_resize(NodeReader& reader);

}  // namespace frontend
