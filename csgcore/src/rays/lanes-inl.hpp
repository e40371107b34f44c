// Vectors of three coordinates in Highway's lanes. Included once per instruction set.
#if defined(CSGCORE_LANES_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef CSGCORE_LANES_INL_HPP
#undef CSGCORE_LANES_INL_HPP
#else
#define CSGCORE_LANES_INL_HPP
#endif

#include <hwy/highway.h>

#include <bit>
#include <cmath>

#include "base/constants.hpp"
#include "csgcore/geometry.hpp"
#include "rays/ray_packet.hpp"

HWY_BEFORE_NAMESPACE();
namespace csgcore {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Wide has as many lanes as the machine has, up to 8. Single has one, for work that is done ray by
/// ray.
using Wide = hn::CappedTag<double, 8>;
using Single = hn::CappedTag<double, 1>;

constexpr size_t kLanes = HWY_MIN(size_t{8}, HWY_LANES(double));
constexpr int kChunks = static_cast<int>(kPacketRays / kLanes);
/// The chunks that hold a packet's first four lanes.
constexpr int kFourChunks = static_cast<int>(kLanes < 4 ? 4 / kLanes : 1);
using WideV = hn::Vec<Wide>;
using WideM = hn::Mask<Wide>;

/// A packet's worth of vectors.
struct PacketV {
  WideV chunk[kChunks];
};
HWY_INLINE size_t first_lane(int chunk) { return static_cast<size_t>(chunk) * kLanes; }

HWY_INLINE LaneMask bits_of(WideM mask, int chunk) {
  uint8_t bytes[8] = {};
  hn::StoreMaskBits(Wide(), mask, bytes);
  return LaneMask{bytes[0]} << first_lane(chunk);
}
template <class D>
HWY_INLINE hn::Mask<D> mask_from(D d, LaneMask lanes) {
  const uint8_t bytes[8] = {static_cast<uint8_t>(lanes), static_cast<uint8_t>(lanes >> 8)};
  return hn::LoadMaskBits(d, bytes);
}
HWY_INLINE WideM mask_of(LaneMask lanes, int chunk) {
  return mask_from(Wide(), lanes >> first_lane(chunk));
}

/// Vectors of as many floats as the machine has, up to 16.
using Floats = hn::CappedTag<float, 16>;

/// Returns the lanes that are set in the mask of a vector of floats, which begins with lane
/// `first`.
HWY_INLINE LaneMask float_bits_of(hn::Mask<Floats> mask, size_t first) {
  uint8_t bytes[8] = {};
  hn::StoreMaskBits(Floats(), mask, bytes);
  return (LaneMask{bytes[0]} | LaneMask{bytes[1]} << 8) << first;
}
/// Returns all lanes of that vector.
HWY_INLINE LaneMask float_lanes(size_t first) {
  return (kAllLanes >> (kPacketRays - hn::Lanes(Floats()))) << first;
}

/// A number that stands for 1/0 in float: its product with 0 is 0.
constexpr double kLargestInverse = 1e30;
/// Returns 1/x, and that number where it would be larger.
template <typename D>
HWY_INLINE hn::Vec<D> bounded_inverse(D d, hn::Vec<D> x) {
  const hn::Vec<D> one = hn::Set(d, 1.0), largest = hn::Set(d, kLargestInverse);
  const hn::Mask<D> has_inverse = hn::Gt(hn::Mul(hn::Abs(x), largest), one);
  return hn::IfThenElse(has_inverse, hn::Div(one, x), hn::CopySign(largest, x));
}

HWY_INLINE LaneMask chunk_lanes(int chunk) {
  return ((LaneMask{1} << kLanes) - 1) << first_lane(chunk);
}

/// The chunks that hold any of the given lanes, for a loop over them.
class ChunksOf {
 public:
  class Iterator {
   public:
    HWY_INLINE explicit Iterator(LaneMask left) : left_(left) {}
    HWY_INLINE int operator*() const { return std::countr_zero(left_) / static_cast<int>(kLanes); }
    HWY_INLINE Iterator& operator++() {
      left_ &= ~chunk_lanes(**this);
      return *this;
    }
    HWY_INLINE bool operator!=(const Iterator& other) const { return left_ != other.left_; }

