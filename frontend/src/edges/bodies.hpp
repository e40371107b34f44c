// The primitives of a solid as convex bodies in world space, with the faces of their meshes.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "csgcore/canonical_primitive.hpp"
#include "csgcore/geometry.hpp"
#include "edges/face_tree.hpp"
#include "frontend/imported_design.hpp"

namespace frontend {

/// The points x with normal · x ≤ offset; the normal has unit length and points outwards.
struct BodyPlane {
  csgcore::Vec3 normal;
  double offset;
  double above(const csgcore::Vec3& point) const;
};

struct Body {
  uint32_t primitive;               // its index in the scene
  const FacetMesh* mesh = nullptr;  // null: the body is smooth, without vertices and planes
  std::vector<csgcore::Vec3> vertices;
  std::vector<BodyPlane> planes;  // one for each face of the mesh
  /// A point that is no further from a plane counts as lying in it.
  double tolerance = 0;
  FaceTree faces;
  /// The primitive of a smooth body, or of one with many faces.
  std::optional<csgcore::CanonicalPrimitive> canonical;
  csgcore::Box box;
  std::vector<uint32_t> neighbours;  // the bodies whose boxes touch this one's, without itself

  /// Returns the vertices of a face in world space.
  void face(uint32_t index, std::vector<csgcore::Vec3>& corners) const;
};

/// A body with more planes has its `canonical` form, by which most points are told inside or
/// outside without looking at all planes.
constexpr size_t kFewPlanes = 64;

/// The bodies of the primitives that the design's model names.
std::vector<Body> bodies_of(const ImportedDesign& design);

}  // namespace frontend
