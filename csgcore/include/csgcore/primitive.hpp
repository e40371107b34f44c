// The primitives: solids, each the image of a local solid under an affine map (paper §3.2). Every
// affine image of a primitive is a primitive, too.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <variant>

#include "csgcore/color.hpp"
#include "csgcore/geometry.hpp"
#include "csgcore/shape.hpp"

namespace csgcore {

/// When the surface of a primitive is a cut face, which has the scheme's back colour where the
/// primitive has no colour of its own.
enum class CutFaces : uint8_t {
  kByTree,  // where the operations take the primitive away: the tree shows its complement
  kNever,
  kAlways,
};

/// A primitive as the design describes it. Only valid ones (see `is_valid`) may enter a Scene.
struct Primitive {
  LocalSolid solid;
  Affine local_to_world;  // nonsingular; a mirror (det < 0) is fine
  /// None: that of the face of its mesh, if it has one (alpha does not count there), else the
  /// scheme's front colour, or its back colour on cut faces.
  std::optional<Color> color = {};
  /// Index of the node in the file among all primitive nodes, in file order (the `id` channel).
  uint32_t id = 0;
  CutFaces cut_faces = CutFaces::kByTree;

  Shape shape() const { return static_cast<Shape>(solid.index()); }
  /// Returns the numbers of the primitive, which must be of that kind.
  template <class NameShape>
  const NameShape& as() const {
    return std::get<NameShape>(solid);
  }
  template <class NameShape>
  NameShape& as() {
    return std::get<NameShape>(solid);
  }
  /// Null unless it is a polyhedron.
  const Polyhedron* polyhedron() const {
    const auto* const shape = std::get_if<PolyhedronShape>(&solid);
    return shape ? shape->polyhedron.get() : nullptr;
  }
  /// Null unless it is a mesh.
  const TriangleMesh* mesh() const {
    const auto* const shape = std::get_if<MeshShape>(&solid);
    return shape ? shape->mesh.get() : nullptr;
  }
  /// Null unless it is an extrusion or a revolution.
  const Profile* profile() const {
    if (shape() == Shape::kExtrusion) return as<ExtrusionShape>().profile.get();
    return shape() == Shape::kRevolution ? as<RevolutionShape>().profile.get() : nullptr;
  }
};

/// These make primitives and check nothing: see is_valid().
inline Primitive make_sphere(double radius, const Affine& local_to_world = {}) {
  return {SphereShape{radius}, local_to_world};
}
inline Primitive make_frustum(double z_min, double z_max, double r_bottom, double r_top,
                              const Affine& local_to_world = {}) {
  return {FrustumShape{z_min, z_max, r_bottom, r_top}, local_to_world};
}
inline Primitive make_polyhedron(std::shared_ptr<const Polyhedron> polyhedron,
                                 const Affine& local_to_world = {}) {
  return {PolyhedronShape{std::move(polyhedron)}, local_to_world};
}
inline Primitive make_mesh(std::shared_ptr<const TriangleMesh> mesh,
                           const Affine& local_to_world = {}) {
  return {MeshShape{std::move(mesh)}, local_to_world};
}
inline Primitive make_extrusion(std::shared_ptr<const Profile> profile, double z_min, double z_max,
                                double scale_bottom = 1, double scale_top = 1,
                                const Affine& local_to_world = {}) {
  return {ExtrusionShape{std::move(profile), z_min, z_max, scale_bottom, scale_top},
          local_to_world};
}
inline Primitive make_revolution(std::shared_ptr<const Profile> profile,
                                 const Affine& local_to_world = {}) {
  return {RevolutionShape{std::move(profile)}, local_to_world};
}

/// Returns false for what OpenSCAD takes for the empty set (a size that is ≤ 0, infinite or nan; a
/// matrix that is not finite), and for a singular matrix, which flattens the solid to nothing.
bool is_valid(const Primitive& primitive);
/// Returns what is_valid() would for a nonsingular local_to_world.
bool has_valid_shape(const Primitive& primitive);

}  // namespace csgcore
