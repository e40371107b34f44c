// Undoes the rounding of a multmatrix to 6 digits (frontend/HEALING.md).
#pragma once

#include "csgcore/geometry.hpp"

namespace frontend {

/// A matrix, and how far the rounding in the file may have moved each of its entries from the
/// design's. An error of 0 means that the entry is taken as exact.
struct HealedMatrix {
  csgcore::Affine map;
  csgcore::Mat3 linear_error{0.0};
  csgcore::Vec3 translation_error{0.0};
  bool exact = true;  // all errors are 0
};

/// The precision of a number in a file.
struct Digits {
  int count;         // significant digits: 0 (for 0) to 6; 7 means more
  double half_unit;  // half a unit of the sixth digit; 0 for 0, and if the number was not rounded
                     // to six
};
/// Precondition: `value` is finite.
Digits digits_of(double value);

/// Returns how far a number of a design may be from what is meant: half a unit of its last digit if
/// it has 6 to 10 significant digits, as a person types for 1/3. 0 for shorter numbers, which are
/// meant so, and for longer ones, which are computed. Precondition: `value` is finite.
double typed_error(double value);

/// OpenSCAD's rotate([x, y, z]): Rz·Ry·Rx.
csgcore::Mat3 euler_rotation(const csgcore::Vec3& angles_deg);

/// Returns the simplest matrix that the design may have meant. A linear part that is within
/// rounding of a rotation, a mirror, or a uniform scale times one of them becomes exactly that;
/// every entry stays within its rounding. Anything else stays as it is. Precondition: `from_file`
/// is finite.
HealedMatrix heal_matrix(const csgcore::Affine& from_file);

/// The same for a matrix whose entries are the design's own doubles. It stays as it is unless a
/// person has typed some of them with 6 to 10 digits (typed_error).
HealedMatrix heal_typed_matrix(const csgcore::Affine& from_design);

}  // namespace frontend
