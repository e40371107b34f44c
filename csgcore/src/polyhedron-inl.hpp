// The convex polyhedron on rays: its segment, and its normal. Included once per instruction set.
#if defined(CSGCORE_POLYHEDRON_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef CSGCORE_POLYHEDRON_INL_HPP
#undef CSGCORE_POLYHEDRON_INL_HPP
#else
#define CSGCORE_POLYHEDRON_INL_HPP
#endif

#include "csgcore/polyhedron.hpp"
#include "frustum-inl.hpp"
#include "sphere-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace csgcore {
namespace HWY_NAMESPACE {
namespace polyhedron_rays {

/// The part of a segment within a face's half-space, height + t·growth ≤ 1, in the lanes where an
/// end lies beyond it.
template <class D>
HWY_INLINE Segment<D> cut(D d, const Segment<D>& segment, hn::Vec<D> height, hn::Vec<D> growth,
                          hn::Mask<D> beyond) {
  const auto zero = hn::Zero(d);
  const auto at = hn::Div(hn::Sub(hn::Set(d, 1.0), height), growth);
  const auto enters = hn::And(beyond, hn::Lt(growth, zero));
  const auto leaves = hn::And(beyond, hn::Gt(growth, zero));
  // A ray along the face is beyond it for ever.
  const auto never = hn::And(beyond, hn::Eq(growth, zero));
  auto start = hn::IfThenElse(enters, hn::Max(segment.start, at), segment.start);
  start = hn::IfThenElse(never, hn::Set(d, kInfinity), start);
  const auto end = hn::IfThenElse(leaves, hn::Min(segment.end, at), segment.end);
  return {start, end, segment.start_on_cap, segment.end_on_cap};
}

/// `center`: relative to the rays' pivot.
template <class D>
HWY_INLINE Segment<D> segment(D d, const CanonicalPrimitive& primitive, const Vec3& center,
                              const Rays<D>& rays) {
  const Mat3& map = primitive.world_to_canonical;
  Lanes3<D> o = transformed(d, map, rays.origin - broadcast(d, center));
  const Lanes3<D> direction = transformed(d, map, rays.direction);
  // Re-based at the ray's point nearest to the canonical origin.
  const auto inverse_length2 = hn::Div(hn::Set(d, 1.0), dot(d, direction, direction));
  const auto base = hn::Neg(hn::Mul(dot(d, o, direction), inverse_length2));
  o = o + scaled(direction, base);
  Segment<D> segment =
      primitive.enclosure == Shape::kSphere
          ? segment_about(d, hn::Zero(d), hn::Sub(hn::Set(d, 1.0), dot(d, o, o)), inverse_length2)
          : frustum_rays::canonical_segment(d, primitive, o, direction);
  auto live = hn::Lt(segment.start, segment.end);
  const std::vector<Polyhedron::Entry>& entries = primitive.polyhedron->entries();
  for (size_t i = 0; i < entries.size() && !hn::AllFalse(d, live); ++i) {
    const Polyhedron::Entry& entry = entries[i];
    const Lanes3<D> normal = broadcast(d, entry.normal);
    const auto height = dot(d, normal, o);
    const auto growth = dot(d, normal, direction);
    // What holds at both ends holds between them.
    const auto at_start = hn::Add(height, hn::Mul(segment.start, growth));
    const auto at_end = hn::Add(height, hn::Mul(segment.end, growth));
    const auto beyond = hn::And(live, hn::Gt(hn::Max(at_start, at_end), hn::Set(d, entry.limit)));
    if (hn::AllFalse(d, beyond)) {
      i += entry.skip;
    } else if (entry.skip == 0) {
      segment = cut(d, segment, height, growth, beyond);
      live = hn::Lt(segment.start, segment.end);
    }
  }
  const auto start = hn::Add(base, segment.start);
  const auto end = hn::Add(base, segment.end);
  return segment_if(d, hn::Lt(start, end), start, end, no_lanes(d), hn::Not(no_lanes(d)));
}

/// The factor by which the enclosing quadric grows until the point lies on it.
template <class D>
HWY_INLINE hn::Vec<D> gauge(D d, const CanonicalPrimitive& primitive, const Lanes3<D>& p) {
  if (primitive.enclosure == Shape::kSphere) return hn::Sqrt(dot(d, p, p));
  const auto lateral = hn::Sqrt(hn::Add(hn::Mul(p.x, p.x), hn::Mul(p.y, p.y)));
  const auto wall = hn::Sub(lateral, hn::Mul(hn::Set(d, primitive.radius_slope), p.z));
  return hn::Max(hn::Abs(p.z), hn::Mul(wall, hn::Set(d, 1 / primitive.radius_mid)));
}

/// Outward and unit, at the point that lies at τ = t: as Polyhedron::face_towards, but that on an
/// edge a ray enters by a face towards it, and leaves by one away from it.
template <class D>
HWY_INLINE Lanes3<D> normal(D d, const CanonicalPrimitive& primitive, const Vec3& center,
                            const Rays<D>& rays, hn::Vec<D> t, hn::Mask<D> leaves) {
  const Mat3& map = primitive.world_to_canonical;
  const Lanes3<D> offset = rays.origin - broadcast(d, center) + scaled(rays.direction, t);
  Lanes3<D> point = transformed(d, map, offset);
  point = scaled(point, hn::Div(hn::Set(d, 1.0), gauge(d, primitive, point)));
  const Lanes3<D> direction = transformed(d, map, rays.direction);
  const auto zero = hn::Zero(d);
  auto furthest = hn::Set(d, -kInfinity);
  Lanes3<D> result = broadcast(d, Vec3(0, 0, 1));
  const std::vector<Polyhedron::Entry>& entries = primitive.polyhedron->entries();
  for (size_t i = 0; i < entries.size(); ++i) {
    const Polyhedron::Entry& entry = entries[i];
    const Lanes3<D> normal = broadcast(d, entry.normal);
    const auto reach = dot(d, normal, point);
    if (entry.skip > 0) {
      if (hn::AllFalse(d, hn::Gt(reach, hn::Set(d, entry.limit)))) i += entry.skip;
    } else {
      const auto growth = dot(d, normal, direction);
      const auto faces =
          hn::Or(hn::And(leaves, hn::Gt(growth, zero)), hn::AndNot(leaves, hn::Lt(growth, zero)));
      const auto is_further = hn::And(faces, hn::Gt(reach, furthest));
      furthest = hn::IfThenElse(is_further, reach, furthest);
      result = if_then_else(is_further, normal, result);
    }
  }
  return normalized(d, transformed_back(d, map, result));
}

}  // namespace polyhedron_rays
}  // namespace HWY_NAMESPACE
}  // namespace csgcore
HWY_AFTER_NAMESPACE();

#endif  // include guard
