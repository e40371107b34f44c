// The crossings of rays with triangle meshes. Included once per instruction set.
//
// Each vertex is sheared into a plane in which the ray is the origin (Woop, Benthin, Wald,
// "Watertight Ray/Triangle Intersection", JCGT 2013), by the same operations for all triangles that
// share it. The signs of the triangles' edges in that plane are exact (planar_turn.hpp), so that
// the triangles are a consistent drawing whatever the shear has rounded: the crossings of a closed
// mesh cancel on every ray.
#if defined(CSGCORE_MESH_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef CSGCORE_MESH_INL_HPP
#undef CSGCORE_MESH_INL_HPP
#else
#define CSGCORE_MESH_INL_HPP
#endif

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "csgcore/triangle_mesh.hpp"
#include "primitives/crossings.hpp"
#include "primitives/planar_turn.hpp"
#include "primitives/polyhedron-inl.hpp"
#include "rays/frame_rays.hpp"

HWY_BEFORE_NAMESPACE();
namespace csgcore {
namespace HWY_NAMESPACE {
namespace mesh_rays {

/// The rays of a packet in canonical space, o + (t − base)·d, and what tests need of them. The
/// directions of all lanes that are traced together are longest along the same axis.
struct alignas(64) PacketRays {
  double origin[3][kPacketRays];
  double direction[3][kPacketRays];
  double base[kPacketRays];
  double shear[2][kPacketRays];       // of the two other axes, per unit of the longest
  double least_growth2[kPacketRays];  // see kEdgeOn
  double inverse[kPacketRays];        // of the direction along the longest axis
  float near_origin[3][kPacketRays];
  float near_inverse[3][kPacketRays];
  float first_t[kPacketRays];  // relative to base: crossings before it are not wanted
  float last_t[kPacketRays];   // nor are those behind it
};

/// A ray that meets a triangle at a smaller cosine passes it edge-on: the plane alone might place
/// the crossing beside the triangle, and the edges bound its depth as well.
constexpr double kEdgeOn = 0x1p-10;

/// These lie on that side of the number, if not next to it.
HWY_INLINE float float_below(double t) {
  const float nearest = static_cast<float>(t);
  return nearest - std::max(std::abs(nearest) * std::numeric_limits<float>::epsilon(),
                            std::numeric_limits<float>::min());
}
HWY_INLINE float float_above(double t) { return -float_below(-t); }

/// Maps the rays into canonical space. Returns the lanes that pass the unit ball.
HWY_INLINE LaneMask enter_canonical(const FrameRays& frame, const RayPacket& packet, LaneMask lanes,
                                    const CanonicalPrimitive& primitive, PacketRays& rays) {
  const Wide d;
  const Vec3 center = primitive.center - frame.pivot;
  LaneMask reaching = 0;
  for (const int c : ChunksOf(lanes)) {
    const size_t first = first_lane(c);
    const auto [o, direction, inverse_length2, base] =
        polyhedron_rays::rebased(d, primitive, center, load_rays(d, packet, first));
    store3(d, o, rays.origin, first);
    store3(d, direction, rays.direction, first);
    hn::Store(base, d, rays.base + first);
    constexpr double kReach2 = 1 + 1e-6;  // the mesh lies in the unit ball
    reaching |= bits_of(hn::Le(dot(d, o, o), hn::Set(d, kReach2)), c);
  }
  return reaching & lanes;
}

/// Returns the axis along which the lane's direction is longest.
HWY_INLINE int longest_axis(const PacketRays& rays, uint32_t lane) {
  const double x = std::abs(rays.direction[0][lane]), y = std::abs(rays.direction[1][lane]),
               z = std::abs(rays.direction[2][lane]);
  return x >= y && x >= z ? 0 : y >= z ? 1 : 2;
}

/// Prepares the lanes, whose longest axis is given, for the search.
HWY_INLINE void prepare(const CrossingSearch& search, LaneMask lanes, int longest,
                        PacketRays& rays) {
  const Wide d;
  const hn::Rebind<float, Wide> near;
  const int across[] = {(longest + 1) % 3, (longest + 2) % 3};
  for (const int c : ChunksOf(lanes)) {
    const size_t first = first_lane(c);
    const Lanes3<Wide> direction{hn::Load(d, rays.direction[0] + first),
                                 hn::Load(d, rays.direction[1] + first),
                                 hn::Load(d, rays.direction[2] + first)};
    const WideV longest_part = hn::Load(d, rays.direction[longest] + first);
    hn::Store(hn::Mul(hn::Set(d, kEdgeOn * kEdgeOn), dot(d, direction, direction)), d,
              rays.least_growth2 + first);
    hn::Store(hn::Div(hn::Set(d, 1.0), longest_part), d, rays.inverse + first);
    for (int i = 0; i < 2; ++i) {
      const WideV part = hn::Load(d, rays.direction[across[i]] + first);
      hn::Store(hn::Div(part, longest_part), d, rays.shear[i] + first);
    }
    for (int axis = 0; axis < 3; ++axis) {
      const WideV origin = hn::Load(d, rays.origin[axis] + first);
      const WideV part = hn::Load(d, rays.direction[axis] + first);
      hn::Store(hn::DemoteTo(near, origin), near, rays.near_origin[axis] + first);
      hn::Store(hn::DemoteTo(near, bounded_inverse(d, part)), near,
                rays.near_inverse[axis] + first);
    }
  }
  for (LaneMask left = lanes; left != 0; left &= left - 1) {
    const uint32_t lane = static_cast<uint32_t>(std::countr_zero(left));
    rays.first_t[lane] = float_below(search.lanes[lane].after.t - rays.base[lane]);
    rays.last_t[lane] = std::numeric_limits<float>::infinity();
  }
}

/// Returns those of the lanes that pass the node's box where crossings are wanted.
HWY_INLINE LaneMask lanes_through(const TriangleMesh::Node& node, const PacketRays& rays,
                                  LaneMask lanes) {
  const Floats d;
  LaneMask through = 0;
  for (size_t first = 0; first < kPacketRays; first += hn::Lanes(d)) {
    if ((lanes & float_lanes(first)) == 0) continue;
    auto enter = hn::Load(d, rays.first_t + first);
    auto leave = hn::Load(d, rays.last_t + first);
    for (size_t axis = 0; axis < 3; ++axis) {
      const auto origin = hn::Load(d, rays.near_origin[axis] + first);
      const auto inverse = hn::Load(d, rays.near_inverse[axis] + first);
      const auto a = hn::Mul(hn::Sub(hn::Set(d, node.min[axis]), origin), inverse);
      const auto b = hn::Mul(hn::Sub(hn::Set(d, node.max[axis]), origin), inverse);
      enter = hn::Max(enter, hn::Min(a, b));
      leave = hn::Min(leave, hn::Max(a, b));
    }
    through |= float_bits_of(hn::Le(enter, leave), first);
  }
  return through & lanes;
}

/// A triangle's corners as seen along a chunk of rays: sheared, and the depth along the longest
/// axis.
struct SeenCorners {
  WideV x[3], y[3], depth[3];
};

HWY_INLINE SeenCorners seen_corners(const TriangleMesh& mesh,
                                    const TriangleMesh::Triangle& triangle, const PacketRays& rays,
                                    int longest, size_t first) {
  const Wide d;
  const int across[] = {(longest + 1) % 3, (longest + 2) % 3};
  const WideV origin_x = hn::Load(d, rays.origin[across[0]] + first);
  const WideV origin_y = hn::Load(d, rays.origin[across[1]] + first);
  const WideV origin_z = hn::Load(d, rays.origin[longest] + first);
  const WideV shear_x = hn::Load(d, rays.shear[0] + first);
  const WideV shear_y = hn::Load(d, rays.shear[1] + first);
  SeenCorners seen;
  for (size_t corner = 0; corner < 3; ++corner) {
    const Vec3& vertex = mesh.canonical_vertices()[triangle[corner]];
    const WideV depth = hn::Sub(hn::Set(d, vertex[longest]), origin_z);
    const WideV x = hn::Sub(hn::Set(d, vertex[across[0]]), origin_x);
    const WideV y = hn::Sub(hn::Set(d, vertex[across[1]]), origin_y);
    seen.depth[corner] = depth;
    seen.x[corner] = hn::Sub(x, hn::Mul(shear_x, depth));
    seen.y[corner] = hn::Sub(y, hn::Mul(shear_y, depth));
  }
  return seen;
}

/// The lanes around which a triangle winds, in either direction.
struct Windings {
  LaneMask positive = 0, negative = 0;
};

HWY_INLINE Windings windings_of(const SeenCorners& seen, LaneMask lanes, int chunk) {
  WideM lefts = hn::Not(no_lanes(Wide())), rights = lefts;
  WideM equals = no_lanes(Wide());
  for (size_t a = 0; a < 3; ++a) {
    const size_t b = (a + 1) % 3;
    const WideV left = hn::Mul(seen.x[a], seen.y[b]);
    const WideV right = hn::Mul(seen.y[a], seen.x[b]);
    lefts = hn::And(lefts, hn::Ge(left, right));
    rights = hn::And(rights, hn::Le(left, right));
    equals = hn::Or(equals, hn::Eq(left, right));
  }
  Windings result{bits_of(lefts, chunk) & lanes, bits_of(rights, chunk) & lanes};
  LaneMask unclear = bits_of(equals, chunk) & (result.positive | result.negative);
  if (unclear == 0) return result;
  alignas(64) double x[3][kLanes], y[3][kLanes];
  for (size_t corner = 0; corner < 3; ++corner) {
    hn::Store(seen.x[corner], Wide(), x[corner]);
    hn::Store(seen.y[corner], Wide(), y[corner]);
  }
  for (; unclear != 0; unclear &= unclear - 1) {
    const LaneMask bit = unclear & -unclear;
    const size_t lane = static_cast<size_t>(std::countr_zero(bit)) - first_lane(chunk);
    const int winding =
        winding_of({x[0][lane], y[0][lane]}, {x[1][lane], y[1][lane]}, {x[2][lane], y[2][lane]});
    result.positive &= ~bit;
    result.negative &= ~bit;
    if (winding > 0) result.positive |= bit;
    if (winding < 0) result.negative |= bit;
  }
  return result;
}

/// Returns depth_range() of one of the lanes.
HWY_NOINLINE static HWY_MAYBE_UNUSED DepthRange depth_range_of(const SeenCorners& seen,
                                                               size_t lane) {
  alignas(64) double x[3][kLanes], y[3][kLanes], depth[3][kLanes];
  for (size_t corner = 0; corner < 3; ++corner) {
    hn::Store(seen.x[corner], Wide(), x[corner]);
    hn::Store(seen.y[corner], Wide(), y[corner]);
    hn::Store(seen.depth[corner], Wide(), depth[corner]);
  }
  return depth_range({{x[0][lane], y[0][lane]}, {x[1][lane], y[1][lane]}, {x[2][lane], y[2][lane]}},
                     {depth[0][lane], depth[1][lane], depth[2][lane]});
}

/// Adds the crossings of the triangle.
HWY_INLINE void cross_triangle(const TriangleMesh& mesh, uint32_t index, LaneMask lanes,
                               int longest, PacketRays& rays, CrossingSearch& search) {
  const TriangleMesh::Triangle& triangle = mesh.triangles()[index];
  for (const int c : ChunksOf(lanes)) {
    const SeenCorners seen = seen_corners(mesh, triangle, rays, longest, first_lane(c));
    const Windings windings = windings_of(seen, lanes, c);
    LaneMask passing = windings.positive | windings.negative;
    if (passing == 0) continue;
    const TriangleMesh::Plane& plane = mesh.planes()[index];
    for (; passing != 0; passing &= passing - 1) {
      const uint32_t lane = static_cast<uint32_t>(std::countr_zero(passing));
      const Vec3 origin{rays.origin[0][lane], rays.origin[1][lane], rays.origin[2][lane]};
      const Vec3 direction{rays.direction[0][lane], rays.direction[1][lane],
                           rays.direction[2][lane]};
      const double inverse = rays.inverse[lane];
      const double growth = glm::dot(plane.normal, direction);
      double t = (plane.offset - glm::dot(plane.normal, origin)) / growth;
      if (!(growth * growth >= rays.least_growth2[lane])) {
        const DepthRange range = depth_range_of(seen, lane - first_lane(c));
        const double a = range.nearest * inverse, b = range.furthest * inverse;
        t = std::isnan(t) ? a : std::clamp(t, std::min(a, b), std::max(a, b));
      }
      // A triangle is seen from outside if its corners are counterclockwise against the ray.
      const bool leaves = (windings.positive >> lane & 1) == (inverse > 0 ? 1u : 0u);
      const double last_t = search.add(lane, {rays.base[lane] + t, index, leaves ? -1 : 1});
      rays.last_t[lane] = float_above(last_t - rays.base[lane]);
    }
  }
}

HWY_NOINLINE static HWY_MAYBE_UNUSED void trace(const TriangleMesh& mesh, LaneMask lanes,
                                                int longest, PacketRays& rays,
                                                CrossingSearch& search) {
  const std::span<const TriangleMesh::Node> nodes = mesh.nodes();
  const bool downwards = rays.direction[longest][std::countr_zero(lanes)] < 0;
  std::vector<CrossingSearch::Visit>& stack = search.stack;
  stack.assign(1, {0, lanes});
  while (!stack.empty()) {
    const CrossingSearch::Visit visit = stack.back();
    stack.pop_back();
    const TriangleMesh::Node& node = nodes[visit.node];
    const LaneMask through = lanes_through(node, rays, visit.lanes);
    if (through == 0) continue;
    if (node.count == 0) {
      const size_t axis = static_cast<size_t>(longest);
      const TriangleMesh::Node& below = nodes[node.first];
      const TriangleMesh::Node& above = nodes[node.first + 1];
      const bool is_first_nearer =
          (below.min[axis] + below.max[axis] <= above.min[axis] + above.max[axis]) != downwards;
      stack.push_back({node.first + (is_first_nearer ? 1 : 0), through});
      stack.push_back({node.first + (is_first_nearer ? 0 : 1), through});
      continue;
    }
    for (uint32_t i = node.first; i < node.first + node.count; ++i) {
      cross_triangle(mesh, i, through, longest, rays, search);
    }
  }
}

}  // namespace mesh_rays

/// See kind_crossings-inl.hpp.
struct MeshCrossings {
  static constexpr bool kFindsAll = false;

