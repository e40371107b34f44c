// What a primitive answers about rays, by its shape. Included once per instruction set.
#if defined(CSGCORE_PRIMITIVE_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef CSGCORE_PRIMITIVE_INL_HPP
#undef CSGCORE_PRIMITIVE_INL_HPP
#else
#define CSGCORE_PRIMITIVE_INL_HPP
#endif

#include "frustum-inl.hpp"
#include "sphere-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace csgcore {
namespace HWY_NAMESPACE {

template <class D>
HWY_INLINE Segment<D> segment_of(D d, const CanonicalPrimitive& primitive, const Vec3& pivot,
                                 const Rays<D>& rays) {
  const Vec3 center = primitive.center - pivot;
  return primitive.shape == Shape::kSphere ? sphere_rays::segment(d, primitive, center, rays)
                                           : frustum_rays::segment(d, primitive, center, rays);
}

/// The primitive's own outward unit normal where its segment starts or, in lanes of `at_end`, ends.
template <class D>
HWY_INLINE Lanes3<D> normal_of(D d, const CanonicalPrimitive& primitive, const Vec3& pivot,
                               const Rays<D>& rays, hn::Vec<D> t, hn::Mask<D> at_end) {
  const Vec3 center = primitive.center - pivot;
  return primitive.shape == Shape::kSphere
             ? sphere_rays::normal(d, primitive, center, rays, t)
             : frustum_rays::normal(d, primitive, center, rays, t, at_end);
}

/// All lanes' segments.
HWY_INLINE void intersect_packet(const FrameRays& frame, const RayPacket& packet,
                                 const CanonicalPrimitive& primitive, PacketSegments& segments) {
  const Wide d;
  for (size_t first = 0; first < kPacketRays; first += hn::Lanes(d)) {
    const auto segment = segment_of(d, primitive, frame.pivot, load_rays(d, packet, first));
    hn::Store(segment.start, d, segments.start + first);
    hn::Store(segment.end, d, segments.end + first);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace csgcore
HWY_AFTER_NAMESPACE();

#endif  // include guard
