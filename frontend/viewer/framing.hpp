// The box of what is seen, and the camera that shows all of it in a part of the picture.
#pragma once

#include <functional>

#include "csgcore/geometry.hpp"
#include "csgcore/scene.hpp"
#include "frontend/imported_design.hpp"
#include "navigation.hpp"
#include "section_plane.hpp"

namespace window {

/// Returns a box of what the operations leave of the scene, and of its `%` and `#` parts. It holds
/// all of that; how tight it is tells csgcore's tight_bounds().
csgcore::Box seen_box(const csgcore::Scene& scene);

/// Returns such a box of all points to_frame · p. `bounds` is seen_box(scene).
csgcore::Box seen_box(const csgcore::Scene& scene, const csgcore::Box& bounds,
                      const csgcore::Mat3& to_frame);

/// A part of the picture, in shares of its width and height from its upper left corner.
struct PicturePart {
  double left = 0, top = 0, right = 1, bottom = 1;
  double aspect = 1;  // the picture's width by its height
};

/// Returns the box of all points to_frame · p of what is to be seen.
using BoxInFrame = std::function<csgcore::Box(const csgcore::Mat3& to_frame)>;

/// Returns the nearest camera that sees all of it in the part, from the same direction. It looks at
/// a point as far away as the middle of `bounds`, which is the box in the world's frame. Where that
/// is empty, it is the camera before.
Navigation framed(const Navigation& before, const csgcore::Box& bounds, const BoxInFrame& box,
                  const PicturePart& part);

/// Does so with all that is seen of a design, or what a section plane leaves of that. `bounds` is
/// seen_box() of the whole scene.
Navigation view_all(const Navigation& before, const frontend::ImportedDesign& design,
                    const csgcore::Box& bounds, const SectionPlane& section,
                    const PicturePart& part);

}  // namespace window
