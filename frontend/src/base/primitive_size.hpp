// How large primitives are, and which sizes can be drawn at all.
#pragma once

#include "csgcore/primitive.hpp"

namespace frontend {

/// Designs from 2^-300 to 2^300 across (1e-90 to 1e90) are drawn: the determinant of a matrix, a
/// product of three, stays well within the doubles.
constexpr int kLargestExponent = 300;

/// A bound of the primitive's extents, from its local size and the matrix without the translation;
/// inf where it is beyond the doubles, 0 where all of them vanish. The shape must be valid
/// (csgcore::has_valid_shape) and the matrix finite.
double size_of(const csgcore::Primitive& primitive);

}  // namespace frontend
