// Compiled once per instruction set by Highway. Multiplications and additions are never fused, and
// the result of a lane does not depend on other lanes: every instruction set gives the same bits.
#include "primitives/intersect.hpp"

#include "base/simd.hpp"

#define HWY_DISABLED_TARGETS CSGCORE_DISABLED_TARGETS
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "primitives/intersect.cpp"
#include <hwy/foreach_target.h>  // includes this file again for every instruction set
#include <hwy/highway.h>

#include "primitives/apart-inl.hpp"
#include "primitives/kind_crossings-inl.hpp"
#include "primitives/primitive-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace csgcore {
namespace HWY_NAMESPACE {

void intersect(const FrameRays& frame, const RayPacket& rays, const CanonicalPrimitive& primitive,
               PacketSegments& segments) {
  intersect_lanes(frame, rays, kAllLanes, primitive, segments);
}

void intersect_four(const FrameRays& frame, const RayPacket& rays,
                    const CanonicalPrimitive& primitive, PacketSegments& segments) {
  intersect_lanes(frame, rays, 0xF, primitive, segments);
}

void find_next_crossings(const FrameRays& frame, const RayPacket& rays,
                         const CanonicalPrimitive& primitive, CrossingSearch& search) {
  find_crossings(frame, rays, kAllLanes, primitive, search);
}

void find_crossing_normals(const FrameRays& frame, const RayPacket& rays,
                           const CanonicalPrimitive& primitive, const CrossingSearch& search,
                           std::vector<Vec3> (&normals)[kPacketRays]) {
  for (uint32_t lane = 0; lane < kPacketRays; ++lane) {
    normals[lane].clear();
    for (const Crossing& crossing : search.lanes[lane].found) {
      normals[lane].push_back(normal_of_face(frame, primitive, crossing.face, rays, lane,
                                             crossing.t, crossing.turn < 0));
    }
  }
}

void find_entry_normals(const FrameRays& frame, const RayPacket& rays,
                        const CanonicalPrimitive& primitive, const PacketSegments& segments,
                        double (&normals)[3][kPacketRays]) {
  PacketV t;
  Lanes3<Wide> found[kChunks];
  for (int c = 0; c < kFourChunks; ++c) {
    t.chunk[c] = hn::Load(Wide(), segments.start + first_lane(c));
  }
  find_normals(frame, rays, 0xF, primitive, t, segments.start_on_cap, found);
  for (int c = 0; c < kFourChunks; ++c) store3(Wide(), found[c], normals, first_lane(c));
}

LaneMask find_apart(const FrameRays& frame, const RayPacket& rays,
                    const CanonicalPrimitive& primitive, const double (&t)[kPacketRays],
                    double distance) {
  PacketV at;
  for (int c = 0; c < kChunks; ++c) at.chunk[c] = hn::LoadU(Wide(), t + first_lane(c));
  PacketPoints points;
  find_points(rays, at, distance, points);
  return lanes_apart(primitive, frame.pivot, points, distance);
}

}  // namespace HWY_NAMESPACE
}  // namespace csgcore
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace csgcore {

CSGCORE_SIMD_EXPORT(intersect);
CSGCORE_SIMD_EXPORT(intersect_four);
CSGCORE_SIMD_EXPORT(find_next_crossings);
CSGCORE_SIMD_EXPORT(find_crossing_normals);
CSGCORE_SIMD_EXPORT(find_entry_normals);
CSGCORE_SIMD_EXPORT(find_apart);

void intersect(const FrameRays& frame, const RayPacket& rays, const CanonicalPrimitive& primitive,
               PacketSegments& segments) {
  CSGCORE_SIMD(intersect)(frame, rays, primitive, segments);
}

void intersect_four(const FrameRays& frame, const RayPacket& rays,
                    const CanonicalPrimitive& primitive, PacketSegments& segments) {
  CSGCORE_SIMD(intersect_four)(frame, rays, primitive, segments);
}

void find_next_crossings(const FrameRays& frame, const RayPacket& rays,
                         const CanonicalPrimitive& primitive, CrossingSearch& search) {
  CSGCORE_SIMD(find_next_crossings)(frame, rays, primitive, search);
}

void find_all_crossings(const FrameRays& frame, const RayPacket& rays,
                        const CanonicalPrimitive& primitive, CrossingSearch& search) {
  for (CrossingSearch::Lane& lane : search.lanes) lane.after = {};
  search.most = CrossingSearch::kAll;
  find_next_crossings(frame, rays, primitive, search);
}

void find_crossing_normals(const FrameRays& frame, const RayPacket& rays,
                           const CanonicalPrimitive& primitive, const CrossingSearch& search,
                           std::vector<Vec3> (&normals)[kPacketRays]) {
  CSGCORE_SIMD(find_crossing_normals)(frame, rays, primitive, search, normals);
}

void find_entry_normals(const FrameRays& frame, const RayPacket& rays,
                        const CanonicalPrimitive& primitive, const PacketSegments& segments,
                        double (&normals)[3][kPacketRays]) {
  CSGCORE_SIMD(find_entry_normals)(frame, rays, primitive, segments, normals);
}

LaneMask find_apart(const FrameRays& frame, const RayPacket& rays,
                    const CanonicalPrimitive& primitive, const double (&t)[kPacketRays],
                    double distance) {
  return CSGCORE_SIMD(find_apart)(frame, rays, primitive, t, distance);
}

}  // namespace csgcore
#endif  // HWY_ONCE
