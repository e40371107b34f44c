#include <array>
#include <cmath>

#include "base/geometry_dialect.hpp"
#include "subtrees/node_row.hpp"

namespace frontend {
namespace {

/// In NodeKind's order.
constexpr std::array kNodeRows{
    &kSphereRow, &kCylinderRow,      &kCubeRow,          &kPolyhedronRow, &kCircleRow,
    &kSquareRow, &kPolygonRow,       &kTextRow,          &kMultmatrixRow, &kColorRow,
    &kGroupRow,  &kRenderRow,        &kUnionRow,         &kDifferenceRow, &kIntersectionRow,
    &kHullRow,   &kFillRow,          &kMinkowskiRow,     &kProjectionRow, &kOffsetRow,
    &kResizeRow, &kLinearExtrudeRow, &kRotateExtrudeRow, &kImportRow,     &kSurfaceRow,
    &kRoofRow,
};
static_assert(kNodeRows.size() == language::kNodeNames.size());

}  // namespace

const NodeRow& row_of(NodeKind kind) { return *kNodeRows[static_cast<size_t>(kind)]; }

csgcore::FacetSettings chosen(const ImportOptions& options, csgcore::FacetSettings facets) {
  if (options.fn) facets.fn = *options.fn;
  if (GeometryDialect(options.language).rounds_fragments_up) facets.fn = std::ceil(facets.fn);
  if (facets.fn > 0) facets.tolerance = 0;
  return facets;
}

csgcore::FacetSettings chosen(const NodeSources& sources, csgcore::FacetSettings facets) {
  facets = chosen(sources.options, facets);
  const bool is_polygon = facets.fn > 0 && facets.fn <= sources.options.few_fragments;
  if (!is_polygon && sources.options.tolerance > 0) {
    facets.tolerance = sources.options.tolerance / sources.stretch;
  }
  return facets;
}

RoundNode chosen(const NodeSources& sources, RoundNode round) {
  round.facets = chosen(sources, round.facets);
  return round;
}

RoundNode chosen(const ImportOptions& options, RoundNode round) {
  round.facets = chosen(options, round.facets);
  return round;
}

bool keeps_facets(const ImportOptions& options, const csgcore::FacetSettings& facets) {
  switch (options.facets) {
    case Facets::kNone:
      return false;
    case Facets::kFew:
      return facets.fn > 0 && facets.fn <= options.few_fragments;
    case Facets::kAll:
      return true;
  }
  return false;
}

}  // namespace frontend
