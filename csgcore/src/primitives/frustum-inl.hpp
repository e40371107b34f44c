// The segments and normals of frusta on rays. Included once per instruction set.
#if defined(CSGCORE_FRUSTUM_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef CSGCORE_FRUSTUM_INL_HPP
#undef CSGCORE_FRUSTUM_INL_HPP
#else
#define CSGCORE_FRUSTUM_INL_HPP
#endif

#include "csgcore/canonical_primitive.hpp"
#include "rays/lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace csgcore {
namespace HWY_NAMESPACE {
namespace frustum_rays {

template <class D>
struct Interval {
  hn::Vec<D> start, end;
};

/// A ray runs along the axis if its direction has less than this share across it, and it is level
/// if its direction has less than this share along it. Within the frustum such a ray does not drift
/// by a bit of its coordinates.
constexpr double kTrace = 1e-30;

/// The reciprocals of a direction's z and of its squared lateral part, or 1 where the ray is level
/// or along the axis. One division makes both, since most of an intersection waits for divisions.
/// The product of the two numbers cannot over- or underflow, since kTrace excludes tiny ones.
template <class D>
struct Inverses {
  hn::Vec<D> z, lateral2;
  hn::Mask<D> level, along;
};
template <class D>
HWY_INLINE Inverses<D> inverses(D d, const Lanes3<D>& direction, hn::Vec<D> lateral2) {
  const auto one = hn::Set(d, 1.0);
  const auto trace2 = hn::Set(d, kTrace * kTrace);
  const auto z2 = hn::Mul(direction.z, direction.z);
  const auto level = hn::Le(z2, hn::Mul(trace2, lateral2));
  const auto along = hn::Le(lateral2, hn::Mul(trace2, z2));
  const auto z = hn::IfThenElse(level, one, direction.z);
  const auto lateral = hn::IfThenElse(along, one, lateral2);
  const auto inverse = hn::Div(one, hn::Mul(z, lateral));
  return {hn::Mul(inverse, lateral), hn::Mul(inverse, z), level, along};
}

/// Returns the interval with |z| ≤ 1, which is empty for a level ray outside of the slab.
template <class D>
HWY_INLINE Interval<D> slab(D d, hn::Vec<D> z, const Inverses<D>& inverse) {
  const auto one = hn::Set(d, 1.0);
  const auto at_bottom = hn::Mul(hn::Sub(hn::Neg(one), z), inverse.z);
  const auto at_top = hn::Mul(hn::Sub(one, z), inverse.z);
  const Interval<D> sloped = {hn::Min(at_bottom, at_top), hn::Max(at_bottom, at_top)};
  if (hn::AllFalse(d, inverse.level)) return sloped;
  // A level ray is inside everywhere or nowhere.
  const auto infinite = hn::Set(d, kInfinity);
  const auto outside = hn::Gt(hn::Abs(z), one);
  const auto level_start = hn::IfThenElse(outside, infinite, hn::Neg(infinite));
  return {hn::IfThenElse(inverse.level, level_start, sloped.start),
          hn::IfThenElse(inverse.level, hn::Neg(level_start), sloped.end)};
}

/// Returns the intersection of the slab's interval with the wall's segment.
template <class D>
HWY_INLINE Segment<D> cut(D d, const Interval<D>& slab, const Segment<D>& wall) {
  const auto start = hn::Max(slab.start, wall.start);
  const auto end = hn::Min(slab.end, wall.end);
  return segment_if(d, hn::Lt(start, end), start, end, hn::Gt(slab.start, wall.start),
                    hn::Lt(slab.end, wall.end));
}

template <class D>
HWY_INLINE hn::Vec<D> dot_xy(const Lanes3<D>& a, const Lanes3<D>& b) {
  return hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y));
}

/// Returns the segment within the cylinder's wall in canonical space, x² + y² ≤ 1.
template <class D>
HWY_INLINE Segment<D> cylinder_wall(D d, const Lanes3<D>& p, const Lanes3<D>& direction,
                                    const Inverses<D>& inverse) {
  const auto middle = hn::Neg(hn::Mul(dot_xy(p, direction), inverse.lateral2));
  const Lanes3<D> foot = p + scaled(direction, middle);
  const auto inside = hn::Sub(hn::Set(d, 1.0), dot_xy(foot, foot));
  const Segment<D> wall = segment_about(d, middle, inside, inverse.lateral2);
  if (hn::AllFalse(d, inverse.along)) return wall;
  // A ray along the axis keeps its distance from it, and is inside everywhere or nowhere.
  const auto endless = hn::And(inverse.along, hn::Ge(inside, hn::Zero(d)));
  return {hn::IfThenElse(endless, hn::Set(d, -kInfinity), wall.start),
          hn::IfThenElse(endless, hn::Set(d, kInfinity), wall.end), wall.start_on_cap,
          wall.end_on_cap};
}

/// If q of a cone's quadratic is less than this, the ray passes through the apex, as far as doubles
/// tell, and c/q might overflow.
constexpr double kLeastQ = 1e-290;

