// The segments and normals of convex polyhedra on rays. Included once per instruction set.
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

/// The parts of rays that lie within the faces tested so far, and the canonical normals of the
/// faces that cut their ends.
template <class D>
struct FacedSegment {
  hn::Vec<D> start, end;
  Lanes3<D> start_normal, end_normal;
};

/// Cuts the segments by a face's half-space, height + t·growth ≤ 1, in the lanes in which an end
/// lies beyond it.
template <bool kWithNormals, class D>
HWY_INLINE void cut(D d, const Vec3& face_normal, hn::Vec<D> height, hn::Vec<D> growth,
                    hn::Mask<D> beyond, FacedSegment<D>& segment) {
  const auto zero = hn::Zero(d);
  const auto at = hn::Div(hn::Sub(hn::Set(d, 1.0), height), growth);
  // A ray parallel to the face is beyond it everywhere.
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

/// Rays in canonical space, o + (t − base)·direction: each is re-based at its point nearest to the
/// canonical origin.
template <class D>
struct RebasedRays {
  Lanes3<D> o, direction;
  hn::Vec<D> inverse_length2, base;
};

/// `center` is relative to the rays' pivot.
template <class D>
HWY_INLINE RebasedRays<D> rebased(D d, const CanonicalPrimitive& primitive, const Vec3& center,
                                  const Rays<D>& rays) {
  const Mat3& map = primitive.world_to_canonical;
  const Lanes3<D> o = transformed(d, map, rays.origin - broadcast(d, center));
  const Lanes3<D> direction = transformed(d, map, rays.direction);
  const auto inverse_length2 = hn::Div(hn::Set(d, 1.0), dot(d, direction, direction));
  const auto base = hn::Neg(hn::Mul(dot(d, o, direction), inverse_length2));
  return {o + scaled(direction, base), direction, inverse_length2, base};
}

/// Returns the segments of rays within the solid, with the normals if asked for.
template <bool kWithNormals, class D>
HWY_NOINLINE FacedSegment<D> faced_segment(D d, const CanonicalPrimitive& primitive,
                                           const Vec3& center, const Rays<D>& rays) {
  const auto [o, direction, inverse_length2, base] = rebased(d, primitive, center, rays);
  const Segment<D> enclosed =
      primitive.enclosure == Shape::kSphere
          ? segment_about(d, hn::Zero(d), hn::Sub(hn::Set(d, 1.0), dot(d, o, o)), inverse_length2)
          : frustum_rays::canonical_segment(d, primitive, o, direction);
  // The enclosure is larger than the solid, so that some face cuts each end.
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
      // The other terms of the dot products are zero.
      const auto along = hn::Set(d, entry.normal[static_cast<int>(entry.axis)]);
      height = hn::Mul(along, origin_along[entry.axis]);
      growth = hn::Mul(along, direction_along[entry.axis]);
    } else {
      const Lanes3<D> normal = broadcast(d, entry.normal);
      height = dot(d, normal, o);
      growth = dot(d, normal, direction);
    }
    // If both ends lie in the half-space, so does all between them.
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

/// Returns the segments of rays within a box, by slabs (Kay and Kajiya, "Ray Tracing Complex
/// Scenes", 1986). The ends are the same as faced_segment's, since each is one division of the same
/// numbers.
template <class D>
HWY_NOINLINE Segment<D> box_segment(D d, const CanonicalPrimitive& primitive,
                                    const Polyhedron::Slabs& slabs, const Vec3& center,
                                    const Rays<D>& rays) {
  const auto [o, direction, inverse_length2, base] = rebased(d, primitive, center, rays);
  const hn::Vec<D> origin_along[] = {o.x, o.y, o.z};
  const hn::Vec<D> direction_along[] = {direction.x, direction.y, direction.z};
  const auto one = hn::Set(d, 1.0);
  const auto never = hn::Set(d, kInfinity);
  auto start = hn::Neg(never);
  auto end = never;
  for (int i = 0; i < 3; ++i) {
    const auto below = hn::Set(d, slabs.below[i]);
    const auto above = hn::Set(d, slabs.above[i]);
    const auto room_below = hn::Sub(one, hn::Mul(below, origin_along[i]));
    const auto room_above = hn::Sub(one, hn::Mul(above, origin_along[i]));
    const auto at_below = hn::Div(room_below, hn::Mul(below, direction_along[i]));
    const auto at_above = hn::Div(room_above, hn::Mul(above, direction_along[i]));
    auto enters = hn::Min(at_below, at_above);
    auto leaves = hn::Max(at_below, at_above);
    const auto along_faces = hn::Eq(direction_along[i], hn::Zero(d));
    if (!hn::AllFalse(d, along_faces)) {
      const auto is_beyond = hn::Lt(hn::Min(room_below, room_above), hn::Zero(d));
      enters =
          hn::IfThenElse(along_faces, hn::IfThenElse(is_beyond, never, hn::Neg(never)), enters);
      leaves = hn::IfThenElse(along_faces, never, leaves);
    }
    start = hn::Max(start, enters);
    end = hn::Min(end, leaves);
    if (hn::AllFalse(d, hn::Lt(start, end))) break;
  }
  start = hn::Add(base, start);
  end = hn::Add(base, end);
  return segment_if(d, hn::Lt(start, end), start, end, no_lanes(d), hn::Not(no_lanes(d)));
}

/// Returns the segments within a box with the normals of the faces that rays cross. Of faces that a
/// ray crosses at the same point, the first counts.
template <class D>
HWY_NOINLINE FacedSegment<D> box_faces(D d, const CanonicalPrimitive& primitive, const Vec3& center,
                                       const Rays<D>& rays) {
  const auto [o, direction, inverse_length2, base] = rebased(d, primitive, center, rays);
  const hn::Vec<D> origin_along[] = {o.x, o.y, o.z};
  const hn::Vec<D> direction_along[] = {direction.x, direction.y, direction.z};
  const auto endless = hn::Set(d, kInfinity);
  const Lanes3<D> none = broadcast(d, Vec3(0, 0, 1));
  FacedSegment<D> segment{hn::Neg(endless), endless, none, none};
  for (const Polyhedron::Entry& entry : primitive.polyhedron->entries()) {
    if (entry.skip > 0) continue;
    const auto along = hn::Set(d, entry.normal[static_cast<int>(entry.axis)]);
    const auto growth = hn::Mul(along, direction_along[entry.axis]);
    cut<true>(d, entry.normal, hn::Mul(along, origin_along[entry.axis]), growth,
              hn::Ne(growth, hn::Zero(d)), segment);
  }
  return segment;
}

}  // namespace polyhedron_rays

