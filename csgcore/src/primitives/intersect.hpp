// Packets of rays against one primitive.
#pragma once

#include "csgcore/canonical_primitive.hpp"
#include "primitives/packet_segments.hpp"
#include "rays/frame_rays.hpp"
#include "rays/ray_packet.hpp"

namespace csgcore {

void intersect(const FrameRays& frame, const RayPacket& rays, const CanonicalPrimitive& primitive,
               PacketSegments& segments);
/// Of the first four lanes alone.
void intersect_four(const FrameRays& frame, const RayPacket& rays,
                    const CanonicalPrimitive& primitive, PacketSegments& segments);

/// Of the first four lanes alone: the primitive's outward unit normals where they enter it, by
/// coordinate. Those of one plane face are the same, bit for bit. `normals` is aligned as a packet
/// is.
void find_entry_normals(const FrameRays& frame, const RayPacket& rays,
                        const CanonicalPrimitive& primitive, const PacketSegments& segments,
                        double (&normals)[3][kPacketRays]);

/// The lanes that certainly lie, at τ = t, further than `distance` (world units) away from the
/// primitive, or, of a polyhedron, from what encloses it; told in float (NUMERICS.md,
/// "Classification and culling"). Polyhedra and what is no true ball only.
LaneMask find_apart(const FrameRays& frame, const RayPacket& rays,
                    const CanonicalPrimitive& primitive, const double (&t)[kPacketRays],
                    double distance);

}  // namespace csgcore
