// The Nef oracle: the solid of a CSG tree over convex polyhedra, by CGAL's Nef polyhedra over an
// exact kernel (Hachenberger, Kettner, Mehlhorn, "Boolean operations on 3D selective Nef
// complexes", Computational Geometry 38, 2007). It knows no tolerance: a gap of 1e-30 is a gap.
//
// A polyhedron is the intersection of half-spaces whose doubles are taken as exact, and so is its
// local→world matrix (csgcore/half_space.hpp says why): its facets are plane, its vertices
// rationals.
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
#include "csgcore/half_space.hpp"
#include "csgcore/primitive.hpp"
#include "csgcore/scene.hpp"
#include "csgcore/view.hpp"

namespace oracle {

using Rational = mpq_class;

/// The half-spaces, in local coordinates, bound a solid that is not infinite and has a point of
/// doubles within; the matrix is finite and nonsingular.
struct ConvexPolyhedron {
  std::vector<csgcore::HalfSpace> half_spaces;
  csgcore::Affine local_to_world;
};

/// A primitive of a scene: of a smooth one the polyhedron that OpenSCAD makes of it with so many
/// fragments (≥ 3), of a polyhedron its own half-spaces.
ConvexPolyhedron faceted(const csgcore::Primitive& primitive, int fragments);

/// How long a solid may take to build.
struct NefLimits {
  std::chrono::steady_clock::time_point deadline = std::chrono::steady_clock::time_point::max();
  /// Asked at least every 50 ms, by the thread that builds; false cancels.
  std::function<bool()> keep_waiting = [] { return true; };
};

enum class NefStatus : uint8_t {
  kBuilt,
  kDeadline,
  kCancelled,
  kFailed,  // a polyhedron is not as its comment says, or memory was short
};

enum class Place : uint8_t { kOutside, kBoundary, kInside };

/// A plane that holds facets of the solid.
struct FacetPlane {
  /// normal·x = offset, exactly; the normal points outwards, and is not of unit length.
  Rational normal[3], offset;
  csgcore::Vec3 unit_normal;
  /// The polyhedra that have a half-space with this boundary, in rising order. Their solid may lie
  /// on either side of it.
  std::vector<uint32_t> polyhedra;
};

/// Where a line's place changes.
struct Crossing {
  double s_lower, s_upper;  // enclose the parameter, some ulps apart
  Place after;              // up to the next crossing
  uint32_t plane;           // index into planes(): a facet's that holds the point
  /// False if the line meets an edge or a vertex there, or runs in a facet somewhere: a line that
  /// is moved by ever so little may have other crossings.
  bool is_simple;
};

class NefSolid;
struct NefBuild {
  NefStatus status = NefStatus::kFailed;
  std::unique_ptr<const NefSolid> solid;  // null unless it was built
  std::string reason;                     // of kFailed
};

/// The regularised solid: the closure of its interior. Any number of threads may ask.
class NefSolid {
 public:
  /// Works in a child process, which is killed at the deadline or at a cancellation: CGAL cannot be
  /// interrupted otherwise. The tree indexes into `polyhedra`. Throws std::system_error where no
  /// process can be had.
  static NefBuild build(const csgcore::CsgTree& tree, std::span<const ConvexPolyhedron> polyhedra,
                        const NefLimits& limits = {});
  /// Of a scene's model, its smooth primitives with so many fragments; the polyhedra go by the
  /// primitives' indices.
  static NefBuild build(const csgcore::Scene& scene, int fragments, const NefLimits& limits = {});
  ~NefSolid();

  bool empty() const;
  Place locate(const csgcore::Vec3& point) const;

  /// All along the line, in rising order; it begins and ends outside. The direction is not 0.
  std::vector<Crossing> crossings(const csgcore::Ray& line) const;
  /// The first crossing at s > from, a double or −inf, after which the place is not the one that it
  /// was just after `from`. None: the line stays where it is.
  std::optional<Crossing> first_hit(const csgcore::Ray& ray, double from) const;
  /// The crossing's exact parameter.
  Rational exact_parameter(const csgcore::Ray& line, const Crossing& crossing) const;

  const std::vector<FacetPlane>& planes() const;
  Rational volume() const;
  double area() const;  // to about 1e-15 of itself per facet
  /// The smallest box of doubles that holds the solid.
  csgcore::Box bounds() const;
  /// The boundary in triangles. Vertices are rounded to doubles.
  csgcore::Mesh mesh() const;

 private:
  class Impl;
  explicit NefSolid(std::unique_ptr<const Impl> impl);
  std::unique_ptr<const Impl> impl_;
};

/// Object File Format, and ASCII STL (of triangles only), with 17 digits.
void write_off(std::ostream& out, const csgcore::Mesh& mesh);
void write_stl(std::ostream& out, const csgcore::Mesh& mesh);

}  // namespace oracle