/// See primitive-inl.hpp. An end is "on a cap" if the ray leaves there: the normal is that of the
/// face that cuts this end.
struct PolyhedronRays {
  static constexpr bool kHasCaps = true;

  template <class D>
  static HWY_INLINE Segment<D> segment(D d, const CanonicalPrimitive& primitive, const Vec3& center,
                                       const Rays<D>& rays) {
    if (const auto& slabs = primitive.polyhedron->slabs()) {
      return polyhedron_rays::box_segment(d, primitive, *slabs, center, rays);
    }
    const polyhedron_rays::FacedSegment<D> faced =
        polyhedron_rays::faced_segment<false>(d, primitive, center, rays);
    return segment_if(d, hn::Lt(faced.start, faced.end), faced.start, faced.end, no_lanes(d),
                      hn::Not(no_lanes(d)));
  }

  template <class D>
  static HWY_INLINE Lanes3<D> normal(D d, const CanonicalPrimitive& primitive, const Vec3& center,
                                     const Rays<D>& rays, hn::Vec<D> /*t*/, hn::Mask<D> leaves) {
    const polyhedron_rays::FacedSegment<D> faced =
        primitive.polyhedron->slabs()
            ? polyhedron_rays::box_faces(d, primitive, center, rays)
            : polyhedron_rays::faced_segment<true>(d, primitive, center, rays);
    return normalized(d,
                      transformed_back(d, primitive.world_to_canonical,
                                       if_then_else(leaves, faced.end_normal, faced.start_normal)));
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace csgcore
HWY_AFTER_NAMESPACE();

#endif  // include guard
