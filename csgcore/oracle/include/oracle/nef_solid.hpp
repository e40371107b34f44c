// The Nef oracle computes the solid of a CSG tree over convex polyhedra and closed meshes, by
// CGAL's Nef polyhedra over an exact kernel (Hachenberger, Kettner, Mehlhorn, "Boolean operations
// on 3D selective Nef complexes", Computational Geometry 38, 2007). It knows no tolerance: a gap of
// 1e-30 is a gap.
//
// A convex polyhedron is an intersection of half-spaces. Their doubles, and those of its
// local→world matrix, are taken as exact (csgcore/facets.hpp says why), so that its facets are
// plane and its vertices are rationals. So are the doubles of a mesh's vertices.
#pragma once

#include <gmpxx.h>

#include <chrono>
#include <cstdint>
#include <functional>
#include <iosfwd>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "csgcore/csg_tree.hpp"
#include "csgcore/facets.hpp"
#include "csgcore/primitive.hpp"
#include "csgcore/scene.hpp"
#include "csgcore/triangle_mesh.hpp"
#include "csgcore/view.hpp"

namespace oracle {

using Rational = mpq_class;

/// A convex polyhedron or, if `mesh` is not null, what the mesh encloses. The matrix must be finite
/// and nonsingular.
struct FacetedSolid {
  /// In local coordinates. They must have a bounded intersection with a point of doubles in its
  /// interior. A mesh has none.
  std::vector<csgcore::HalfSpace> half_spaces;
  csgcore::Affine local_to_world;
  /// Its shells, the parts that are connected by edges, must be closed manifolds that do not
  /// intersect themselves, of triangles with an area. They may intersect each other.
  std::shared_ptr<const csgcore::TriangleMesh> mesh{};
};

/// Returns the solid that stands for a primitive: for a smooth one OpenSCAD's facets with so many
/// fragments (≥ 3), for a polyhedron its own half-spaces, for a mesh itself.
FacetedSolid faceted(const csgcore::Primitive& primitive, int fragments);

/// The limits of the time that building a solid may take.
struct NefLimits {
  std::chrono::steady_clock::time_point deadline = std::chrono::steady_clock::time_point::max();
  /// Is called at least every 50 ms by the thread that builds; false cancels.
  std::function<bool()> keep_waiting = [] { return true; };
};

enum class NefStatus : uint8_t {
  kBuilt,
  kDeadline,
  kCancelled,
  kFailed,  // a solid breaks its preconditions, or memory ran out
};

enum class Place : uint8_t { kOutside, kBoundary, kInside };

/// A plane that contains facets of the solid.
struct FacetPlane {
  /// normal·x = offset, exactly. The normal points outwards and may have any length.
  Rational normal[3], offset;
  csgcore::Vec3 unit_normal;
  /// The solids that have a half-space with this boundary, or a triangle in it, in ascending order.
  /// They may lie on either side of it.
  std::vector<uint32_t> polyhedra;
};

/// A point of a line at which its place changes.
struct Crossing {
  double s_lower, s_upper;  // enclose the parameter, and are some ulps apart
  Place after;              // the place between this crossing and the next
  uint32_t plane;           // index into planes() of a facet that contains the point
  /// False if the line meets an edge or a vertex there, or runs within a facet somewhere: a line
  /// moved by any small distance may then have other crossings.
  bool is_simple;
};

class NefSolid;
struct NefBuild {
  NefStatus status = NefStatus::kFailed;
  std::unique_ptr<const NefSolid> solid;  // null unless status is kBuilt
  std::string reason;                     // for kFailed
};

/// The regularised solid, which is the closure of its interior. Any number of threads may call its
/// functions.
class NefSolid {
 public:
  /// Builds the solid of a tree, whose primitives are indices into `polyhedra`. The work is done in
  /// a child process, which is killed at the deadline or when it is cancelled: CGAL cannot be
  /// interrupted otherwise. Throws std::system_error if no process can be made.
  static NefBuild build(const csgcore::CsgTree& tree, std::span<const FacetedSolid> polyhedra,
                        const NefLimits& limits = {});
  /// Builds the solid of a scene's model, with so many fragments for smooth primitives. The index
  /// of a solid is that of its primitive.
  static NefBuild build(const csgcore::Scene& scene, int fragments, const NefLimits& limits = {});
  ~NefSolid();

  bool empty() const;
  Place locate(const csgcore::Vec3& point) const;

  /// Returns the crossings of the whole line, in ascending order; it begins and ends outside. The
  /// direction must not be 0.
  std::vector<Crossing> crossings(const csgcore::Ray& line) const;
  /// Returns the first crossing at s > from, after which the place differs from that just after
  /// `from` (a double or −inf), or nothing if there is none.
  std::optional<Crossing> first_hit(const csgcore::Ray& ray, double from) const;
  /// Returns the exact parameter of a crossing of the line.
  Rational exact_parameter(const csgcore::Ray& line, const Crossing& crossing) const;

  const std::vector<FacetPlane>& planes() const;
  Rational volume() const;
  double area() const;  // to a relative error of about 1e-15 per facet
  /// Returns the smallest box of doubles that contains the solid.
  csgcore::Box bounds() const;
  /// Returns the boundary as triangles, whose vertices are rounded to doubles.
  csgcore::Mesh mesh() const;

 private:
  class Impl;
  explicit NefSolid(std::unique_ptr<const Impl> impl);
  std::unique_ptr<const Impl> impl_;
};

/// These write Object File Format, and ASCII STL (for triangles only), with 17 digits.
void write_off(std::ostream& out, const csgcore::Mesh& mesh);
void write_stl(std::ostream& out, const csgcore::Mesh& mesh);

}  // namespace oracle
