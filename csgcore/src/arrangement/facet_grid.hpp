// The triangles of all operands on the grid, and the names of points that they define.
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <glm/common.hpp>
#include <limits>
#include <span>
#include <vector>

#include "arrangement/grid.hpp"
#include "csgcore/triangle_set.hpp"

namespace csgcore {

/// In place of a number: there is none.
constexpr uint32_t kNoPlace = ~uint32_t{0};

/// A triangle of an operand's surface, which has an area.
struct Facet {
  std::array<uint32_t, 3> corners;  // places in Facets::points
  uint32_t operand;
};

struct Facets {
  std::vector<GridPoint> points;  // no two are equal
  std::vector<Facet> facets;      // by operand
  /// Corners of facets that rounding has left without area, with the facet on whose edge they lie.
  struct Touch {
    uint32_t facet;
    uint32_t point;
  };
  std::vector<Touch> touches;
  // A point of the grid is (world − middle)·scale.
  Vec3 middle{0.0};
  double scale = 1;

  std::array<GridPoint, 3> corners(uint32_t facet) const {
    const auto& [a, b, c] = facets[facet].corners;
    return {points[a], points[b], points[c]};
  }
  GridPlane plane(uint32_t facet) const {
    const auto [a, b, c] = corners(facet);
    return plane_through(a, b, c);
  }
  bool are_in_one_plane(uint32_t a, uint32_t b) const;
  /// The largest coordinates may have been rounded up beyond double's range.
  Vec3 to_world(const Vec3& grid) const {
    constexpr double kLargest = std::numeric_limits<double>::max();
    return glm::clamp(grid / scale + middle, -kLargest, kLargest);
  }
};

/// The operands of boundary_mesh(), or some of them.
using Surfaces = std::span<const TriangleSet* const>;

Facets facets_on_grid(Surfaces operands);

/// What defines a point of the arrangement. One point may have several names.
struct PointName {
  enum Kind : uint32_t {
    kCorner,        // a place in Facets::points
    kEdgeAndFacet,  // two corners, and a facet whose plane the edge crosses
    kEdgeAndEdge,   // four corners: two edges of one plane
    kThreeFacets,   // whose planes meet there
  };
  std::array<uint32_t, 5> numbers{};  // the kind, and what it is made of, in rising order

  Kind kind() const { return static_cast<Kind>(numbers[0]); }
  auto operator<=>(const PointName&) const = default;
};

PointName corner_name(uint32_t corner);
PointName name_of(uint32_t a, uint32_t b, uint32_t facet);
PointName name_of_edges(uint32_t a, uint32_t b, uint32_t c, uint32_t d);
PointName name_of_planes(uint32_t p, uint32_t q, uint32_t r);

}  // namespace csgcore