/// Returns the segment within the cone's wall in canonical space, x² + y² ≤ (mid + slope·z)², on
/// the nappe where that radius is ≥ 0. It is valid within the slab only.
template <class D>
HWY_INLINE Segment<D> cone_wall(D d, const CanonicalPrimitive& primitive, Lanes3<D> p,
                                const Lanes3<D>& direction, hn::Vec<D> lateral2,
                                const Inverses<D>& inverse, const Interval<D>& slab) {
  const auto zero = hn::Zero(d);
  const auto one = hn::Set(d, 1.0);
  const auto infinite = hn::Set(d, kInfinity);
  // Re-base the ray at its point nearest to the axis within the slab, where nothing cancels.
  const auto nearest = hn::Neg(hn::Mul(dot_xy(p, direction), inverse.lateral2));
  const auto within = hn::Max(hn::Min(nearest, slab.end), slab.start);
  // For an empty slab any base will do.
  const auto base = hn::IfThenElse(hn::Lt(hn::Abs(within), infinite), within, zero);
  p = p + scaled(direction, base);
  // The inside of the wall is a·t² + 2h·t + c ≤ 0.
  const auto slope = hn::Set(d, primitive.radius_slope);
  const auto radius = hn::Add(hn::Set(d, primitive.radius_mid), hn::Mul(slope, p.z));
  const auto growth = hn::Mul(slope, direction.z);
  const auto a = hn::Sub(lateral2, hn::Mul(growth, growth));
  const auto h = hn::Sub(dot_xy(p, direction), hn::Mul(growth, radius));
  const auto c = hn::Sub(dot_xy(p, p), hn::Mul(radius, radius));
  // h² − a·c = |radius·d − growth·p|² − (p × d)² across the axis. This form has none of the
  // products that h² and a·c have in common and that would cancel.
  const auto lean_x = hn::Sub(hn::Mul(radius, direction.x), hn::Mul(growth, p.x));
  const auto lean_y = hn::Sub(hn::Mul(radius, direction.y), hn::Mul(growth, p.y));
  const auto moment = hn::Sub(hn::Mul(p.x, direction.y), hn::Mul(p.y, direction.x));
  const auto squares =
      hn::Sub(hn::Add(hn::Mul(lean_x, lean_x), hn::Mul(lean_y, lean_y)), hn::Mul(moment, moment));
  // If a·c ≤ 0, nothing cancels in h² − a·c.
  const auto product = hn::Mul(a, c);
  const auto discriminant =
      hn::IfThenElse(hn::Le(product, zero), hn::Sub(hn::Mul(h, h), product), squares);
  // The ray is inside between the roots if a ≥ 0, and beyond one of them, on the nappe into which
  // the radius grows, if a < 0.
  const auto between = hn::Ge(a, zero);
  const auto a_is_zero = hn::Eq(a, zero);
  auto misses = hn::And(between, hn::Le(discriminant, zero));
  // The roots q/a and c/q have no cancellation. One division makes both, as in inverses().
  const auto root = hn::Sqrt(hn::Max(discriminant, zero));
  const auto q = hn::Neg(hn::Add(h, hn::CopySign(root, h)));
  const auto quotient = hn::Div(one, hn::Mul(a, q));
  auto root_a = hn::Mul(q, hn::Mul(q, quotient));
  auto root_c = hn::Mul(c, hn::Mul(a, quotient));
  const auto q_is_zero = hn::Lt(hn::Abs(q), hn::Set(d, kLeastQ));
  const auto is_special = hn::Or(a_is_zero, q_is_zero);
  if (!hn::AllFalse(d, is_special)) {
    // If q is 0, the ray passes through the apex, and both roots are 0. If a is 0, one root is at
    // infinity, on the side that q points to. If a and h are 0, the ray keeps its distance from the
    // wall.
    const auto keeps = hn::And(a_is_zero, hn::Eq(h, zero));
    const auto c_over_q = hn::IfThenElseZero(hn::Not(q_is_zero), hn::Div(c, q));
    root_a = hn::IfThenElse(q_is_zero, zero, root_a);
    root_a = hn::IfThenElse(a_is_zero, hn::CopySign(infinite, q), root_a);
    root_a = hn::IfThenElse(keeps, hn::Neg(infinite), root_a);
    root_c = hn::IfThenElse(is_special, c_over_q, root_c);
    root_c = hn::IfThenElse(keeps, infinite, root_c);
    misses = hn::Or(hn::AndNot(keeps, misses), hn::And(keeps, hn::Gt(c, zero)));
  }
  const auto low = hn::Min(root_a, root_c);
  const auto high = hn::Max(root_a, root_c);
  const auto grows = hn::Gt(growth, zero);
  const auto start = hn::IfThenElse(between, low, hn::IfThenElse(grows, high, hn::Neg(infinite)));
  const auto end = hn::IfThenElse(between, high, hn::IfThenElse(grows, infinite, low));
  return segment_if(d, hn::Not(misses), hn::Add(base, start), hn::Add(base, end), no_lanes(d),
                    no_lanes(d));
}

