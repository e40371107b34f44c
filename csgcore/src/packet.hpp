// A packet of rays, and what is traced with it: the evaluation that tiles and kd cells share.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <stop_token>
#include <vector>

#include "cell_list.hpp"
#include "csgcore/canonical_primitive.hpp"
#include "csgcore/phong.hpp"
#include "csgcore/tracer.hpp"
#include "csgcore/view.hpp"
#include "extent_tests.hpp"
#include "list_expression.hpp"

namespace csgcore {

struct ScreenOutline;

/// Rays in a packet, on every machine: nothing that bears results depends on the vectors' width.
constexpr uint32_t kPacketRays = 32;
/// Where a packet is a block of pixels, its sides. Lane = 8·row + column.
constexpr uint32_t kPacketWidth_px = 8;
constexpr uint32_t kPacketHeight_px = 4;
static_assert(kPacketWidth_px * kPacketHeight_px == kPacketRays);

using LaneMask = uint32_t;  // bit i: lane i
constexpr LaneMask kAllLanes = 0xFFFFFFFFu;

/// The rays of one view, re-based near the model (NUMERICS.md, "Rays"): x(τ) = pivot + o + τ·d with
/// d the direction of pixel_ray, s = base_s + τ, and o small where the model is, however far away
/// the eye.
struct FrameRays {
  View view;
  double base_s = 0;  // of 26 bits, so that its products with half a direction are exact
  Vec3 pivot{0.0};
  /// What lies further on is seen: in perspective from the tolerance beyond the eye on (an eye in a
  /// face is not torn between its sides by rounding), everything in orthographic views.
  double first_t = 0;

  /// pixel_ray's u and v of a point of the picture, in pixels.
  double u(double x_px) const {
    return (2 * (x_px + 0.5) - view.width_px) / view.height_px * view.half_height;
  }
  double v(double y_px) const {
    return (view.height_px - 2 * (y_px + 0.5)) / view.height_px * view.half_height;
  }
  /// Of the pixels' centres, and of kBeyond_px beyond the picture: packets are filled, and read in
  /// whole vectors.
  static constexpr uint32_t kBeyond_px = 2 * kPacketWidth_px;
  std::vector<double> u_of_column, v_of_row;
};
FrameRays frame_rays(const View& view, const Box& solid_bounds);

/// o, d and 1/d·d of each lane, in the units of the world, by coordinate.
struct alignas(64) RayPacket {
  double origin[3][kPacketRays];
  double direction[3][kPacketRays];
  double inverse_length2[kPacketRays];
};

/// Where a primitive's surface cuts the rays: start < end in τ, or +∞ and −∞; and what the normal
/// there is asked for with: of a frustum, whether that end lies on a cap; of a polyhedron, whether
/// the ray leaves there.
struct alignas(64) PacketSegments {
  double start[kPacketRays];
  double end[kPacketRays];
  LaneMask start_on_cap = 0;
  LaneMask end_on_cap = 0;
};

/// What is to be traced: a list, and what is known about its literals.
struct TraceList {
  const CanonicalPrimitive* primitives = nullptr;
  const CellList* list = nullptr;
  /// By index in the list: no crossing of the primitive lies at a smaller τ.
  const double* nearest_t = nullptr;
  double earliest_t = 0;  // the least of them
  /// By index in the list: the lanes that may meet the primitive. None: nobody knows.
  const LaneMask* reached = nullptr;
};

/// What the solid is, beyond its list.
struct TraceSubject {
  double thinnest_piece = 0;
  Boundary boundary = Boundary::kFirst;
  std::stop_token stop{};
};

/// By lane, what becomes of an operand at crossings that coincide: see list_expression.hpp.
struct alignas(64) PacketStates {
  int32_t lane[kPacketRays];
};

/// Working memory of one thread, for packets of one list after the other.
struct PacketWorkspace {
  // By index in the list:
  std::vector<PacketSegments> segments;
  std::vector<LaneMask> computed;     // lanes whose segments are known
  std::vector<LaneMask> reached;      // TraceList::reached
  std::vector<LaneMask> apart;        // lanes that stand away from it
  std::vector<LaneMask> standing;     // of an evaluation, by a literal's number
  std::vector<uint8_t> was_computed;  // for any packet of the list; empty: nobody wants to know
  uint64_t rays = 0;                  // traced along their whole length
  uint64_t intersections = 0;         // of rays with primitives
  uint64_t resolved_rays = 0;

