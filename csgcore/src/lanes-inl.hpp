// Vectors of three coordinates in Highway's lanes. Included once per instruction set.
#if defined(CSGCORE_LANES_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef CSGCORE_LANES_INL_HPP
#undef CSGCORE_LANES_INL_HPP
#else
#define CSGCORE_LANES_INL_HPP
#endif

#include <hwy/highway.h>

#include <limits>

#include "csgcore/geometry.hpp"
#include "packet.hpp"

HWY_BEFORE_NAMESPACE();
namespace csgcore {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// As many lanes as the machine has, up to 8; and a single one, for what is done ray by ray.
using Wide = hn::CappedTag<double, 8>;
using Single = hn::CappedTag<double, 1>;

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
HWY_INLINE Lanes3<D> broadcast(D d, const Vec3& v) {
  return {hn::Set(d, v.x), hn::Set(d, v.y), hn::Set(d, v.z)};
}
/// m · v
template <class D>
HWY_INLINE Lanes3<D> transformed(D d, const Mat3& m, const Lanes3<D>& v) {
  const auto row = [&](int i) {
    return hn::Add(hn::Add(hn::Mul(hn::Set(d, m[0][i]), v.x), hn::Mul(hn::Set(d, m[1][i]), v.y)),
                   hn::Mul(hn::Set(d, m[2][i]), v.z));
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
HWY_INLINE Rays<D> load_rays(D d, const RayPacket& packet, size_t first) {
  return {load3(d, packet.origin, first), load3(d, packet.direction, first),
          hn::LoadU(d, packet.inverse_length2 + first)};
}

template <class D>
struct Segment {
  hn::Vec<D> start, end;
};
template <class D>
HWY_INLINE Segment<D> segment_if(D d, hn::Mask<D> exists, hn::Vec<D> start, hn::Vec<D> end) {
  return {hn::IfThenElse(exists, start, hn::Set(d, kInfinity)),
          hn::IfThenElse(exists, end, hn::Set(d, -kInfinity))};
}

/// Length 1; 0 stays 0.
template <class D>
HWY_INLINE Lanes3<D> normalized(D d, const Lanes3<D>& v) {
  const auto length2 = dot(d, v, v);
  const auto inverse = hn::Div(hn::Set(d, 1.0), hn::Sqrt(length2));
  return scaled(v, hn::IfThenElseZero(hn::Gt(length2, hn::Zero(d)), inverse));
}

}  // namespace HWY_NAMESPACE
}  // namespace csgcore
HWY_AFTER_NAMESPACE();

#endif  // include guard
