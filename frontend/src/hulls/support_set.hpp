// What convex body a primitive spans.
#pragma once

#include <optional>
#include <span>

#include "csgcore/primitive.hpp"
#include "hulls/generator.hpp"
#include "plane/figure.hpp"

namespace frontend {

/// Generators, and whether points stand for curves among them.
struct SupportSet {
  Generators generators;
  bool is_faceted = false;
};

/// Adds generators of the primitive's hull, under its matrix. Its shape is valid; its matrix may be
/// singular.
void add_support(const csgcore::Primitive& primitive, SupportSet& support);

/// Returns whether the primitive is known to be convex.
bool is_convex(const csgcore::Primitive& primitive);

/// Returns whether the loop is the boundary, counterclockwise, of a convex figure of lines and
/// arcs.
bool is_convex_loop(const csgcore::ProfileLoop& loop);

}  // namespace frontend
