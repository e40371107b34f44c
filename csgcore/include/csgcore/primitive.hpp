// The primitives: solids, each the image of a local solid under an affine map (paper §3.2). Every
// affine image of a primitive is a primitive, too.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "csgcore/geometry.hpp"
#include "csgcore/shape.hpp"

namespace csgcore {

class Polyhedron;
class Profile;
class TriangleMesh;

/// RGBA as the file gives it; no gamma curve is applied to it. A channel above 1 makes a surface
/// brighter than white would; a negative r, g or b stands for that channel of the scheme's colour.
/// The alpha is in [0, 1].
struct Color {
  float r, g, b, a;
  bool operator==(const Color&) const = default;
};

/// When the surface of a primitive is a cut face, which has the scheme's back colour where the
/// primitive has no colour of its own.
enum class CutFaces : uint8_t {
  kByTree,  // where the operations take the primitive away: the tree shows its complement
  kNever,
  kAlways,
};

/// A primitive as the design describes it. Only valid ones (see `is_valid`) may enter a Scene.
struct Primitive {
  Shape shape = Shape::kSphere;
  CutFaces cut_faces = CutFaces::kByTree;
  double r_bottom = 0;  // the sphere's radius, or the frustum's at z_min (0: pointed), or the scale
                        // of an extrusion there
  double r_top = 0;     // the frustum's radius at z_max (0: pointed), or the extrusion's scale
  double z_min = 0;     // frustum and extrusion only, z_min < z_max
  double z_max = 0;
  std::shared_ptr<const Polyhedron> polyhedron;  // a polyhedron's local solid, else null
  std::shared_ptr<const TriangleMesh> mesh;      // a mesh's local solid, else null
  std::shared_ptr<const Profile> profile;        // what is extruded or revolved, else null
  Affine local_to_world;                         // nonsingular; a mirror (det < 0) is fine
  std::optional<Color> color;  // none: the scheme's front colour, or its back colour on cut faces
  /// Index of the node in the file among all primitive nodes, in file order (the `id` channel).
  uint32_t id = 0;
};

/// These make primitives and check nothing: see is_valid().
Primitive make_sphere(double radius, const Affine& local_to_world = {});
Primitive make_frustum(double z_min, double z_max, double r_bottom, double r_top,
                       const Affine& local_to_world = {});
Primitive make_polyhedron(std::shared_ptr<const Polyhedron> polyhedron,
                          const Affine& local_to_world = {});
Primitive make_mesh(std::shared_ptr<const TriangleMesh> mesh, const Affine& local_to_world = {});
/// Both scales must be ≥ 0, and one of them must be > 0.
Primitive make_extrusion(std::shared_ptr<const Profile> profile, double z_min, double z_max,
                         double scale_bottom = 1, double scale_top = 1,
                         const Affine& local_to_world = {});
/// No point of the profile may have x < 0.
Primitive make_revolution(std::shared_ptr<const Profile> profile,
                          const Affine& local_to_world = {});

/// Returns false for what OpenSCAD takes for the empty set (a size that is ≤ 0, infinite or nan; a
/// matrix that is not finite), and for a singular matrix, which flattens the solid to nothing.
bool is_valid(const Primitive& primitive);
/// Returns what is_valid() would for a nonsingular local_to_world.
bool has_valid_shape(const Primitive& primitive);

}  // namespace csgcore
