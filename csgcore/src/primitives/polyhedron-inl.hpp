// The convex polyhedron on rays: its segment, and its normal. Included once per instruction set.
#if defined(CSGCORE_POLYHEDRON_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef CSGCORE_POLYHEDRON_INL_HPP
#undef CSGCORE_POLYHEDRON_INL_HPP
#else
#define CSGCORE_POLYHEDRON_INL_HPP
#endif

#include "csgcore/polyhedron.hpp"
#include "primitives/frustum-inl.hpp"
#include "primitives/sphere-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace csgcore {
namespace HWY_NAMESPACE {
namespace polyhedron_rays {

/// What of rays lies within the faces that were looked at, in canonical space, and the faces that
/// cut it there.
template <class D>
struct FacedSegment {
  hn::Vec<D> start, end;
  Lanes3<D> start_normal, end_normal;
};

/// Cuts by a face's half-space, height + t·growth ≤ 1, in the lanes where an end lies beyond it.
template <bool kWithNormals, class D>
HWY_INLINE void cut(D d, const Vec3& face_normal, hn::Vec<D> height, hn::Vec<D> growth,
                    hn::Mask<D> beyond, FacedSegment<D>& segment) {
  const auto zero = hn::Zero(d);
  const auto at = hn::Div(hn::Sub(hn::Set(d, 1.0), height), growth);
  // A ray along the face is beyond it for ever.
  const auto never = hn::And(beyond, hn::Eq(growth, zero));
  segment.start = hn::IfThenElse(never, hn::Set(d, kInfinity), segment.start);
  const auto later = hn::And(hn::Lt(growth, zero), hn::Gt(at, segment.start));
  const auto enters = hn::And(beyond, later);
  segment.start = hn::IfThenElse(enters, at, segment.start);
  if constexpr (kWithNormals) {
    segment.start_normal = if_then_else(enters, broadcast(d, face_normal), segment.start_normal);
  }
  const auto sooner = hn::And(hn::Gt(growth, zero), hn::Lt(at, segment.end));
  const auto leaves = hn::And(beyond, sooner);
  segment.end = hn::IfThenElse(leaves, at, segment.end);
  if constexpr (kWithNormals) {
    segment.end_normal = if_then_else(leaves, broadcast(d, face_normal), segment.end_normal);
  }
}

/// `center`: relative to the rays' pivot. Normals are found if asked for.
template <bool kWithNormals, class D>
HWY_NOINLINE FacedSegment<D> faced_segment(D d, const CanonicalPrimitive& primitive,
                                           const Vec3& center, const Rays<D>& rays) {
  const Mat3& map = primitive.world_to_canonical;
  Lanes3<D> o = transformed(d, map, rays.origin - broadcast(d, center));
  const Lanes3<D> direction = transformed(d, map, rays.direction);
  // Re-based at the ray's point nearest to the canonical origin.
  const auto inverse_length2 = hn::Div(hn::Set(d, 1.0), dot(d, direction, direction));
  const auto base = hn::Neg(hn::Mul(dot(d, o, direction), inverse_length2));
  o = o + scaled(direction, base);
  const Segment<D> enclosed =
      primitive.enclosure == Shape::kSphere
          ? segment_about(d, hn::Zero(d), hn::Sub(hn::Set(d, 1.0), dot(d, o, o)), inverse_length2)
          : frustum_rays::canonical_segment(d, primitive, o, direction);
  // What encloses the solid lies beyond it: some face cuts each end.
  const Lanes3<D> none = broadcast(d, Vec3(0, 0, 1));
  FacedSegment<D> segment{enclosed.start, enclosed.end, none, none};
  auto live = hn::Lt(segment.start, segment.end);
  const hn::Vec<D> origin_along[] = {o.x, o.y, o.z};
  const hn::Vec<D> direction_along[] = {direction.x, direction.y, direction.z};
  const std::vector<Polyhedron::Entry>& entries = primitive.polyhedron->entries();
  for (size_t i = 0; i < entries.size() && !hn::AllFalse(d, live); ++i) {
    const Polyhedron::Entry& entry = entries[i];
    hn::Vec<D> height, growth;
    if (entry.axis < Polyhedron::Entry::kNoAxis) {
      // The dot products' other terms are zeros.
      const auto along = hn::Set(d, entry.normal[static_cast<int>(entry.axis)]);
      height = hn::Mul(along, origin_along[entry.axis]);
      growth = hn::Mul(along, direction_along[entry.axis]);
    } else {
      const Lanes3<D> normal = broadcast(d, entry.normal);
      height = dot(d, normal, o);
      growth = dot(d, normal, direction);
    }
    // What holds at both ends holds between them.
    const auto at_start = hn::Add(height, hn::Mul(segment.start, growth));
    const auto at_end = hn::Add(height, hn::Mul(segment.end, growth));
    const auto beyond = hn::And(live, hn::Gt(hn::Max(at_start, at_end), hn::Set(d, entry.limit)));
    if (hn::AllFalse(d, beyond)) {
      i += entry.skip;
    } else if (entry.skip == 0) {
      cut<kWithNormals>(d, entry.normal, height, growth, beyond, segment);
      live = hn::Lt(segment.start, segment.end);
    }
  }
  segment.start = hn::Add(base, segment.start);
  segment.end = hn::Add(base, segment.end);
  return segment;
}

template <class D>
HWY_INLINE Segment<D> segment(D d, const CanonicalPrimitive& primitive, const Vec3& center,
                              const Rays<D>& rays) {
  const FacedSegment<D> faced = faced_segment<false>(d, primitive, center, rays);
  return segment_if(d, hn::Lt(faced.start, faced.end), faced.start, faced.end, no_lanes(d),
                    hn::Not(no_lanes(d)));
}

/// Outward and unit, where the ray enters or leaves: of the face that cuts it there.
template <class D>
HWY_INLINE Lanes3<D> normal(D d, const CanonicalPrimitive& primitive, const Vec3& center,
                            const Rays<D>& rays, hn::Mask<D> leaves) {
  const FacedSegment<D> faced = faced_segment<true>(d, primitive, center, rays);
  return normalized(d,
                    transformed_back(d, primitive.world_to_canonical,
                                     if_then_else(leaves, faced.end_normal, faced.start_normal)));
}

}  // namespace polyhedron_rays
}  // namespace HWY_NAMESPACE
}  // namespace csgcore
HWY_AFTER_NAMESPACE();

#endif  // include guard
