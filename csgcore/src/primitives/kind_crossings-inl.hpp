// Finds the crossings of primitives that are not convex, of any such kind. Included once per
// instruction set.
//
// A kind called Name has a struct NameCrossings with
//   find(frame, packet, lanes, primitive, search): adds to `search` the crossings of each lane that
//     it wants;
//   kFindsAll: whether find() takes no notice of what is wanted, and gives all crossings;
//   is_closed(primitive): whether the crossings cancel on every ray;
//   normal(primitive, face, point): the outward normal of a face in world space, of any length, at
//     a canonical point on it.
#if defined(CSGCORE_KIND_CROSSINGS_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef CSGCORE_KIND_CROSSINGS_INL_HPP
#undef CSGCORE_KIND_CROSSINGS_INL_HPP
#else
#define CSGCORE_KIND_CROSSINGS_INL_HPP
#endif

#include "primitives/extrusion-inl.hpp"
#include "primitives/mesh-inl.hpp"
#include "primitives/revolution-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace csgcore {
namespace HWY_NAMESPACE {

/// Calls visit(NameCrossings()) for the primitive's kind, which is not convex.
template <class Visit>
HWY_INLINE void with_crossings_of_kind(const CanonicalPrimitive& primitive, Visit&& visit) {
  switch (primitive.shape) {
#define CSGCORE_CASE(Name) \
  case Shape::k##Name:     \
    return visit(Name##Crossings());
    CSGCORE_FOR_EACH_OTHER_SHAPE(CSGCORE_CASE)
#undef CSGCORE_CASE
#define CSGCORE_CASE(Name) case Shape::k##Name:
    CSGCORE_FOR_EACH_CONVEX_SHAPE(CSGCORE_CASE)
#undef CSGCORE_CASE
    break;
  }
}

/// Finds the next `most` crossings of each of the lanes.
HWY_NOINLINE static HWY_MAYBE_UNUSED void find_crossings(const FrameRays& frame,
                                                         const RayPacket& packet, LaneMask lanes,
                                                         const CanonicalPrimitive& primitive,
                                                         CrossingSearch& search) {
  for_each_lane(lanes, [&](uint32_t lane) { search.lanes[lane].found.clear(); });
  with_crossings_of_kind(primitive,
                         [&](auto kind) { kind.find(frame, packet, lanes, primitive, search); });
  if (search.most != CrossingSearch::kAll) return;
  for_each_lane(lanes, [&](uint32_t lane) { sort(search.lanes[lane].found); });
}

/// Returns whether a search finds all crossings at once.
HWY_INLINE bool finds_all(const CanonicalPrimitive& primitive) {
  bool finds_all = false;
  with_crossings_of_kind(primitive, [&](auto kind) { finds_all = kind.kFindsAll; });
  return finds_all;
}

HWY_INLINE bool is_closed(const CanonicalPrimitive& primitive) {
  bool is_closed = true;
  with_crossings_of_kind(primitive, [&](auto kind) { is_closed = kind.is_closed(primitive); });
  return is_closed;
}

/// Returns the unit normal of a face in world space where the lane passes it at t: turned against
/// the ray if the ray enters the primitive there, and along it if the ray leaves.
HWY_NOINLINE static HWY_MAYBE_UNUSED Vec3 normal_of_face(const FrameRays& frame,
                                                         const CanonicalPrimitive& primitive,
                                                         uint32_t face, const RayPacket& packet,
                                                         uint32_t lane, double t, bool leaves) {
  const Vec3 origin{packet.origin[0][lane], packet.origin[1][lane], packet.origin[2][lane]};
  const Vec3 direction{packet.direction[0][lane], packet.direction[1][lane],
                       packet.direction[2][lane]};
  const Vec3 point =
      primitive.world_to_canonical * (origin - (primitive.center - frame.pivot) + t * direction);
  Vec3 normal{0.0};
  with_crossings_of_kind(primitive,
                         [&](auto kind) { normal = kind.normal(primitive, face, point); });
  const bool is_along = glm::dot(normal, direction) > 0;
  return (is_along == leaves ? 1.0 : -1.0) * glm::normalize(normal);
}

}  // namespace HWY_NAMESPACE
}  // namespace csgcore
HWY_AFTER_NAMESPACE();

#endif  // include guard
