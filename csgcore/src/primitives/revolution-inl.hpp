// The crossings of rays with revolutions. Included once per instruction set.
#if defined(CSGCORE_REVOLUTION_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef CSGCORE_REVOLUTION_INL_HPP
#undef CSGCORE_REVOLUTION_INL_HPP
#else
#define CSGCORE_REVOLUTION_INL_HPP
#endif

#include "csgcore/profile.hpp"
#include "primitives/crossings.hpp"
#include "primitives/polyhedron-inl.hpp"
#include "rays/frame_rays.hpp"

HWY_BEFORE_NAMESPACE();
namespace csgcore {
namespace HWY_NAMESPACE {

/// See kind_crossings-inl.hpp.
struct RevolutionCrossings {
  static constexpr bool kFindsAll = true;

  static void find(const FrameRays&, const RayPacket&, LaneMask, const CanonicalPrimitive&,
                   CrossingSearch&) {}
  static bool is_closed(const CanonicalPrimitive&) { return true; }
  static Vec3 normal(const CanonicalPrimitive&, uint32_t, const Vec3&) { return {0, 0, 1}; }
};

}  // namespace HWY_NAMESPACE
}  // namespace csgcore
HWY_AFTER_NAMESPACE();

#endif  // include guard
