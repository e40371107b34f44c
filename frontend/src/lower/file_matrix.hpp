// The matrix of a multmatrix node, healed.
#pragma once

#include "heal/matrix_healing.hpp"
#include "lower/import_arguments.hpp"

namespace frontend {

/// Heals the matrix as it stands in the file, and divides it. Preconditions: both are finite.
HealedMatrix heal(const FileMatrix& file);

}  // namespace frontend
