// A plane that cuts a scene open: one more half-space, as exact as any primitive.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "csgcore/csg_tree.hpp"
#include "csgcore/geometry.hpp"
#include "csgcore/image.hpp"
#include "csgcore/scene.hpp"

namespace window {

/// A plane in the world. It cuts off what lies beyond `position` along its normal; if flipped, what
/// lies before it.
struct SectionPlane {
  bool is_on = false;
  csgcore::Vec3 normal{1, 0, 0};  // unit
  bool is_flipped = false;
  double position = 0;  // of the plane's points: dot(normal, point), in world units
  bool operator==(const SectionPlane&) const = default;

  /// The direction, of unit length, towards what is cut off.
  csgcore::Vec3 cut_off() const { return is_flipped ? -normal : normal; }
  /// The axis that the normal is: 0, 1, 2 for x, y, z. Nothing if it is none.
  std::optional<uint8_t> axis() const;
};

inline csgcore::Vec3 axis_of(uint8_t axis) {
  csgcore::Vec3 direction(0.0);
  direction[axis] = 1;
  return direction;
}

/// Returns the axes of a right-handed frame whose third one is the normal, of unit length.
csgcore::Mat3 frame_with(const csgcore::Vec3& normal);

/// Returns the least and the largest position of a plane with that normal that meets the box, which
/// is not empty.
std::pair<double, double> positions_in(const csgcore::Box& box, const csgcore::Vec3& normal);

/// A scene without what a section plane cuts off. Where the plane cuts a part of the assembly open,
/// it shows a face of its own, in the colour that the part has there: a primitive with the id
/// kFirstSectionFace + i for face i. They stand behind all other primitives.
struct CutScene {
  csgcore::Scene scene;
  std::vector<uint32_t> parts;  // by face: what ImportedDesign::parts has of it
};

/// Cuts the model and the `%` and `#` parts. `parts` is ImportedDesign::parts; empty: all is one
/// part. Preconditions: the plane is on, and `bounds` contains the whole scene.
CutScene cut_open(const csgcore::Scene& scene, const SectionPlane& plane,
                  const csgcore::Box& bounds, std::span<const uint32_t> parts = {});

constexpr uint32_t kFirstSectionFace = 0x80000000u;  // no file has so many primitives

/// Returns whether that is the id of a section's face, and not of a miss.
inline bool is_section_face(uint32_t id) {
  return id >= kFirstSectionFace && id != csgcore::kNoPrimitive;
}

/// Returns the primitive of the tree that the point lies in and that no operation takes away there,
/// in a union the last one: what a cut through the solid shows. Nothing if the point is outside of
/// the solid. `contains` tells which primitives the point lies in.
std::optional<uint32_t> primitive_around(const csgcore::CsgTree& tree,
                                         const std::function<bool(uint32_t primitive)>& contains);

}  // namespace window
