// Cells contracted about the part of a solid that they hold.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "csgcore/canonical_primitive.hpp"
#include "tree/cell_list.hpp"

namespace csgcore {

/// A convex polyhedron as the edges of its faces.
class ConvexCell {
 public:
  explicit ConvexCell(const Box& box);

  bool empty() const { return edges_.empty(); }
  /// Leaves the part where normal · x ≤ limit.
  void clip(const Vec3& normal, double limit);
  /// Calls visit(vertex) for each vertex, some of them more than once.
  template <typename Visit>
  void visit_vertices(const Visit& visit) const {
    for (const Edge& edge : edges_) {
      visit(edge.start);
      visit(edge.end);
    }
  }

 private:
  struct Edge {  // of one face; every edge is there twice
    Vec3 start, end;
    uint32_t face;
  };
  std::vector<Edge> edges_;
  uint32_t faces_ = 6;
};

/// What a cell may hold.
struct Contraction {
  Box box;
  Vec3 tip;     // the point that is farthest along the direction
  Vec3 middle;  // of the vertices of the part that has the tip
};

/// Contracts cells. In a small cell the surface of a convex primitive is nearly plane, so that one
/// half-space holds the part of the cell within the primitive, another one the part without, and
/// both are off by the square of the cell's size only. Each way to make a list true is an
/// intersection of such half-spaces.
class Contractor {
 public:
  /// A list with more tests is not taken: there are two ways for each test.
  static constexpr uint32_t kMostTests = 4;

  /// The half-spaces end so far from the primitives' surfaces, on either side of them, as cells do
  /// from one another (tight_bounds.cpp).
  Contractor(std::span<const CanonicalPrimitive> primitives, double margin)
      : primitives_(primitives), margin_(margin) {}

  /// Returns what the cell holds of the list, which must be irreducible in it and have at most
  /// kMostTests tests; nothing if it holds nothing.
  std::optional<Contraction> contract(const CellList& list, const Box& cell,
                                      const Vec3& direction) const;

 private:
  struct HalfSpace {  // normal · x ≤ limit; everything if the normal is 0
    Vec3 normal{0.0};
    double limit = 0;
  };
  struct Sides {
    HalfSpace within, without;
  };
  Sides sides_of(const CanonicalPrimitive& primitive, const Box& cell) const;
  HalfSpace without(const CanonicalPrimitive& primitive, const Box& cell, const Vec3& normal,
                    double support, double rounding) const;

  std::span<const CanonicalPrimitive> primitives_;
  double margin_;
};

}  // namespace csgcore
