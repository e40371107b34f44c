// The frustum on rays: its segment, and its normal. Included once per instruction set.
#if defined(CSGCORE_FRUSTUM_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef CSGCORE_FRUSTUM_INL_HPP
#undef CSGCORE_FRUSTUM_INL_HPP
#else
#define CSGCORE_FRUSTUM_INL_HPP
#endif

#include "lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace csgcore {
namespace HWY_NAMESPACE {
namespace frustum_rays {

/// A segment, and whether each end lies on a flat face.
template <class D>
struct Crossings {
  Segment<D> segment;
  hn::Mask<D> start_on_cap, end_on_cap;
};

/// In canonical space: the slab |z| ≤ 1 cut with the wall x² + y² ≤ (mid + slope·z)², on the nappe
/// where that radius is ≥ 0.
template <class D>
HWY_INLINE Crossings<D> crossings(D d, const CanonicalPrimitive& primitive, Lanes3<D> p,
                                  const Lanes3<D>& direction) {
  const auto zero = hn::Zero(d);
  const auto one = hn::Set(d, 1.0);
  const auto infinite = hn::Set(d, kInfinity);
  // The slab. A ray along it (1/0) is inside for ever or never; 0·∞ is NaN, hence the cases.
  const auto level = hn::Eq(direction.z, zero);
  const auto inverse_z = hn::Div(one, hn::IfThenElse(level, one, direction.z));
  const auto at_bottom = hn::Mul(hn::Sub(hn::Neg(one), p.z), inverse_z);
  const auto at_top = hn::Mul(hn::Sub(one, p.z), inverse_z);
  const auto level_outside = hn::And(level, hn::Gt(hn::Abs(p.z), one));
  auto slab_start = hn::IfThenElse(level, hn::Neg(infinite), hn::Min(at_bottom, at_top));
  auto slab_end = hn::IfThenElse(level, infinite, hn::Max(at_bottom, at_top));
  // Re-based at the ray's point nearest to the axis within the slab, where nothing cancels.
  const auto lateral2 =
      hn::Add(hn::Mul(direction.x, direction.x), hn::Mul(direction.y, direction.y));
  const auto along = hn::Eq(lateral2, zero);
  const auto to_axis = hn::Neg(hn::Add(hn::Mul(p.x, direction.x), hn::Mul(p.y, direction.y)));
  const auto nearest =
      hn::IfThenElseZero(hn::Not(along), hn::Div(to_axis, hn::IfThenElse(along, one, lateral2)));
  const auto base = hn::Max(hn::Min(nearest, slab_end), slab_start);
  p = p + scaled(direction, base);
  slab_start = hn::Sub(slab_start, base);
  slab_end = hn::Sub(slab_end, base);
  // The wall: a·t² + 2h·t + c ≤ 0.
  const auto slope = hn::Set(d, primitive.radius_slope);
  const auto radius = hn::Add(hn::Set(d, primitive.radius_mid), hn::Mul(slope, p.z));
  const auto growth = hn::Mul(slope, direction.z);
  const auto a = hn::Sub(lateral2, hn::Mul(growth, growth));
  const auto h = hn::Sub(hn::Add(hn::Mul(p.x, direction.x), hn::Mul(p.y, direction.y)),
                         hn::Mul(growth, radius));
  const auto c = hn::Sub(hn::Add(hn::Mul(p.x, p.x), hn::Mul(p.y, p.y)), hn::Mul(radius, radius));
  const auto discriminant = hn::Sub(hn::Mul(h, h), hn::Mul(a, c));
  // Roots without cancellation: q/a and c/q. q = 0: through the apex, both at 0.
  const auto root = hn::Sqrt(hn::Max(discriminant, zero));
  const auto q = hn::Neg(hn::Add(h, hn::CopySign(root, h)));
  const auto q_is_zero = hn::Eq(q, zero);
  const auto a_is_zero = hn::Eq(a, zero);
  const auto by_a = hn::Div(q, hn::IfThenElse(a_is_zero, one, a));
  // a = 0: the other root is at infinity, on the side that q points to.
  const auto root_a = hn::IfThenElse(a_is_zero, hn::CopySign(infinite, q), by_a);
  const auto root_c =
      hn::IfThenElseZero(hn::Not(q_is_zero), hn::Div(c, hn::IfThenElse(q_is_zero, one, q)));
  const auto low = hn::Min(root_a, root_c);
  const auto high = hn::Max(root_a, root_c);
  // a ≥ 0: between the roots. a < 0: beyond one of them, on the nappe that the radius grows into.
  const auto between = hn::Ge(a, zero);
  const auto grows = hn::Gt(growth, zero);
  auto wall_start = hn::IfThenElse(between, low, hn::IfThenElse(grows, high, hn::Neg(infinite)));
  auto wall_end = hn::IfThenElse(between, high, hn::IfThenElse(grows, infinite, low));
  // Neither a nor h: the ray keeps its distance from the wall, along the axis of a cylinder.
  const auto keeps = hn::And(a_is_zero, hn::Eq(h, zero));
  wall_start = hn::IfThenElse(keeps, hn::Neg(infinite), wall_start);
  wall_end = hn::IfThenElse(keeps, infinite, wall_end);
  const auto misses = hn::Or(hn::And(keeps, hn::Gt(c, zero)),
                             hn::AndNot(keeps, hn::And(between, hn::Le(discriminant, zero))));
  const auto start_on_cap = hn::Gt(slab_start, wall_start);
  const auto end_on_cap = hn::Lt(slab_end, wall_end);
  const auto start = hn::Add(base, hn::Max(slab_start, wall_start));
  const auto end = hn::Add(base, hn::Min(slab_end, wall_end));
  const auto exists = hn::AndNot(hn::Or(misses, level_outside), hn::Lt(start, end));
  return {segment_if(d, exists, start, end), start_on_cap, end_on_cap};
}

/// Whether all lanes pass the frustum's axis further away than its larger radius, by the line's
/// moment about the axis: most rays that miss, at a fraction of the cost. The slack is far above
/// what is rounded here and far below what matters: passing is decided by `crossings`.
template <class D>
HWY_INLINE bool all_pass(D d, const Lanes3<D>& p, const Lanes3<D>& direction) {
  constexpr double kPassSlack = 1e-6;
  const auto moment = hn::Sub(hn::Mul(p.x, direction.y), hn::Mul(p.y, direction.x));
  const auto lateral2 =
      hn::Add(hn::Mul(direction.x, direction.x), hn::Mul(direction.y, direction.y));
  const auto limit = hn::Mul(lateral2, hn::Set(d, 1.0 + kPassSlack));
  return hn::AllTrue(d, hn::Gt(hn::Mul(moment, moment), limit));
}

template <class D>
HWY_INLINE Segment<D> segment(D d, const CanonicalPrimitive& primitive, const Vec3& center,
                              const Rays<D>& rays) {
  const Mat3& map = primitive.world_to_canonical;
  const Lanes3<D> p = transformed(d, map, rays.origin - broadcast(d, center));
  const Lanes3<D> direction = transformed(d, map, rays.direction);
  if (all_pass(d, p, direction)) return {hn::Set(d, kInfinity), hn::Set(d, -kInfinity)};
  return crossings(d, primitive, p, direction).segment;
}

/// Outward and unit, at the point that lies at τ = t, the end of the segment in lanes of `at_end`,
/// else its start.
template <class D>
HWY_INLINE Lanes3<D> normal(D d, const CanonicalPrimitive& primitive, const Vec3& center,
                            const Rays<D>& rays, hn::Vec<D> t, hn::Mask<D> at_end) {
  const Mat3& map = primitive.world_to_canonical;
  const Lanes3<D> p = transformed(d, map, rays.origin - broadcast(d, center));
  const Lanes3<D> direction = transformed(d, map, rays.direction);
  const Crossings<D> found = crossings(d, primitive, p, direction);
  const auto on_cap =
      hn::Or(hn::And(at_end, found.end_on_cap), hn::AndNot(at_end, found.start_on_cap));
  const Lanes3<D> point = p + scaled(direction, t);
  // A cap faces along the axis: upwards where the ray leaves rising or enters falling.
  const auto one = hn::Set(d, 1.0);
  const auto upwards = hn::IfThenElse(at_end, direction.z, hn::Neg(direction.z));
  const auto slope = hn::Set(d, primitive.radius_slope);
  // The wall's gradient has the distance from the axis for a radius: at the apex none is left, and
  // the axis' direction away from the cone's body stands in.
  const auto across = hn::Sqrt(hn::Add(hn::Mul(point.x, point.x), hn::Mul(point.y, point.y)));
  const auto is_apex = hn::Eq(across, hn::Zero(d));
  const auto wall_z =
      hn::IfThenElse(is_apex, hn::CopySign(one, hn::Neg(slope)), hn::Neg(hn::Mul(slope, across)));
  const Lanes3<D> gradient = {hn::IfThenElseZero(hn::Not(on_cap), point.x),
                              hn::IfThenElseZero(hn::Not(on_cap), point.y),
                              hn::IfThenElse(on_cap, hn::CopySign(one, upwards), wall_z)};
  return normalized(d, transformed_back(d, map, gradient));
}

}  // namespace frustum_rays
}  // namespace HWY_NAMESPACE
}  // namespace csgcore
HWY_AFTER_NAMESPACE();

#endif  // include guard
