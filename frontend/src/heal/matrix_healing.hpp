// Undoing the rounding to 6 digits of a multmatrix (frontend/HEALING.md).
#pragma once

#include "csgcore/geometry.hpp"

namespace frontend {

/// A matrix and how far each of its entries may be from the design's, because the file rounded it.
/// Errors of 0: the entry is taken as exact.
struct HealedMatrix {
  csgcore::Affine map;
  csgcore::Mat3 linear_error{0.0};
  csgcore::Vec3 translation_error{0.0};
  bool exact = true;  // all errors are 0
};

/// A number as a file gives it.
struct Digits {
  int count;         // significant digits: 0 (for 0) to 6, or 7 for more
  double half_unit;  // of the sixth digit; 0 for 0 and where no rounding to six made the number
};
/// Precondition: finite.
Digits digits_of(double value);

/// Sine and cosine of an angle in degrees, exact at multiples of 30 and 45 (as OpenSCAD's are).
double sin_deg(double angle_deg);
double cos_deg(double angle_deg);

/// OpenSCAD's rotate([x, y, z]): Rz·Ry·Rx.
csgcore::Mat3 euler_rotation(const csgcore::Vec3& angles_deg);

/// The matrix that the design most simply meant. A linear part within rounding of a rotation, a
/// mirror or a uniform scale times one becomes exactly that; every entry stays within its rounding.
/// Everything else stays as it is. Precondition: finite.
HealedMatrix heal_matrix(const csgcore::Affine& from_file);

}  // namespace frontend
