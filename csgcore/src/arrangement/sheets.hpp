// Facets, divided by all that meets them.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "arrangement/covers.hpp"
#include "arrangement/facet_grid.hpp"
#include "arrangement/planar_subdivision.hpp"

namespace csgcore {

/// A facet, or several of one plane that overlap, divided into triangles which no surface crosses.
struct Sheet {
  int axis;  // along which its plane is drawn
  std::vector<ArrangedPoint> points;
  std::vector<PlanarSubdivision::Alias> aliases;
  /// By triangle: its points, counterclockwise in the drawing, and which of `covers` it is.
  std::vector<std::array<uint32_t, 3>> triangles;
  std::vector<uint32_t> cover_of;
  /// By triangle: its edges along which a surface meets the plane, as bits: 1 << edge.
  std::vector<uint8_t> met_edges;
  /// Facets that lie over one another, in rising order; none is empty.
  std::vector<std::vector<uint32_t>> covers;
};

struct Sheets {
  std::vector<Sheet> sheets;
  /// By facet: whether it is part of a sheet.
  std::vector<bool> is_divided;
};

/// Divides facets by those with which they are paired, but where another operand hides both.
Sheets sheets_of(const Facets& facets, const std::vector<std::pair<uint32_t, uint32_t>>& pairs,
                 const Covers& covers);

}  // namespace csgcore