/// Returns the segment of rays p + t·direction in canonical space.
template <class D>
HWY_INLINE Segment<D> canonical_segment(D d, const CanonicalPrimitive& primitive,
                                        const Lanes3<D>& p, const Lanes3<D>& direction) {
  const auto lateral2 = dot_xy(direction, direction);
  const Inverses<D> inverse = inverses(d, direction, lateral2);
  const Interval<D> ends = slab(d, p.z, inverse);
  return cut(d, ends,
             primitive.radius_slope == 0
                 ? cylinder_wall(d, p, direction, inverse)
                 : cone_wall(d, primitive, p, direction, lateral2, inverse, ends));
}

/// Returns which points (relative to the centre, world units) lie further than `reach` from the
/// solid in canonical space: beyond an end, or beyond the wall moved outward.
template <class D>
HWY_INLINE hn::Mask<D> lies_apart(D d, const CanonicalPrimitive& primitive, const Lanes3<D>& point,
                                  double reach) {
  const Lanes3<D> p = transformed(d, primitive.world_to_canonical, point);
  const double slope = primitive.radius_slope;
  const auto beyond = hn::Gt(hn::Abs(p.z), set(d, 1 + reach));
  // The wall moves outward by reach·√(1 + slope²) ≤ reach·(1 + |slope|), measured across the axis.
  const auto moved = set(d, primitive.radius_mid + reach * (1 + std::abs(slope)));
  const auto radius = hn::Max(hn::Add(moved, hn::Mul(set(d, slope), p.z)), hn::Zero(d));
  return hn::Or(beyond, hn::Gt(dot_xy(p, p), hn::Mul(radius, radius)));
}

/// A cone's radius is a good guess at a surface point's distance from the axis unless it is less
/// than this.
constexpr double kNearApex = 0x1p-20;

/// A point whose squared distance from the axis is less is the apex: a gradient of its coordinates
/// would have no length, since squares of smaller numbers underflow in world space.
constexpr double kApex2 = 1e-200;

}  // namespace frustum_rays

/// See primitive-inl.hpp. An end lies on a cap or on the wall.
struct FrustumRays {
  static constexpr bool kHasCaps = true;

  template <class D>
  static HWY_INLINE Segment<D> segment(D d, const CanonicalPrimitive& primitive, const Vec3& center,
                                       const Rays<D>& rays) {
    const Mat3& map = primitive.world_to_canonical;
    return frustum_rays::canonical_segment(d, primitive,
                                           transformed(d, map, rays.origin - broadcast(d, center)),
                                           transformed(d, map, rays.direction));
  }

  template <class D>
  static HWY_INLINE Lanes3<D> normal(D d, const CanonicalPrimitive& primitive, const Vec3& center,
                                     const Rays<D>& rays, hn::Vec<D> t, hn::Mask<D> on_cap) {
    const Mat3& map = primitive.world_to_canonical;
    const Lanes3<D> offset = rays.origin - broadcast(d, center) + scaled(rays.direction, t);
    const Lanes3<D> point = transformed(d, map, offset);
    const auto one = hn::Set(d, 1.0);
    auto wall_z = hn::Zero(d);
    if (primitive.radius_slope != 0) {
      // The wall's gradient needs the point's distance from the axis. It is the wall's radius up to
      // rounding, which one Newton step removes, unless next to the apex. At the apex itself, where
      // there is no gradient, the axis' direction away from the cone's body stands in.
      const auto downhill = hn::Set(d, -primitive.radius_slope);
      const auto radius = hn::Sub(hn::Set(d, primitive.radius_mid), hn::Mul(downhill, point.z));
      const auto across2 = frustum_rays::dot_xy(point, point);
      const auto guess = hn::Div(one, radius);
      const auto across = hn::Mul(across2, newton_inverse_sqrt(d, across2, guess, 1));
      wall_z = hn::Mul(downhill, across);
      const auto near_apex = hn::Lt(radius, hn::Set(d, frustum_rays::kNearApex));
      if (!hn::AllFalse(d, near_apex)) {
        const auto exact = hn::Mul(across2, inverse_sqrt(d, across2));
        const auto is_apex = hn::Lt(across2, hn::Set(d, frustum_rays::kApex2));
        const auto there =
            hn::IfThenElse(is_apex, hn::CopySign(one, downhill), hn::Mul(downhill, exact));
        wall_z = hn::IfThenElse(near_apex, there, wall_z);
      }
    }
    const Lanes3<D> gradient = {hn::IfThenElseZero(hn::Not(on_cap), point.x),
                                hn::IfThenElseZero(hn::Not(on_cap), point.y),
                                hn::IfThenElse(on_cap, hn::CopySign(one, point.z), wall_z)};
    return normalized(d, transformed_back(d, map, gradient));
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace csgcore
HWY_AFTER_NAMESPACE();

#endif  // include guard
