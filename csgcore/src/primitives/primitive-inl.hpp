// The rays of a convex primitive of any kind. Included once per instruction set.
//
// A kind called Name has a struct NameRays with
//   kHasCaps: whether the normal at an end depends on more than its position: a frustum's end lies
//     on the wall or on a cap;
//   segment(d, primitive, center, rays): the rays' segments within the primitive, and which of
//     their ends lie on a cap;
//   normal(d, primitive, center, rays, t, on_cap): the primitive's outward unit normal at t, where
//     the ray crosses its surface.
// `center` is the primitive's centre relative to the rays' pivot.
#if defined(CSGCORE_PRIMITIVE_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef CSGCORE_PRIMITIVE_INL_HPP
#undef CSGCORE_PRIMITIVE_INL_HPP
#else
#define CSGCORE_PRIMITIVE_INL_HPP
#endif

#include <hwy/cache_control.h>

#include "primitives/crossings.hpp"
#include "primitives/frustum-inl.hpp"
#include "primitives/polyhedron-inl.hpp"
#include "primitives/sphere-inl.hpp"
#include "rays/frame_rays.hpp"

HWY_BEFORE_NAMESPACE();
namespace csgcore {
namespace HWY_NAMESPACE {

/// Calls visit(NameRays()) for the kind of a convex primitive, so that loops inside `visit` need
/// not look it up.
template <class Visit>
HWY_INLINE void with_rays_of_kind(const CanonicalPrimitive& primitive, Visit&& visit) {
  switch (primitive.shape) {
#define CSGCORE_CASE(Name) \
  case Shape::k##Name:     \
    return visit(Name##Rays());
    CSGCORE_FOR_EACH_CONVEX_SHAPE(CSGCORE_CASE)
#undef CSGCORE_CASE
#define CSGCORE_CASE(Name) case Shape::k##Name:
    CSGCORE_FOR_EACH_OTHER_SHAPE(CSGCORE_CASE)
#undef CSGCORE_CASE
    break;
  }
}

/// Returns the primitive's own outward unit normal at t, which lies on its surface.
template <class D>
HWY_INLINE Lanes3<D> normal_of(D d, const CanonicalPrimitive& primitive, const Vec3& pivot,
                               const Rays<D>& rays, hn::Vec<D> t, hn::Mask<D> on_cap) {
  Lanes3<D> normal;
  with_rays_of_kind(primitive, [&](auto kind) {
    normal = kind.normal(d, primitive, primitive.center - pivot, rays, t, on_cap);
  });
  return normal;
}

/// Prefetches the parts of the primitive that intersect_lanes() reads.
HWY_INLINE void prefetch_rays_part(const CanonicalPrimitive& primitive) {
  hwy::Prefetch(&primitive);
  hwy::Prefetch(&primitive.world_to_canonical[1]);
}

/// Finds the segments of all chunks that hold any of the lanes, and leaves those of other chunks as
/// they are.
HWY_NOINLINE static HWY_MAYBE_UNUSED void intersect_lanes(const FrameRays& frame,
                                                          const RayPacket& packet, LaneMask lanes,
                                                          const CanonicalPrimitive& primitive,
                                                          PacketSegments& segments) {
  const Wide d;
  const Vec3 center = primitive.center - frame.pivot;
  LaneMask start_on_cap = 0;
  LaneMask end_on_cap = 0;
  LaneMask done = 0;
  with_rays_of_kind(primitive, [&](auto kind) {
    for (const int c : ChunksOf(lanes)) {
      const size_t first = first_lane(c);
      const auto segment = kind.segment(d, primitive, center, load_rays(d, packet, first));
      hn::Store(segment.start, d, segments.start + first);
      hn::Store(segment.end, d, segments.end + first);
      done |= chunk_lanes(c);
      if constexpr (!kind.kHasCaps) continue;
      start_on_cap |= bits_of(segment.start_on_cap, c);
      end_on_cap |= bits_of(segment.end_on_cap, c);
    }
  });
  segments.start_on_cap = (segments.start_on_cap & ~done) | start_on_cap;
  segments.end_on_cap = (segments.end_on_cap & ~done) | end_on_cap;
}

/// Finds the normals of all chunks that hold any of the lanes.
HWY_NOINLINE static HWY_MAYBE_UNUSED void find_normals(const FrameRays& frame,
                                                       const RayPacket& packet, LaneMask lanes,
                                                       const CanonicalPrimitive& primitive,
                                                       const PacketV& t, LaneMask on_cap,
                                                       Lanes3<Wide> (&normals)[kChunks]) {
  const Wide d;
  const Vec3 center = primitive.center - frame.pivot;
  with_rays_of_kind(primitive, [&](auto kind) {
    for (const int c : ChunksOf(lanes)) {
      normals[c] = kind.normal(d, primitive, center, load_rays(d, packet, first_lane(c)),
                               t.chunk[c], mask_of(on_cap, c));
    }
  });
}

}  // namespace HWY_NAMESPACE
}  // namespace csgcore
HWY_AFTER_NAMESPACE();

#endif  // include guard
