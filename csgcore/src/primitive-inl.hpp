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

template <int kCount>
HWY_INLINE void intersect_chunks(const FrameRays& frame, const RayPacket& packet,
                                 const CanonicalPrimitive& primitive, PacketSegments& segments) {
  const Wide d;
  segments.start_on_cap = segments.end_on_cap = 0;
  for (int c = 0; c < kCount; ++c) {
    const size_t first = first_lane(c);
    const auto segment = segment_of(d, primitive, frame.pivot, load_rays(d, packet, first));
    hn::Store(segment.start, d, segments.start + first);
    hn::Store(segment.end, d, segments.end + first);
    segments.start_on_cap |= bits_of(segment.start_on_cap, c);
    segments.end_on_cap |= bits_of(segment.end_on_cap, c);
  }
}

/// All lanes' segments.
HWY_NOINLINE void intersect_packet(const FrameRays& frame, const RayPacket& packet,
                                   const CanonicalPrimitive& primitive, PacketSegments& segments) {
  intersect_chunks<kChunks>(frame, packet, primitive, segments);
}

}  // namespace HWY_NAMESPACE
}  // namespace csgcore
HWY_AFTER_NAMESPACE();

#endif  // include guard
