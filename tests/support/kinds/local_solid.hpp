// The interface by which the reference intersects a primitive with a ray, in local space and in
// extended precision.
#pragma once

#include <cstdint>
#include <vector>

#include "reference.hpp"

namespace csgcore::reference {

/// A type with 113 bits, for products of two doubles, and sums of them that cancel to the last bit.
/// Where a compiler has no such type, long double has them (AArch64).
#ifdef __SIZEOF_FLOAT128__
__extension__ using Wide = __float128;
#else
using Wide = long double;
#endif

/// A ray relative to a point near the model, however far away the eye or the world's origin may be.
/// t = 0 is about where the ray is nearest to that point.
struct NearRay {
  LongVec3 origin, direction;
};

/// The surface of a crossing. For a polyhedron, the number is that of a half-space; for a mesh see
/// mesh_solid.hpp.
enum class Surface : uint32_t { kBottom = 0, kTop = 1, kSide = 0xFFFFFFFFu };

/// A part of a ray inside a primitive. It is empty unless begin < end.
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
  /// Adds the parts of the ray inside the solid, in order: disjoint, and none empty. `thickness` is
  /// the tolerance, in world units.
  virtual void add_spans(const NearRay& ray, Real thickness, std::vector<Span>& spans) const = 0;
  /// Returns the outward normal, of any length, at a point of that surface.
  virtual LongVec3 normal(const LongVec3& point, Surface surface) const = 0;
};

/// A solid that a ray meets in one span at most.
class ConvexSolid : public LocalSolid {
 public:
  /// Returns the ray's span, which may be empty.
  virtual Span span(const NearRay& ray) const = 0;
  void add_spans(const NearRay& ray, Real, std::vector<Span>& spans) const final {
    const Span own = span(ray);
    if (!own.empty()) spans.push_back(own);
  }
};

}  // namespace csgcore::reference