  static void find(const FrameRays& frame, const RayPacket& packet, LaneMask lanes,
                   const CanonicalPrimitive& primitive, CrossingSearch& search) {
    mesh_rays::PacketRays rays;
    for (LaneMask left = mesh_rays::enter_canonical(frame, packet, lanes, primitive, rays);
         left != 0;) {
      const int longest =
          mesh_rays::longest_axis(rays, static_cast<uint32_t>(std::countr_zero(left)));
      LaneMask alike = 0;
      for (LaneMask others = left; others != 0; others &= others - 1) {
        const uint32_t lane = static_cast<uint32_t>(std::countr_zero(others));
        if (mesh_rays::longest_axis(rays, lane) == longest) alike |= LaneMask{1} << lane;
      }
      left &= ~alike;
      mesh_rays::prepare(search, alike, longest, rays);
      mesh_rays::trace(*primitive.mesh(), alike, longest, rays, search);
    }
  }

  static bool is_closed(const CanonicalPrimitive& primitive) {
    return primitive.mesh()->is_closed();
  }

  static Vec3 normal(const CanonicalPrimitive& primitive, uint32_t face, const Vec3&) {
    return primitive.mesh()->planes()[face].normal * primitive.world_to_canonical;
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace csgcore
HWY_AFTER_NAMESPACE();

#endif  // include guard
