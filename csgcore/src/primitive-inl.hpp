// What a primitive answers about rays, by its shape. Included once per instruction set.
#if defined(CSGCORE_PRIMITIVE_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef CSGCORE_PRIMITIVE_INL_HPP
#undef CSGCORE_PRIMITIVE_INL_HPP
#else
#define CSGCORE_PRIMITIVE_INL_HPP
#endif

#include <hwy/cache_control.h>

#include "frustum-inl.hpp"
#include "polyhedron-inl.hpp"
#include "sphere-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace csgcore {
namespace HWY_NAMESPACE {

template <class D>
HWY_INLINE Segment<D> segment_of(D d, const CanonicalPrimitive& primitive, const Vec3& pivot,
                                 const Rays<D>& rays) {
  const Vec3 center = primitive.center - pivot;
  switch (primitive.shape) {
    case Shape::kSphere:
      return sphere_rays::segment(d, primitive, center, rays);
    case Shape::kFrustum:
      return frustum_rays::segment(d, primitive, center, rays);
    case Shape::kPolyhedron:
      break;
  }
  return polyhedron_rays::segment(d, primitive, center, rays);
}

/// The primitive's own outward unit normal at τ = t, which lies on its surface.
template <class D>
HWY_INLINE Lanes3<D> normal_of(D d, const CanonicalPrimitive& primitive, const Vec3& pivot,
                               const Rays<D>& rays, hn::Vec<D> t, hn::Mask<D> on_cap) {
  const Vec3 center = primitive.center - pivot;
  switch (primitive.shape) {
    case Shape::kSphere:
      return sphere_rays::normal(d, primitive, center, rays, t);
    case Shape::kFrustum:
      return frustum_rays::normal(d, primitive, center, rays, t, on_cap);
    case Shape::kPolyhedron:
      break;
  }
  return polyhedron_rays::normal(d, primitive, center, rays, on_cap);
}

/// Fetches what `segment_of` reads.
HWY_INLINE void prefetch_rays_part(const CanonicalPrimitive& primitive) {
  hwy::Prefetch(&primitive);
  hwy::Prefetch(&primitive.world_to_canonical[1]);
}

/// The segments of all chunks that hold any of the lanes; those of the others stay.
HWY_NOINLINE void intersect_lanes(const FrameRays& frame, const RayPacket& packet, LaneMask lanes,
                                  const CanonicalPrimitive& primitive, PacketSegments& segments) {
  const Wide d;
  LaneMask start_on_cap = 0;
  LaneMask end_on_cap = 0;
  LaneMask done = 0;
  for (const int c : ChunksOf(lanes)) {
    const size_t first = first_lane(c);
    const auto segment = segment_of(d, primitive, frame.pivot, load_rays(d, packet, first));
    hn::Store(segment.start, d, segments.start + first);
    hn::Store(segment.end, d, segments.end + first);
    start_on_cap |= bits_of(segment.start_on_cap, c);
    end_on_cap |= bits_of(segment.end_on_cap, c);
    done |= chunk_lanes(c);
  }
  segments.start_on_cap = (segments.start_on_cap & ~done) | start_on_cap;
  segments.end_on_cap = (segments.end_on_cap & ~done) | end_on_cap;
}

}  // namespace HWY_NAMESPACE
}  // namespace csgcore
HWY_AFTER_NAMESPACE();

#endif  // include guard
