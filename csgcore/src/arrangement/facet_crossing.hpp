// Where two facets meet.
#pragma once

#include <cstdint>
#include <vector>

#include "arrangement/facet_grid.hpp"

namespace csgcore {

/// A facet, with what many predicates ask of it.
struct PlacedFacet {
  uint32_t number;
  std::array<uint32_t, 3> names;  // of its corners
  std::array<GridPoint, 3> corners;
  GridPlane plane;
};

PlacedFacet placed(const Facets& facets, uint32_t facet);

struct FacetCrossing {
  enum class Kind : uint8_t {
    kNone,
    kLine,     // they meet in the segment from `start` to `end`, which may be one point
    kOverlap,  // they lie in one plane, and have an area in common
  };
  Kind kind = Kind::kNone;
  PointName start;
  PointName end;
  /// An edge of the first facet that lies in the plane of the second, and the other way around; by
  /// its corners, or kNoPlace.
  using Edge = std::array<uint32_t, 2>;
  Edge edge_of_first{kNoPlace, kNoPlace};
  Edge edge_of_second{kNoPlace, kNoPlace};
  /// Facets of one plane that have no area in common: the corners of one that lie on an edge of
  /// the other, and are none of its corners.
  std::vector<Facets::Touch> touches{};
};

/// Returns where the facets meet, edges and corners included.
FacetCrossing crossing_of(const PlacedFacet& t, const PlacedFacet& s);

}  // namespace csgcore