   private:
    LaneMask left_;
  };
  HWY_INLINE explicit ChunksOf(LaneMask lanes) : lanes_(lanes) {}
  HWY_INLINE Iterator begin() const { return Iterator(lanes_); }
  HWY_INLINE Iterator end() const { return Iterator(0); }

 private:
  LaneMask lanes_;
};

HWY_INLINE void fill_lanes(LaneMask lanes, uint32_t value, uint32_t (&all)[kPacketRays]) {
  const hn::CappedTag<uint32_t, kPacketRays> d;
  for (size_t first = 0; first < kPacketRays; first += hn::Lanes(d)) {
    // A masked store would take dozens of operations on some processors.
    const auto mask = mask_from(d, lanes >> first);
    hn::StoreU(hn::IfThenElse(mask, hn::Set(d, value), hn::LoadU(d, all + first)), d, all + first);
  }
}

template <class D>
struct Lanes3 {
  using V = hn::Vec<D>;
  V x, y, z;
};

template <class D>
HWY_INLINE Lanes3<D> operator+(const Lanes3<D>& a, const Lanes3<D>& b) {
  return {hn::Add(a.x, b.x), hn::Add(a.y, b.y), hn::Add(a.z, b.z)};
}
template <class D>
HWY_INLINE Lanes3<D> operator-(const Lanes3<D>& a, const Lanes3<D>& b) {
  return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}
template <class D>
HWY_INLINE Lanes3<D> scaled(const Lanes3<D>& a, hn::Vec<D> factor) {
  return {hn::Mul(a.x, factor), hn::Mul(a.y, factor), hn::Mul(a.z, factor)};
}
template <class D>
HWY_INLINE hn::Vec<D> dot(D, const Lanes3<D>& a, const Lanes3<D>& b) {
  return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
}
template <class D>
HWY_INLINE hn::Vec<D> set(D d, double value) {
  return hn::Set(d, static_cast<hn::TFromD<D>>(value));
}
template <class D>
HWY_INLINE Lanes3<D> broadcast(D d, const Vec3& v) {
  return {set(d, v.x), set(d, v.y), set(d, v.z)};
}
/// m · v
template <class D>
HWY_INLINE Lanes3<D> transformed(D d, const Mat3& m, const Lanes3<D>& v) {
  const auto row = [&](int i) {
    return hn::Add(hn::Add(hn::Mul(set(d, m[0][i]), v.x), hn::Mul(set(d, m[1][i]), v.y)),
                   hn::Mul(set(d, m[2][i]), v.z));
  };
  return {row(0), row(1), row(2)};
}
/// mᵀ · v
template <class D>
HWY_INLINE Lanes3<D> transformed_back(D d, const Mat3& m, const Lanes3<D>& v) {
  const auto column = [&](int i) {
    return hn::Add(hn::Add(hn::Mul(hn::Set(d, m[i].x), v.x), hn::Mul(hn::Set(d, m[i].y), v.y)),
                   hn::Mul(hn::Set(d, m[i].z), v.z));
  };
  return {column(0), column(1), column(2)};
}

template <class D>
HWY_INLINE Lanes3<D> if_then_else(hn::Mask<D> mask, const Lanes3<D>& yes, const Lanes3<D>& no) {
  return {hn::IfThenElse(mask, yes.x, no.x), hn::IfThenElse(mask, yes.y, no.y),
          hn::IfThenElse(mask, yes.z, no.z)};
}

/// Some lanes of a RayPacket.
template <class D>
struct Rays {
  Lanes3<D> origin, direction;
  hn::Vec<D> inverse_length2;
};

template <class D>
HWY_INLINE Lanes3<D> load3(D d, const double (&lanes)[3][kPacketRays], size_t first) {
  return {hn::LoadU(d, lanes[0] + first), hn::LoadU(d, lanes[1] + first),
          hn::LoadU(d, lanes[2] + first)};
}
template <class D>
HWY_INLINE void store3(D d, const Lanes3<D>& v, double (&lanes)[3][kPacketRays], size_t first) {
  hn::Store(v.x, d, lanes[0] + first);
  hn::Store(v.y, d, lanes[1] + first);
  hn::Store(v.z, d, lanes[2] + first);
}
template <class D>
HWY_INLINE Rays<D> load_rays(D d, const RayPacket& packet, size_t first) {
  return {load3(d, packet.origin, first), load3(d, packet.direction, first),
          hn::LoadU(d, packet.inverse_length2 + first)};
}

/// The stretches of rays within a primitive: start < end, or +∞ and −∞ if the ray misses it. The
/// masks are the `on_cap` with which the normals at the ends are found (primitive-inl.hpp).
template <class D>
struct Segment {
  hn::Vec<D> start, end;
  hn::Mask<D> start_on_cap, end_on_cap;
};
template <class D>
HWY_INLINE hn::Mask<D> no_lanes(D d) {
  return hn::Lt(hn::Zero(d), hn::Zero(d));
}
template <class D>
HWY_INLINE Segment<D> segment_if(D d, hn::Mask<D> exists, hn::Vec<D> start, hn::Vec<D> end,
                                 hn::Mask<D> start_on_cap, hn::Mask<D> end_on_cap) {
  return {hn::IfThenElse(exists, start, hn::Set(d, kInfinity)),
          hn::IfThenElse(exists, end, hn::Set(d, -kInfinity)), start_on_cap, end_on_cap};
}
/// Returns the segment within a round wall. `middle` is the ray's parameter at the foot of the
/// perpendicular from the wall's centre or axis, and `inside` is radius² − |foot|², which has the
/// primitive's own magnitude, so that no large numbers cancel.
template <class D>
HWY_INLINE Segment<D> segment_about(D d, hn::Vec<D> middle, hn::Vec<D> inside,
                                    hn::Vec<D> inverse_length2) {
  const auto exists = hn::Gt(inside, hn::Zero(d));
  const auto half = hn::Sqrt(hn::Mul(hn::Max(inside, hn::Zero(d)), inverse_length2));
  return segment_if(d, exists, hn::Sub(middle, half), hn::Add(middle, half), no_lanes(d),
                    no_lanes(d));
}

/// Newton's iteration y ← y·(3/2 − x/2·y²) for 1/√x. A step reduces a relative error e to 3/2·e².
template <class D>
HWY_INLINE hn::Vec<D> newton_inverse_sqrt(D d, hn::Vec<D> x, hn::Vec<D> y, int steps) {
  const auto half = hn::Mul(hn::Set(d, 0.5), x);
  for (int step = 0; step < steps; ++step) {
    y = hn::Mul(y, hn::Sub(hn::Set(d, 1.5), hn::Mul(hn::Mul(half, y), y)));
  }
  return y;
}
/// Returns 1/√x for x > 0, up to two roundings, and a finite number for 0. It multiplies only,
/// since a square root and a division take three times as long. The halved and negated exponent
/// (Lomont, "Fast inverse square root", 2003) is off by up to 3.5e-2; four steps reduce that to
/// 1.8e-3, 4.9e-6, 3.6e-11, and to rounding.
template <class D>
HWY_INLINE hn::Vec<D> inverse_sqrt(D d, hn::Vec<D> x) {
  const hn::RebindToUnsigned<D> bits;
  const auto magic = hn::Set(bits, uint64_t{0x5FE6EB50C7B537A9});
  const auto guess = hn::BitCast(d, hn::Sub(magic, hn::ShiftRight<1>(hn::BitCast(bits, x))));
  return newton_inverse_sqrt(d, x, guess, 4);
}

/// Returns the vectors scaled to length 1. A zero vector stays zero.
template <class D>
HWY_INLINE Lanes3<D> normalized(D d, const Lanes3<D>& v) {
  return scaled(v, inverse_sqrt(d, dot(d, v, v)));
}

}  // namespace HWY_NAMESPACE
}  // namespace csgcore
HWY_AFTER_NAMESPACE();

#endif  // include guard
