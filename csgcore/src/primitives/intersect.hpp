// The intersection of packets of rays with one primitive.
#pragma once

#include <vector>

#include "csgcore/canonical_primitive.hpp"
#include "primitives/crossings.hpp"
#include "rays/frame_rays.hpp"
#include "rays/ray_packet.hpp"

namespace csgcore {

void intersect(const FrameRays& frame, const RayPacket& rays, const CanonicalPrimitive& primitive,
               PacketSegments& segments);
/// Intersects the first four lanes only. Precondition of both: the primitive is convex.
void intersect_four(const FrameRays& frame, const RayPacket& rays,
                    const CanonicalPrimitive& primitive, PacketSegments& segments);

/// Finds the crossings of all lanes with a primitive that is not convex that `search` wants.
void find_next_crossings(const FrameRays& frame, const RayPacket& rays,
                         const CanonicalPrimitive& primitive, CrossingSearch& search);
/// Finds all crossings of all lanes with a primitive that is not convex, in order.
void find_all_crossings(const FrameRays& frame, const RayPacket& rays,
                        const CanonicalPrimitive& primitive, CrossingSearch& search);
/// Finds the outward unit normals at the crossings of such a primitive that were found:
/// normals[lane] has one for each of search.lanes[lane].found.
void find_crossing_normals(const FrameRays& frame, const RayPacket& rays,
                           const CanonicalPrimitive& primitive, const CrossingSearch& search,
                           std::vector<Vec3> (&normals)[kPacketRays]);

/// Finds the primitive's outward unit normals where the first four lanes enter it, coordinate by
/// coordinate. Normals of one plane face are the same, bit for bit. `normals` must be aligned as a
/// packet is.
void find_entry_normals(const FrameRays& frame, const RayPacket& rays,
                        const CanonicalPrimitive& primitive, const PacketSegments& segments,
                        double (&normals)[3][kPacketRays]);

/// Returns lanes whose points at t certainly lie further than `distance` (world units) from the
/// primitive, or from a polyhedron's enclosure. The test is done in float (NUMERICS.md,
/// "Classification and culling"). Precondition: the primitive is no ball (ball_radius = 0).
LaneMask find_apart(const FrameRays& frame, const RayPacket& rays,
                    const CanonicalPrimitive& primitive, const double (&t)[kPacketRays],
                    double distance);

}  // namespace csgcore
