// Compiled once per instruction set by Highway.
#include "base/simd.hpp"
#include "packets/packet.hpp"

#define HWY_DISABLED_TARGETS CSGCORE_DISABLED_TARGETS
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "packets/ranges.cpp"
#include <hwy/foreach_target.h>  // includes this file again for every instruction set
#include <hwy/highway.h>

#include "rays/lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace csgcore {
namespace HWY_NAMESPACE {

void invert_directions(const RayPacket& rays, PacketInverses& inverses) {
  const Wide d;
  for (int axis = 0; axis < 3; ++axis) {
    for (int c = 0; c < kChunks; ++c) {
      const auto direction = hn::Load(d, rays.direction[axis] + first_lane(c));
      const auto none = hn::Eq(direction, hn::Zero(d));
      const auto inverse =
          hn::Div(hn::Set(d, 1.0), hn::IfThenElse(none, hn::Set(d, 1.0), direction));
      hn::Store(hn::IfThenElse(none, hn::Set(d, kInfinity), inverse), d,
                inverses.inverse[axis] + first_lane(c));
    }
  }
}

RangeSplit split_range(const RayPacket& rays, const PacketInverses& inverses, int axis,
                       double plane, PacketRange& range, PacketRange& far) {
  const Wide d;
  RangeSplit result{0, 0};
  for (int c = 0; c < kChunks; ++c) {
    const size_t first = first_lane(c);
    const auto gap = hn::Sub(hn::Set(d, plane), hn::Load(d, rays.origin[axis] + first));
    const auto product = hn::Mul(gap, hn::Load(d, inverses.inverse[axis] + first));
    // A ray within the plane (0·∞ = NaN) counts as beyond.
    const auto t = hn::IfThenElse(hn::Eq(product, product), product, hn::Set(d, -kInfinity));
    const auto enter = hn::Load(d, range.enter + first);
    const auto leave = hn::Load(d, range.leave + first);
    result.before |= bits_of(hn::Le(enter, t), c);
    result.beyond |= bits_of(hn::Le(t, leave), c);
    hn::Store(hn::Max(enter, t), d, far.enter + first);
    hn::Store(leave, d, far.leave + first);
    hn::Store(hn::Min(leave, t), d, range.leave + first);
  }
  far.margin = range.margin;
  return result;
}

}  // namespace HWY_NAMESPACE
}  // namespace csgcore
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace csgcore {

CSGCORE_SIMD_EXPORT(invert_directions);
CSGCORE_SIMD_EXPORT(split_range);

void invert_directions(const RayPacket& rays, PacketInverses& inverses) {
  CSGCORE_SIMD(invert_directions)(rays, inverses);
}

RangeSplit split_range(const RayPacket& rays, const PacketInverses& inverses, int axis,
                       double plane, PacketRange& range, PacketRange& far) {
  return CSGCORE_SIMD(split_range)(rays, inverses, axis, plane, range, far);
}

}  // namespace csgcore
#endif  // HWY_ONCE
