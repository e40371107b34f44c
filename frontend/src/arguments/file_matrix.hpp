// The matrix of a multmatrix node, as it stands in the file, and healed.
#pragma once

#include "csgcore/geometry.hpp"
#include "heal/matrix_healing.hpp"

namespace frontend {

/// The affine part of a multmatrix as it stands in the file, before the division by m[3][3].
struct FileMatrix {
  csgcore::Affine map;
  double divisor = 1;           // m[3][3]; may be 0
  bool has_all_digits = false;  // NodeTree::has_all_digits
};

bool is_identity(const FileMatrix& file);
/// Returns whether the matrix is finite once it is divided.
bool is_affine(const FileMatrix& file);

/// Heals the matrix as it stands in the file or the design, and divides it. Preconditions: both are
/// finite.
HealedMatrix heal(const FileMatrix& file);
/// The same of what the matrix does in the plane.
HealedMatrix heal_in_plane(FileMatrix file);

}  // namespace frontend
