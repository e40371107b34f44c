// The matrix of a multmatrix node, healed.
#pragma once

#include "heal/matrix_healing.hpp"
#include "lower/import_arguments.hpp"

namespace frontend {

/// Returns whether the matrix is finite once it is divided.
bool is_affine(const FileMatrix& file);

/// Heals the matrix as it stands in the file or the design, and divides it. Preconditions: both are
/// finite.
HealedMatrix heal(const FileMatrix& file);

}  // namespace frontend
