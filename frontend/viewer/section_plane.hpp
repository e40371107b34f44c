// A plane that cuts a scene open: one more half-space, as exact as any primitive.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "csgcore/csg_tree.hpp"
#include "csgcore/scene.hpp"

namespace window {

/// A plane perpendicular to an axis of the world. It cuts off what lies beyond `position` along the
/// axis; if flipped, what lies before it.
struct SectionPlane {
  bool is_on = false;
  uint8_t axis = 0;  // 0, 1, 2: x, y, z
  bool is_flipped = false;
  double position = 0;  // world units
  bool operator==(const SectionPlane&) const = default;
};

/// Returns the scene without what the plane cuts off of the model and of the `%` and `#` parts. The
/// cut is a primitive after all others, with the id kSectionId. Preconditions: the plane is on, and
/// `bounds` contains the whole scene.
csgcore::Scene cut_open(const csgcore::Scene& scene, const SectionPlane& plane,
                        const csgcore::Box& bounds);

constexpr uint32_t kSectionId = 0xFFFFFFFEu;  // no file has so many primitives

/// Returns the first primitive of the tree that the point lies in and that no operation takes away
/// there: what a cut through the solid shows. Nothing if the point is outside of the solid.
/// `contains` tells which primitives the point lies in.
std::optional<uint32_t> primitive_around(const csgcore::CsgTree& tree,
                                         const std::function<bool(uint32_t primitive)>& contains);

}  // namespace window