  // What coincident crossings are told with:
  ListExpression expression;
  std::vector<PacketStates> states;  // a stack
  // The resolver's.
  struct Event {
    double t;
    uint32_t index;  // in the list
    bool at_end;
  };
  std::vector<Event> events, changed;
  std::vector<uint8_t> inside;  // by index in the list
  std::vector<uint32_t> repeats, order;
  std::vector<uint8_t> is_first;
  std::vector<uint8_t> has_changed;  // by index in the list
  std::vector<int32_t> operands;     // a stack
};

/// Per lane. Only lanes of `hits` hold anything.
struct alignas(64) PacketHits {
  LaneMask hits = 0;
  /// Lanes whose hit the range alone cannot decide; only from trace_packet_in_range.
  LaneMask undecided = 0;
  LaneMask on_cap = 0;      // the hit is on a flat face
  LaneMask eye_inside = 0;  // of all lanes that were traced: the solid holds at the eye
  alignas(64) double t[kPacketRays];
  double normal[3][kPacketRays];  // unit, outward of the solid
  uint32_t index[kPacketRays];    // of the literal in the list
};

/// The part of each ray that a list is valid for: hits are wanted with enter < t ≤ leave.
struct alignas(64) PacketRange {
  double enter[kPacketRays];
  double leave[kPacketRays];
  double margin;  // the list is valid so far beyond, in world units
};

/// Where rays go: the directions' parts along the view's right and up.
struct alignas(64) PacketLaterals {
  double u[kPacketRays];
  double v[kPacketRays];
};
void make_rays(const FrameRays& frame, const PacketLaterals& laterals, RayPacket& rays);
/// Of the first four lanes alone, at an eighth of the cost.
void make_four_rays(const FrameRays& frame, const PacketLaterals& laterals, RayPacket& rays);
/// Through the centres of the pixels of the block from (x, y) on.
void make_block_rays(const FrameRays& frame, uint32_t x, uint32_t y, RayPacket& rays);

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

/// Of the primitives (indices, the top bit ignored), the lanes that may meet them in the block from
/// the pixel (x, y) on and in that below it, by their extents on the screen, which are no nan, and
/// the outlines of those whose inside2 < 0. Of rays through pixels' centres only.
void find_reached(const Extent* screen, const ScreenOutline* outlines,
                  std::span<const uint32_t> primitives, uint32_t x, uint32_t y, LaneMask* above,
                  LaneMask* below);

/// The lanes that certainly lie, at τ = t, further than `distance` (world units) away from the
/// primitive, or, of a polyhedron, from what encloses it; told in float (NUMERICS.md,
/// "Classification and culling"). Polyhedra and what is no true ball only.
LaneMask find_apart(const FrameRays& frame, const RayPacket& rays,
                    const CanonicalPrimitive& primitive, const double (&t)[kPacketRays],
                    double distance);

/// 1/d of each lane, +∞ for 0, by coordinate.
struct alignas(64) PacketInverses {
  double inverse[3][kPacketRays];
};
void invert_directions(const RayPacket& rays, PacketInverses& inverses);

/// The lanes that go on before and beyond a plane.
struct RangeSplit {
  LaneMask before, beyond;
};
/// Divides ranges at the plane where the coordinate, from the pivot, is `plane`: `range` becomes
/// their parts before it, `far` those beyond it, in the rays' order, which must be the same for all
/// lanes that matter. A ray along the plane is on one side of it for ever.
RangeSplit split_range(const RayPacket& rays, const PacketInverses& inverses, int axis,
                       double plane, PacketRange& range, PacketRange& far);

/// The first hit of each lane in `lanes` along its whole ray.
void trace_packet(const FrameRays& frame, const RayPacket& rays, LaneMask lanes,
                  const TraceList& list, const TraceSubject& subject, PacketWorkspace& workspace,
                  PacketHits& hits);

/// The same within a range. `eye_inside`: the solid's value at the eye, of the lanes in `known`;
/// that of others is the value at their `enter`. Lanes that the range alone cannot decide come back
/// as undecided.
void trace_packet_in_range(const FrameRays& frame, const RayPacket& rays, LaneMask lanes,
                           const PacketRange& range, const TraceList& list,
                           const TraceSubject& subject, LaneMask known, LaneMask eye_inside,
                           PacketWorkspace& workspace, PacketHits& hits);

/// How hits turn into colours.
struct ShadeSettings {
  Shading shading = Shading::kOpenScad;
  Vec3 light_world{0.0};  // kOpenScad: shade = 0.2 + |n · light_world|
  PhongLight phong;
  glm::dvec3 front{1.0}, back{1.0};  // 0…255
};
ShadeSettings shade_settings(const FrameSettings& settings, const View& view,
                             const Box& solid_bounds);

/// Each 0…255, not rounded.
struct alignas(64) PacketColors {
  double rgb[3][kPacketRays];
};
void shade_packet(const ShadeSettings& settings, const FrameRays& frame, const RayPacket& rays,
                  const TraceList& list, const PacketHits& hits, PacketColors& colors);

using Rgb8 = std::array<uint8_t, 3>;
struct PacketPixels {
  Rgb8 rgb[kPacketRays];
};
/// The colours of `lanes`, rounded; that of the others is given.
void round_colors(const PacketColors& colors, LaneMask lanes, const Rgb8& others,
                  PacketPixels& pixels);

}  // namespace csgcore
