// The line in which the planes of the facets t and s meet runs along D = n_t × n_s. Each facet
// covers a stretch of it, whose ends are corners or lie on edges. The order of two ends follows
// from orientations of corners alone (Devillers, Guigue, "Faster triangle-triangle intersection
// tests", INRIA 4488, 2002): no point that is not on the grid has to be computed.
#include "arrangement/facet_crossing.hpp"

#include <algorithm>

namespace csgcore {
namespace {

using Sides = std::array<int, 3>;

bool has_corner(const PlacedFacet& facet, uint32_t name) {
  return std::ranges::find(facet.names, name) != facet.names.end();
}

/// Returns the sides of the other facet's plane on which the facet's corners lie.
Sides sides_of(const PlacedFacet& facet, const PlacedFacet& other) {
  Sides result{};
  for (size_t i = 0; i < 3; ++i) {
    const bool is_known = has_corner(other, facet.names[i]);
    result[i] = is_known ? 0 : side(other.plane, facet.corners[i]);
  }
  return result;
}

bool all_are(const Sides& sides, int value) {
  return std::ranges::all_of(sides, [value](int side) { return side == value; });
}

/// An end of a facet's stretch: a corner, or where the edge from a corner to the next one crosses
/// the other facet's plane.
struct End {
  size_t corner;
  bool is_on_edge;
  int rise;  // of an edge: 1 if it comes out above the other plane, -1 if below
};

struct Stretch {
  End start;
  End end;
};

/// Returns the facet's stretch of the line along n × (the other's normal), from the sides of the
/// other plane on which its corners lie: one of them at least is not on it, and they are not all
/// strictly on one side.
Stretch stretch_of(const Sides& sides) {
  // An edge that rises through the other plane, counterclockwise, has the facet's inside ahead of
  // it along the line; one that falls has it behind.
  std::array<End, 2> ends{};
  size_t corners_on_plane = 0;
  size_t apex = 0;  // a corner that is not on the plane
  bool has_edges = false;
  Stretch result{};
  for (size_t i = 0; i < 3; ++i) {
    const size_t next = (i + 1) % 3;
    if (sides[i] == 0) {
      if (corners_on_plane < 2) ends[corners_on_plane] = {i, false, 0};
      ++corners_on_plane;
    } else {
      apex = i;
    }
    if (sides[i] * sides[next] < 0) {
      has_edges = true;
      (sides[next] > 0 ? result.start : result.end) = {i, true, sides[next]};
    }
  }
  if (corners_on_plane == 0) return result;
  if (corners_on_plane == 1) {
    if (!has_edges) return {ends[0], ends[0]};
    // One edge crosses the plane: the corner is the other end.
    const size_t opposite = (ends[0].corner + 1) % 3;
    (sides[opposite] < 0 ? result.end : result.start) = ends[0];
    return result;
  }
  // An edge lies on the plane. If the facet is below it, the edge runs along the line.
  const size_t from = (apex + 1) % 3;
  const size_t to = (apex + 2) % 3;
  const End a{from, false, 0};
  const End b{to, false, 0};
  return sides[apex] < 0 ? Stretch{a, b} : Stretch{b, a};
}

const GridPoint& corner(const PlacedFacet& facet, size_t i) { return facet.corners[i % 3]; }

PointName end_name(const PlacedFacet& facet, const End& end, const PlacedFacet& other) {
  const uint32_t a = facet.names[end.corner];
  if (!end.is_on_edge) return corner_name(a);
  return name_of(a, facet.names[(end.corner + 1) % 3], other.number);
}

/// Returns the side of the facet's edge on which a point of its plane lies: 1 inside.
int side_of_edge(const PlacedFacet& facet, size_t edge, const GridPoint& point) {
  const int axis = facet.plane.axis();
  return turn(corner(facet, edge), corner(facet, edge + 1), point, axis) *
         sign_of(facet.plane.normal[static_cast<size_t>(axis)]);
}

/// Returns the sign of (b − a)·(n_t × n_s) for corners on both planes.
int order_of_corners(const PlacedFacet& t, const PlacedFacet& s, const GridPoint& a,
                     const GridPoint& b) {
  for (size_t i = 0; i < 3; ++i) {
    if (a[i] == b[i]) continue;
    const size_t j = (i + 1) % 3;
    const size_t k = (i + 2) % 3;
    const Wide<4> along = Wide<2>(t.plane.normal[j]) * Wide<2>(s.plane.normal[k]) -
                          Wide<2>(t.plane.normal[k]) * Wide<2>(s.plane.normal[j]);
    return along.sign() * (b[i] > a[i] ? 1 : -1);
  }
  return 0;
}

/// Returns 1 if the end q of s lies beyond the end p of t along the line, -1 if before it, 0 if
/// they are one point. MESHES.md derives the four cases.
int order(const PlacedFacet& t, const End& p, const PlacedFacet& s, const End& q) {
  const GridPoint& a = t.corners[p.corner];
  const GridPoint& c = s.corners[q.corner];
  if (p.is_on_edge && q.is_on_edge) {
    return orientation(a, corner(t, p.corner + 1), c, corner(s, q.corner + 1)) * p.rise * q.rise;
  }
  if (p.is_on_edge) return side_of_edge(t, p.corner, c) * p.rise;
  if (q.is_on_edge) return side_of_edge(s, q.corner, a) * q.rise;
  return order_of_corners(t, s, a, c);
}

FacetCrossing::Edge edge_on_plane(const PlacedFacet& facet, const Sides& sides) {
  for (size_t i = 0; i < 3; ++i) {
    const size_t next = (i + 1) % 3;
    if (sides[i] == 0 && sides[next] == 0) return {facet.names[i], facet.names[next]};
  }
  return {kNoPlace, kNoPlace};
}

/// Returns whether the point lies in the facet's plane within the facet or on its boundary.
bool covers(const PlacedFacet& facet, const GridPoint& point) {
  for (size_t i = 0; i < 3; ++i) {
    if (side_of_edge(facet, i, point) < 0) return false;
  }
  return true;
}

/// Returns whether all corners of `other` lie on or beyond an edge of the facet.
bool is_beyond_an_edge(const PlacedFacet& facet, const PlacedFacet& other) {
  for (size_t i = 0; i < 3; ++i) {
    const auto is_beyond = [&](const GridPoint& point) {
      return side_of_edge(facet, i, point) <= 0;
    };
    if (std::ranges::all_of(other.corners, is_beyond)) return true;
  }
  return false;
}

FacetCrossing coplanar_crossing(const PlacedFacet& t, const PlacedFacet& s) {
  FacetCrossing result;
  if (!is_beyond_an_edge(t, s) && !is_beyond_an_edge(s, t)) {
    result.kind = FacetCrossing::Kind::kOverlap;
    return result;
  }
  for (const auto& [facet, other] : {std::pair(&t, &s), std::pair(&s, &t)}) {
    for (size_t i = 0; i < 3; ++i) {
      if (!has_corner(*facet, other->names[i]) && covers(*facet, other->corners[i])) {
        result.touches.push_back({facet->number, other->names[i]});
      }
    }
  }
  return result;
}

}  // namespace

PlacedFacet placed(const Facets& facets, uint32_t facet) {
  return {facet, facets.facets[facet].corners, facets.corners(facet), facets.plane(facet)};
}

FacetCrossing crossing_of(const PlacedFacet& t, const PlacedFacet& s) {
  const Sides t_sides = sides_of(t, s);
  if (all_are(t_sides, 1) || all_are(t_sides, -1)) return {};
  if (all_are(t_sides, 0)) return coplanar_crossing(t, s);
  const Sides s_sides = sides_of(s, t);
  if (all_are(s_sides, 1) || all_are(s_sides, -1)) return {};
  FacetCrossing result;
  const Stretch on_t = stretch_of(t_sides);
  // A corner that both have is all that t has of the plane.
  const uint32_t corner_of_t = t.names[on_t.start.corner];
  if (!on_t.start.is_on_edge && !on_t.end.is_on_edge && on_t.start.corner == on_t.end.corner &&
      has_corner(s, corner_of_t)) {
    result.kind = FacetCrossing::Kind::kLine;
    result.start = result.end = corner_name(corner_of_t);
    return result;
  }
  Stretch on_s = stretch_of(s_sides);
  // It is along n_s × n_t, the other way.
  std::swap(on_s.start, on_s.end);
  if (order(t, on_t.start, s, on_s.end) < 0 || order(t, on_t.end, s, on_s.start) > 0) return {};
  const bool starts_with_s = order(t, on_t.start, s, on_s.start) > 0;
  const bool ends_with_s = order(t, on_t.end, s, on_s.end) < 0;
  result.kind = FacetCrossing::Kind::kLine;
  result.start = starts_with_s ? end_name(s, on_s.start, t) : end_name(t, on_t.start, s);
  result.end = ends_with_s ? end_name(s, on_s.end, t) : end_name(t, on_t.end, s);
  result.edge_of_first = edge_on_plane(t, t_sides);
  result.edge_of_second = edge_on_plane(s, s_sides);
  return result;
}

}  // namespace csgcore
