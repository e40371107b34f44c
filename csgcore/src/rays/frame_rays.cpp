// Compiled once per instruction set by Highway. Multiplications and additions are never fused:
// every instruction set gives the same bits.
#include "rays/frame_rays.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "base/simd.hpp"

#define HWY_DISABLED_TARGETS CSGCORE_DISABLED_TARGETS
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "rays/frame_rays.cpp"
#include <hwy/foreach_target.h>  // includes this file again for every instruction set
#include <hwy/highway.h>

#include "rays/lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace csgcore {
namespace HWY_NAMESPACE {

/// a + b as an unevaluated sum of two parts, without rounding (Knuth's TwoSum).
struct ExactSum {
  WideV sum, lost;
};
HWY_INLINE ExactSum exact_sum(WideV a, WideV b) {
  const WideV sum = hn::Add(a, b);
  const WideV part = hn::Sub(sum, a);
  return {sum, hn::Add(hn::Sub(a, hn::Sub(sum, part)), hn::Sub(b, part))};
}

/// Returns offset + base_s·direction. The large terms, which cancel, are not rounded: the product
/// is exact in two parts (Dekker 1971).
HWY_INLINE WideV rebased(const ExactSum& offset, WideV base_s, WideV direction) {
  const Wide d;
  const WideV split = hn::Mul(direction, hn::Set(d, 0x1p27 + 1.0));
  const WideV high = hn::Sub(split, hn::Sub(split, direction));
  const WideV low = hn::Sub(direction, high);
  return hn::Add(hn::Add(offset.sum, hn::Mul(base_s, high)),
                 hn::Add(hn::Mul(base_s, low), offset.lost));
}

/// Does what pixel_ray does, by the same operations, for the first kCount chunks of lanes.
template <int kCount>
HWY_INLINE void write_rays(const FrameRays& frame, const PacketV& u, const PacketV& v,
                           RayPacket& rays) {
  const Wide d;
  const View& view = frame.view;
  const bool is_perspective = view.projection == Projection::kPerspective;
  const WideV base_s = hn::Set(d, frame.base_s);
  PacketV length2;
  for (int c = 0; c < kCount; ++c) length2.chunk[c] = hn::Zero(d);
  for (int axis = 0; axis < 3; ++axis) {
    const WideV right = hn::Set(d, view.right[axis]);
    const WideV up = hn::Set(d, view.up[axis]);
    const WideV forward = hn::Set(d, view.forward[axis]);
    const WideV eye = hn::Set(d, view.eye[axis]);
    const WideV minus_pivot = hn::Set(d, -frame.pivot[axis]);
    const ExactSum from_eye = exact_sum(eye, minus_pivot);
    for (int c = 0; c < kCount; ++c) {
      const WideV lateral = hn::Add(hn::Mul(u.chunk[c], right), hn::Mul(v.chunk[c], up));
      const WideV direction = is_perspective ? hn::Add(forward, lateral) : forward;
      const ExactSum offset =
          is_perspective ? from_eye : exact_sum(hn::Add(eye, lateral), minus_pivot);
      hn::Store(rebased(offset, base_s, direction), d, rays.origin[axis] + first_lane(c));
      hn::Store(direction, d, rays.direction[axis] + first_lane(c));
      length2.chunk[c] = hn::Add(length2.chunk[c], hn::Mul(direction, direction));
    }
  }
  for (int c = 0; c < kCount; ++c) {
    hn::Store(hn::Div(hn::Set(d, 1.0), length2.chunk[c]), d, rays.inverse_length2 + first_lane(c));
  }
}

template <int kCount>
HWY_INLINE void write_rays_through(const FrameRays& frame, const PacketLaterals& laterals,
                                   RayPacket& rays) {
  PacketV u, v;
  for (int c = 0; c < kCount; ++c) {
    u.chunk[c] = hn::Load(Wide(), laterals.u + first_lane(c));
    v.chunk[c] = hn::Load(Wide(), laterals.v + first_lane(c));
  }
  write_rays<kCount>(frame, u, v, rays);
}

void make_rays(const FrameRays& frame, const PacketLaterals& laterals, RayPacket& rays) {
  write_rays_through<kChunks>(frame, laterals, rays);
}

void make_four_rays(const FrameRays& frame, const PacketLaterals& laterals, RayPacket& rays) {
  write_rays_through<kFourChunks>(frame, laterals, rays);
}

void make_block_rays(const FrameRays& frame, uint32_t x, uint32_t y, RayPacket& rays) {
  const Wide d;
  static_assert(kLanes <= kPacketWidth_px);
  PacketV u, v;
  for (int c = 0; c < kChunks; ++c) {
    const size_t column = first_lane(c) % kPacketWidth_px;
    const size_t row = first_lane(c) / kPacketWidth_px;
    u.chunk[c] = hn::LoadU(d, frame.centers->u_of_column.data() + x + column);
    v.chunk[c] = hn::Set(d, frame.centers->v_of_row[y + row]);
  }
  write_rays<kChunks>(frame, u, v, rays);
}

}  // namespace HWY_NAMESPACE
}  // namespace csgcore
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace csgcore {
namespace {

/// The product of a number of 26 bits with either half of a double's 53 bits is exact.
double rounded_to_26_bits(double x) {
  if (x == 0 || !std::isfinite(x)) return 0;
  const int exponent = std::ilogb(x);
  return std::ldexp(std::round(std::ldexp(x, 25 - exponent)), exponent - 25);
}

}  // namespace

FrameRays rebased(const FrameRays& other, const Box& solid_bounds) {
  FrameRays frame = other;
  const View& view = frame.view;
  const Vec3 middle = solid_bounds.empty() ? view.eye : solid_bounds.center();
  frame.base_s = rounded_to_26_bits(glm::dot(middle - view.eye, view.forward));
  frame.pivot = view.eye + frame.base_s * view.forward;
  frame.first_t = view.projection == Projection::kPerspective
                      ? thickness_tolerance(solid_bounds) - frame.base_s
                      : -std::numeric_limits<double>::max();
  return frame;
}

FrameRays frame_rays(const View& view, const Box& solid_bounds) {
  FrameRays frame;
  frame.view = view;
  const auto centers = std::make_shared<FrameRays::Centers>();
  for (uint32_t x = 0; x < view.width_px + FrameRays::kBeyond_px; ++x) {
    centers->u_of_column.push_back(frame.u(x));
  }
  for (uint32_t y = 0; y < view.height_px + FrameRays::kBeyond_px; ++y) {
    centers->v_of_row.push_back(frame.v(y));
  }
  frame.centers = centers;
  return rebased(frame, solid_bounds);
}

CSGCORE_SIMD_EXPORT(make_rays);
CSGCORE_SIMD_EXPORT(make_four_rays);
CSGCORE_SIMD_EXPORT(make_block_rays);

void make_rays(const FrameRays& frame, const PacketLaterals& laterals, RayPacket& rays) {
  CSGCORE_SIMD(make_rays)(frame, laterals, rays);
}

void make_four_rays(const FrameRays& frame, const PacketLaterals& laterals, RayPacket& rays) {
  CSGCORE_SIMD(make_four_rays)(frame, laterals, rays);
}

void make_block_rays(const FrameRays& frame, uint32_t x, uint32_t y, RayPacket& rays) {
  CSGCORE_SIMD(make_block_rays)(frame, x, y, rays);
}

}  // namespace csgcore
#endif  // HWY_ONCE
