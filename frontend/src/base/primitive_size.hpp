// The size of primitives, and which sizes can be drawn at all.
#pragma once

#include "csgcore/primitive.hpp"

namespace frontend {

/// Designs from 2^-300 to 2^300 across (1e-90 to 1e90) are drawn. The determinant of their
/// matrices, a product of three factors, stays well within the range of doubles.
constexpr int kLargestExponent = 300;

/// Returns a bound of the primitive's extents, from its local size and its matrix without the
/// translation. It is inf beyond the range of doubles, and 0 if all extents vanish. Preconditions:
/// the shape is valid (csgcore::has_valid_shape), and the matrix finite.
double size_of(const csgcore::Primitive& primitive);

}  // namespace frontend
