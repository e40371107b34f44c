// What the reference asks of a primitive: one ray through its solid, in local space and in extended
// precision.
#pragma once

#include <cstdint>

#include "reference.hpp"

namespace csgcore::reference {

/// Products of two doubles and sums of them that cancel to the last bit: 113 bits. Where a compiler
/// has no such type, long double has them (AArch64).
#ifdef __SIZEOF_FLOAT128__
__extension__ using Wide = __float128;
#else
using Wide = long double;
#endif

/// A ray near the model, however far from it the eye, or the world's origin, may be: positions are
/// relative to a point near the model, and t = 0 is where the ray is nearest to it, or about there.
struct NearRay {
  LongVec3 origin, direction;
};

/// Of a polyhedron, the half-space of that index.
enum class Surface : uint32_t { kBottom = 0, kTop = 1, kSide = 0xFFFFFFFFu };

/// The part of a ray inside a primitive. Empty unless begin < end.
struct Span {
  Real begin = 0, end = 0;
  Surface begin_surface = Surface::kSide, end_surface = Surface::kSide;
  bool empty() const { return !(begin < end); }
};

/// The solid of one primitive, prepared for rays. Points and rays are in local space, relative to
/// the point (0, 0, middle_z()).
class LocalSolid {
 public:
  virtual ~LocalSolid() = default;
  virtual Wide middle_z() const { return 0; }
  virtual Span span(const NearRay& ray) const = 0;
  /// The outward normal, of any length, at a point of that surface.
  virtual LongVec3 normal(const LongVec3& point, Surface surface) const = 0;
};

}  // namespace csgcore::reference
