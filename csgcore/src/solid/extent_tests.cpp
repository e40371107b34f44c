// Compiled once per instruction set by Highway. Multiplications and additions are never fused, so
// that every instruction set gives the same answers.
#include "solid/extent_tests.hpp"

#include <algorithm>
#include <array>

#include "base/simd.hpp"

// The instruction sets that are left out would save little and cost compile time. Vectors whose
// length is not known to the compiler cannot be put into arrays.
#define HWY_DISABLED_TARGETS CSGCORE_DISABLED_TARGETS
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "solid/extent_tests.cpp"
#include <hwy/foreach_target.h>  // includes this file again for every instruction set
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace csgcore {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using Doubles = hn::CappedTag<double, kVectorPadding>;
using Signed = hn::Rebind<int64_t, Doubles>;
using Narrow = hn::Rebind<uint32_t, Doubles>;
using Vector = hn::Vec<Doubles>;
using Mask = hn::Mask<Doubles>;

static_assert(sizeof(Extent) == 8 * sizeof(double), "gathered as an array of doubles");
constexpr int kExtentShift = 3;  // log2 of an Extent's doubles

/// Gathers fields of the extents of as many primitives as fit into a vector.
class Gather {
 public:
  HWY_INLINE Gather(const Extent* extents, const uint32_t* primitives)
      : base_(reinterpret_cast<const double*>(extents)) {
    const Narrow narrow;
    const auto index = hn::And(hn::LoadU(narrow, primitives), hn::Set(narrow, kPrimitiveBits));
    const auto wide = hn::PromoteTo(hn::Rebind<uint64_t, Doubles>(), index);
    offsets_ = hn::BitCast(Signed(), hn::ShiftLeft<kExtentShift>(wide));
  }
  HWY_INLINE Vector center(int axis) const {
    return hn::GatherIndex(Doubles(), base_ + axis, offsets_);
  }
  HWY_INLINE Vector half(int axis) const {
    return hn::GatherIndex(Doubles(), base_ + 3 + axis, offsets_);
  }
  HWY_INLINE Vector outside2() const { return hn::GatherIndex(Doubles(), base_ + 6, offsets_); }
  HWY_INLINE Vector inside2() const { return hn::GatherIndex(Doubles(), base_ + 7, offsets_); }

 private:
  const double* base_;
  hn::Vec<Signed> offsets_;
};

/// Converts a mask of at most 16 lanes to bits.
template <typename Tag>
HWY_INLINE uint64_t bits_of(Tag tag, hn::Mask<Tag> mask) {
  std::array<uint8_t, 8> bytes{};
  hn::StoreMaskBits(tag, mask, bytes.data());
  return bytes[0] | uint32_t{bytes[1]} << 8;
}
HWY_INLINE uint64_t bits_of(Mask mask) { return bits_of(Doubles(), mask); }

/// The contribution of the interval [min, max] of one axis to the tests.
struct AxisTest {
  Vector near2, far2;  // squared distances from the centre to the interval's near and far points
  Mask apart;          // the extent's box is disjoint from it
};

HWY_INLINE AxisTest test_axis(Vector center, Vector half, double min, double max) {
  const Doubles d;
  const Vector to_min = hn::Sub(hn::Set(d, min), center);
  const Vector to_max = hn::Sub(center, hn::Set(d, max));
  const Vector gap = hn::Max(to_min, to_max);
  const Vector reach = hn::Min(to_min, to_max);
  const Vector outer = hn::Max(gap, hn::Zero(d));
  return {hn::Mul(outer, outer), hn::Mul(reach, reach), hn::Gt(gap, half)};
}

ExtentAnswers test_extents(const Extent* extents, const uint32_t* primitives, uint32_t count,
                           const Halves& halves) {
  const Doubles d;
  const uint32_t lanes = static_cast<uint32_t>(hn::Lanes(d));
  const int split = static_cast<int>(halves.axis);
  const int first = split == 0 ? 1 : 0;
  const int second = split == 2 ? 1 : 2;
  ExtentAnswers answers{};
  for (uint32_t i = 0; i < count; i += lanes) {
    const Gather gather(extents, primitives + i);
    const AxisTest a = test_axis(gather.center(first), gather.half(first), halves.below.min[first],
                                 halves.below.max[first]);
    const AxisTest b = test_axis(gather.center(second), gather.half(second),
                                 halves.below.min[second], halves.below.max[second]);
    const Vector near2 = hn::Add(a.near2, b.near2);
    const Vector far2 = hn::Add(a.far2, b.far2);
    const Mask apart = hn::Or(a.apart, b.apart);
    const Vector center = gather.center(split);
    const Vector half = gather.half(split);
    const Vector outside2 = gather.outside2();
    const Vector inside2 = gather.inside2();
    answers.open |= bits_of(hn::Lt(inside2, hn::Zero(d))) << i;
    for (int side = 0; side < 2; ++side) {
      const Box& box = side == 0 ? halves.below : halves.above;
      const AxisTest c = test_axis(center, half, box.min[split], box.max[split]);
      const Mask far = hn::Gt(hn::Add(near2, c.near2), outside2);
      const Mask outside = hn::Or(hn::Or(apart, c.apart), far);
      const Mask inside = hn::Lt(hn::Add(far2, c.far2), inside2);
      answers.outside[side] |= bits_of(outside) << i;
      answers.inside[side] |= bits_of(inside) << i;
    }
  }
  return answers;
}

uint64_t find_outside(const RectangleRows& rows, uint32_t count, const Box& cell) {
  const hn::CappedTag<float, kRowPadding> d;
  const auto min_x = hn::Set(d, static_cast<float>(cell.min.x));
  const auto max_x = hn::Set(d, static_cast<float>(cell.max.x));
  const auto min_y = hn::Set(d, static_cast<float>(cell.min.y));
  const auto max_y = hn::Set(d, static_cast<float>(cell.max.y));
  uint64_t outside = 0;
  for (uint32_t i = 0; i < count; i += static_cast<uint32_t>(hn::Lanes(d))) {
    const auto beside = hn::Or(hn::Gt(hn::LoadU(d, rows.low_x + i), max_x),
                               hn::Lt(hn::LoadU(d, rows.high_x + i), min_x));
    const auto above = hn::Or(hn::Gt(hn::LoadU(d, rows.low_y + i), max_y),
                              hn::Lt(hn::LoadU(d, rows.high_y + i), min_y));
    outside |= bits_of(d, hn::Or(beside, above)) << i;
  }
  return outside;
}

using Unsigned = hn::Rebind<uint64_t, Doubles>;
using Counters = hn::Vec<Unsigned>;

/// A lane counts in 8 fields of 8 bits, one for each bin. A field can count kCounterLimit vectors.
static_assert(kSplitBins == 8);
constexpr uint32_t kCounterLimit = 255;

/// Returns a one in the field of the position's bin, in lanes that are `valid`.
HWY_INLINE Counters count_one(Vector position, Vector min, Vector bins_per_length, Counters valid) {
  const Doubles d;
  const Unsigned u;
  // Adding 2^52 rounds to an integer, which the lowest bits then hold. Subtracting ½ first makes it
  // the bin.
  const Vector rounder = hn::Set(d, 0x1p52);
  const Vector bin = hn::Sub(hn::Mul(hn::Sub(position, min), bins_per_length), hn::Set(d, 0.5));
  const Vector clamped = hn::Min(hn::Max(bin, hn::Zero(d)), hn::Set(d, kSplitBins - 1.0));
  const Counters integer = hn::BitCast(u, hn::Add(clamped, rounder));
  const Counters field = hn::ShiftLeft<3>(hn::And(integer, hn::Set(u, kSplitBins - 1)));
  return hn::Shl(valid, field);
}

/// Adds the lanes' fields to `bins`.
HWY_INLINE void add_up(Counters counters, uint32_t* bins) {
  const Unsigned u;
  // Every other field, widened to 16 bits, can hold the sum of all lanes.
  const Counters fields = hn::Set(u, 0x00FF00FF00FF00FFull);
  const uint64_t even = hn::GetLane(hn::SumOfLanes(u, hn::And(counters, fields)));
  const uint64_t odd = hn::GetLane(hn::SumOfLanes(u, hn::And(hn::ShiftRight<8>(counters), fields)));
  for (int i = 0; i < kSplitBins / 2; ++i) {
    bins[2 * i] += (even >> (16 * i)) & 0xFFFF;
    bins[2 * i + 1] += (odd >> (16 * i)) & 0xFFFF;
  }
}

void count_ends(const Extent* extents, const uint32_t* primitives, uint32_t count, const Box& cell,
                EndCounts& counts) {
  const Doubles d;
  const Unsigned u;
  const uint32_t lanes = static_cast<uint32_t>(hn::Lanes(d));
  const uint32_t limit = kCounterLimit * lanes;
  counts = {};
  Vector min[3], scale[3];
  for (int axis = 0; axis < 3; ++axis) {
    min[axis] = hn::Set(d, cell.min[axis]);
    scale[axis] = hn::Set(d, kSplitBins / (cell.max[axis] - cell.min[axis]));
  }
  for (uint32_t first = 0; first < count; first += limit) {
    const uint32_t end = std::min(count - first, limit) + first;
    const Counters zero = hn::Zero(u);
    Counters starts[3] = {zero, zero, zero};
    Counters ends[3] = {zero, zero, zero};
    for (uint32_t i = first; i < end; i += lanes) {
      const Gather gather(extents, primitives + i);
      const auto in_list = hn::Lt(hn::Iota(u, 0), hn::Set(u, end - i));
      const Counters valid = hn::IfThenElseZero(in_list, hn::Set(u, uint64_t{1}));
      for (int axis = 0; axis < 3; ++axis) {
        const Vector center = gather.center(axis);
        const Vector half = gather.half(axis);
        const Counters start = count_one(hn::Sub(center, half), min[axis], scale[axis], valid);
        const Counters stop = count_one(hn::Add(center, half), min[axis], scale[axis], valid);
        starts[axis] = hn::Add(starts[axis], start);
        ends[axis] = hn::Add(ends[axis], stop);
      }
    }
    for (int axis = 0; axis < 3; ++axis) {
      add_up(starts[axis], counts.starts[axis]);
      add_up(ends[axis], counts.ends[axis]);
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace csgcore
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace csgcore {

CSGCORE_SIMD_EXPORT(test_extents);
CSGCORE_SIMD_EXPORT(find_outside);
CSGCORE_SIMD_EXPORT(count_ends);

ExtentAnswers test_extents(const Extent* extents, const uint32_t* primitives, uint32_t count,
                           const Halves& halves) {
  ExtentAnswers answers = CSGCORE_SIMD(test_extents)(extents, primitives, count, halves);
  const uint64_t wanted = first_bits(count);  // vectors have read past the last primitive
  answers.open &= wanted;
  for (const int side : {0, 1}) {
    answers.outside[side] &= wanted;
    answers.inside[side] &= wanted;
  }
  return answers;
}

uint64_t find_outside(const RectangleRows& rows, uint32_t count, const Box& cell) {
  const uint64_t all = CSGCORE_SIMD(find_outside)(rows, count, cell);
  return all & first_bits(count);  // vectors read past the last member
}

void count_ends(const Extent* extents, const uint32_t* primitives, uint32_t count, const Box& cell,
                EndCounts& counts) {
  CSGCORE_SIMD(count_ends)(extents, primitives, count, cell, counts);
}

}  // namespace csgcore
#endif  // HWY_ONCE
