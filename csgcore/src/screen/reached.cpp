// Compiled once per instruction set by Highway.
#include "base/simd.hpp"
#include "screen/screen_slab.hpp"
#include "tree/cell_list.hpp"

#define HWY_DISABLED_TARGETS CSGCORE_DISABLED_TARGETS
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "screen/reached.cpp"
#include <hwy/foreach_target.h>  // includes this file again for every instruction set
#include <hwy/highway.h>

#include "rays/lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace csgcore {
namespace HWY_NAMESPACE {

/// Returns the lanes of a block in the columns and rows whose bits are set.
HWY_INLINE LaneMask lanes_in(uint32_t columns, uint32_t rows) {
  static_assert(kPacketWidth_px == 8 && kPacketHeight_px == 4);
  constexpr uint32_t kFirstOfRow = 0x01010101u;
  constexpr uint32_t kBitToRow = 0x00204081u;  // bit i goes to bit 8·i, among others
  const LaneMask whole_rows = ((rows & 0xFu) * kBitToRow & kFirstOfRow) * 0xFFu;
  return columns * kFirstOfRow & whole_rows;
}

/// Returns the pixels between the slab's lines in two blocks, one below the other, with the top
/// left pixel (x, y).
HWY_INLINE uint64_t pixels_between(const ScreenSlab& slab, float x, float y) {
  static_assert(kPacketWidth_px == 8);
  const hn::CappedTag<float, kPacketWidth_px> d;
  uint64_t beyond = 0;
  for (size_t column = 0; column < kPacketWidth_px; column += hn::Lanes(d)) {
    const auto along = hn::Iota(d, static_cast<float>(column));
    // The distances of the first row's pixels beyond a line.
    const auto first_row = [&](int line) {
      const float first = slab.x[line] * x + slab.y[line] * y - slab.limit[line];
      return hn::Add(hn::Set(d, first), hn::Mul(hn::Set(d, slab.x[line]), along));
    };
    auto past0 = first_row(0);
    auto past1 = first_row(1);
    for (uint32_t row = 0; row < 2 * kPacketHeight_px; ++row) {
      const auto is_beyond = hn::Gt(hn::Max(past0, past1), hn::Zero(d));
      uint8_t bytes[8] = {};
      hn::StoreMaskBits(d, is_beyond, bytes);
      beyond |= uint64_t{bytes[0]} << (kPacketWidth_px * row + column);
      past0 = hn::Add(past0, hn::Set(d, slab.y[0]));
      past1 = hn::Add(past1, hn::Set(d, slab.y[1]));
    }
  }
  return ~beyond;
}

void find_reached(const Extent* screen, const ScreenSlab* slabs,
                  std::span<const uint32_t> primitives, uint32_t x, uint32_t y, LaneMask* above,
                  LaneMask* below) {
  static_assert(kPacketWidth_px == 2 * kPacketHeight_px);
  const hn::CappedTag<double, 2> d;
  const hn::Rebind<int32_t, decltype(d)> integers;
  const hn::Rebind<uint32_t, decltype(d)> bits;
  const double origin[] = {static_cast<double>(x), static_cast<double>(y)};
  for (size_t i = 0; i < primitives.size(); ++i) {
    const Extent& extent = screen[primitives[i] & kPrimitiveBits];
    uint32_t inside[2];  // bits of columns, bits of rows
    for (size_t axis = 0; axis < 2; axis += hn::Lanes(d)) {
      const auto center = hn::Sub(hn::LoadU(d, extent.center + axis), hn::LoadU(d, origin + axis));
      const auto half = hn::LoadU(d, extent.half + axis);
      const auto bit_of = [&](auto pixel) {
        const auto last = hn::Set(d, double{kPacketWidth_px});
        const auto limited = hn::Min(hn::Max(pixel, hn::Zero(d)), last);
        return hn::Shl(hn::Set(bits, 1u), hn::BitCast(bits, hn::DemoteTo(integers, limited)));
      };
      const auto low = bit_of(hn::Sub(center, half));
      const auto end = bit_of(hn::Add(hn::Add(center, half), hn::Set(d, 1.0)));
      hn::StoreU(hn::Sub(end, low), bits, inside + axis);
    }
    above[i] = lanes_in(inside[0], inside[1]);
    below[i] = lanes_in(inside[0], inside[1] >> kPacketHeight_px);
    if (extent.inside2 >= 0 || (above[i] | below[i]) == 0) continue;
    const uint64_t between = pixels_between(slabs[primitives[i] & kPrimitiveBits],
                                            static_cast<float>(x), static_cast<float>(y));
    above[i] &= static_cast<LaneMask>(between);
    below[i] &= static_cast<LaneMask>(between >> kPacketRays);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace csgcore
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace csgcore {

CSGCORE_SIMD_EXPORT(find_reached);

void find_reached(const Extent* screen, const ScreenSlab* slabs,
                  std::span<const uint32_t> primitives, uint32_t x, uint32_t y, LaneMask* above,
                  LaneMask* below) {
  CSGCORE_SIMD(find_reached)(screen, slabs, primitives, x, y, above, below);
}

}  // namespace csgcore
#endif  // HWY_ONCE
