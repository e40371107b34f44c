// The exact crossings of rays with triangle meshes.
//
// A line along d through o passes a triangle if the origin lies within the triangle's image in a
// plane across d: if all three edges a → b have the same sign of d·((a − o) × (b − o)). Where such
// a number is 0, the line counts as moved from o by (ε, ε², ε³) for an ε that is less than any
// number, the same for all triangles (Edelsbrunner and Mücke, "Simulation of simplicity", 1990). So
// no line meets an edge or a vertex, none runs within a triangle, and a closed mesh is left as
// often as it is entered.
#pragma once

#include <memory>
#include <vector>

#include "box_tree.hpp"
#include "csgcore/triangle_mesh.hpp"
#include "exact_primitive.hpp"

namespace oracle {

/// The sheets of open meshes (csgcore/NUMERICS.md, "Meshes"): their thickness in thickness
/// tolerances, and the least cosine at which it is measured along the normal.
constexpr double kSheetThickness = 4;
constexpr double kSheetCosine = 0x1p-10;

/// A place where a line passes a triangle.
struct Passage {
  uint32_t triangle;
  int turn;  // by how much the winding number grows there: 1 or −1
};

/// A mesh in a target's local space: relative to the middle, magnified by λ.
class ExactMesh {
 public:
  /// RoundingUp must be on.
  ExactMesh(std::shared_ptr<const csgcore::TriangleMesh> mesh, const Vector<Exact>& middle,
            const Exact& magnification);

  /// Returns the plane of a triangle that has an area. The normal points outwards.
  Plane<Exact> plane(uint32_t triangle) const;

  /// Returns the triangles that the line passes, in no particular order. They have an area as seen
  /// along the line. The ray's o must be near the mesh: compared with its size, the distance counts
  /// as rounding in the search for triangles.
  std::vector<Passage> passages(const LocalRay<Exact>& ray) const;

 private:
  Vector<Exact> vertex(uint32_t index) const;
  int turn_of(const csgcore::TriangleMesh::Triangle& triangle, const LocalRay<Exact>& ray,
              const LocalRay<Interval>& enclosed) const;

  std::shared_ptr<const csgcore::TriangleMesh> mesh_;
  Vector<Exact> middle_;
  Exact magnification_;
  std::vector<Vector<Interval>> vertices_;
  BoxTree tree_;
};

/// Returns the segments of the ray's whole line within a mesh, in order. `base` is a parameter near
/// the mesh, and `thickness` is τ in the prepared unit.
std::vector<Ends> mesh_segments(const Target<Exact>& target, const Target<Interval>& enclosed,
                                const NearRay<Exact>& ray, double base, double thickness);

}  // namespace oracle
