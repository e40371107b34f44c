// The box of what is seen of a scene.
#pragma once

#include "csgcore/scene.hpp"

namespace window {

/// Returns a box of what the operations leave of the scene, and of its `%` and `#` parts. It holds
/// all of that; how tight it is tells csgcore's tight_bounds().
csgcore::Box seen_box(const csgcore::Scene& scene);

/// Returns such a box of all points to_frame · p. `bounds` is seen_box(scene).
csgcore::Box seen_box(const csgcore::Scene& scene, const csgcore::Box& bounds,
                      const csgcore::Mat3& to_frame);

}  // namespace window
