// The box of a solid, found by looking at it.
#pragma once

#include <functional>

#include "csgcore/geometry.hpp"
#include "csgcore/image.hpp"
#include "csgcore/view.hpp"

namespace frontend {

/// Draws a view with its measured channels.
using DrawView = std::function<csgcore::Image(const csgcore::View& view)>;

/// The tight box of what `draw` shows, all of which lies within `around`. It is within 1e-5 of the
/// size of `around`, but for what is thinner than a 500th of that and may be missed. Empty where
/// nothing is seen.
csgcore::Box seen_box(const csgcore::Box& around, const DrawView& draw);

}  // namespace frontend
