// Finds the box of a solid from pictures of it.
#pragma once

#include <functional>

#include "csgcore/geometry.hpp"
#include "csgcore/image.hpp"
#include "csgcore/view.hpp"

namespace frontend {

/// Draws a view with its measured channels.
using DrawView = std::function<csgcore::Image(const csgcore::View& view)>;

/// Returns the tight box of what `draw` shows, which must lie within `around`. Its error is at most
/// 1e-5 of the size of `around`, unless parts thinner than a 500th of that size are missed. Empty
/// if nothing is seen.
csgcore::Box seen_box(const csgcore::Box& around, const DrawView& draw);

}  // namespace frontend
