// The segments and normals of spheres on rays. Included once per instruction set.
#if defined(CSGCORE_SPHERE_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef CSGCORE_SPHERE_INL_HPP
#undef CSGCORE_SPHERE_INL_HPP
#else
#define CSGCORE_SPHERE_INL_HPP
#endif

#include "csgcore/canonical_primitive.hpp"
#include "rays/lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace csgcore {
namespace HWY_NAMESPACE {
namespace sphere_rays {

/// Returns the segment with |o + t·d| ≤ radius.
template <class D>
HWY_INLINE Segment<D> within_radius(D d, const Lanes3<D>& o, const Lanes3<D>& direction,
                                    hn::Vec<D> inverse_length2, hn::Vec<D> radius2) {
  const auto middle = hn::Neg(hn::Mul(dot(d, o, direction), inverse_length2));
  const Lanes3<D> foot = o + scaled(direction, middle);
  return segment_about(d, middle, hn::Sub(radius2, dot(d, foot, foot)), inverse_length2);
}

/// Returns which points (relative to the centre, world units) lie further than `reach` from the
/// ball in canonical space.
template <class D>
HWY_INLINE hn::Mask<D> lies_apart(D d, const CanonicalPrimitive& primitive, const Lanes3<D>& point,
                                  double reach) {
  const Lanes3<D> p = transformed(d, primitive.world_to_canonical, point);
  return hn::Gt(dot(d, p, p), set(d, (1 + reach) * (1 + reach)));
}

}  // namespace sphere_rays

/// See primitive-inl.hpp. Balls and ellipsoids have no caps.
struct SphereRays {
  static constexpr bool kHasCaps = false;

  template <class D>
  static HWY_INLINE Segment<D> segment(D d, const CanonicalPrimitive& primitive, const Vec3& center,
                                       const Rays<D>& rays) {
    const Lanes3<D> o = rays.origin - broadcast(d, center);
    if (primitive.ball_radius > 0) {
      // In world space the lengths of the rays' directions are known.
      const auto radius2 = hn::Set(d, primitive.ball_radius * primitive.ball_radius);
      return sphere_rays::within_radius(d, o, rays.direction, rays.inverse_length2, radius2);
    }
    const Lanes3<D> direction = transformed(d, primitive.world_to_canonical, rays.direction);
    const auto inverse_length2 = hn::Div(hn::Set(d, 1.0), dot(d, direction, direction));
    return sphere_rays::within_radius(d, transformed(d, primitive.world_to_canonical, o), direction,
                                      inverse_length2, hn::Set(d, 1.0));
  }

  template <class D>
  static HWY_INLINE Lanes3<D> normal(D d, const CanonicalPrimitive& primitive, const Vec3& center,
                                     const Rays<D>& rays, hn::Vec<D> t, hn::Mask<D> /*on_cap*/) {
    const Lanes3<D> point = rays.origin - broadcast(d, center) + scaled(rays.direction, t);
    if (primitive.ball_radius > 0) {
      // The length is the radius up to rounding. That is less than 1e-6 of the radius, unless the
      // ball is too small to exist, and two Newton steps remove it.
      const auto guess = hn::Set(d, 1 / primitive.ball_radius);
      return scaled(point, newton_inverse_sqrt(d, dot(d, point, point), guess, 2));
    }
    const Lanes3<D> canonical = transformed(d, primitive.world_to_canonical, point);
    return normalized(d, transformed_back(d, primitive.world_to_canonical, canonical));
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace csgcore
HWY_AFTER_NAMESPACE();

#endif  // include guard
