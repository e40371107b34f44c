// Tests the rays of packets, and their crossings with primitives, against extended precision.
#include "packets/packet.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "checks.hpp"
#include "placements.hpp"
#include "primitives/intersect.hpp"
#include "rays/frame_rays.hpp"
#include "screen/screen_slab.hpp"
#include "simd_levels.hpp"
#include "special_rays.hpp"
#include "support/full_run.hpp"
#include "support/models.hpp"
#include "support/reference_primitive.hpp"

namespace csgcore {
namespace {

using checks::kMapKinds;
using checks::kPlacements;
using checks::LongMat3;
using checks::LongRay;
using checks::LongVec3;
using checks::MapKind;
using checks::PivotRay;
using checks::Placement;
using checks::RayKind;
using checks::RayOracle;
using checks::Real;
using checks::uniform;
using test_support::Variant;

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

// --- Rays ---

/// Returns a view from `distance` away that shows `size` around `center`.
View random_view(std::mt19937& random, const Vec3& center, double distance, double size) {
  View view = checks::view_of({center, center}, checks::random_direction(random), distance);
  view.projection = random() % 2 ? Projection::kOrthographic : Projection::kPerspective;
  view.half_height = view.projection == Projection::kPerspective ? size / distance : size;
  view.width_px = 64;
  view.height_px = 48;
  return view;
}

struct Packet {
  Ray exact[kPacketRays];  // as pixel_ray gives them
  RayPacket rays;
};
Packet random_packet(std::mt19937& random, const FrameRays& frame) {
  Packet packet;
  PacketLaterals laterals;
  for (uint32_t lane = 0; lane < kPacketRays; ++lane) {
    const double x = uniform(random, -0.5, frame.view.width_px - 0.5);
    const double y = std::floor(uniform(random, 0, frame.view.height_px));
    laterals.u[lane] = frame.u(x);
    laterals.v[lane] = frame.v(y);
    packet.exact[lane] = pixel_ray(frame.view, x, y);
  }
  make_rays(frame, laterals, packet.rays);
  return packet;
}

Vec3 lane_of(const double (&v)[3][kPacketRays], uint32_t lane) {
  return {v[0][lane], v[1][lane], v[2][lane]};
}

/// Returns x(base_s) − pivot, exact whatever cancels.
LongVec3 exact_origin(const FrameRays& frame, const Ray& ray) {
  return reference::exact_offset(ray.origin, frame.base_s, ray.direction, frame.pivot);
}

/// The derived bound (NUMERICS.md): two roundings of the result, and two of the remainders of the
/// split products, which are 2^-26 of the distance.
TEST(MakeRays, ArePixelRaysWithTheirOriginsNearTheModel) {
  std::mt19937 random(1);
  for (int round = 0; round < 2000; ++round) {
    const double distance = std::pow(10, uniform(random, -1, 12));
    const double from_origin = round % 3 == 0 ? 0 : std::pow(10, uniform(random, -3, 12));
    const Vec3 center = from_origin * checks::random_direction(random);
    const View view = random_view(random, center, distance, std::pow(10, uniform(random, -3, 3)));
    const FrameRays frame = frame_rays(view, {center - Vec3(1.0), center + Vec3(1.0)});
    const Packet packet = random_packet(random, frame);
    for (uint32_t lane = 0; lane < kPacketRays; ++lane) {
      const Ray& exact = packet.exact[lane];
      const Vec3 direction = lane_of(packet.rays.direction, lane);
      ASSERT_EQ(direction, exact.direction);
      ASSERT_EQ(packet.rays.inverse_length2[lane], 1 / glm::dot(direction, direction));
      const LongVec3 origin = exact_origin(frame, exact);
      for (int axis = 0; axis < 3; ++axis) {
        const Real error = std::abs(packet.rays.origin[axis][lane] - origin[axis]);
        const Real low_parts = 0x1p-26L * std::abs(frame.base_s * direction[axis]);
        ASSERT_LE(error, Real(kEpsilon) * (std::abs(origin[axis]) + low_parts))
            << "distance " << distance << ", axis " << axis;
      }
    }
  }
}

/// The pivot is at the depth of the box's centre, up to base_s's 26 bits, and on the view's axis,
/// about which directions are exact.
TEST(FrameRays, PutThePivotAtTheModelsDepth) {
  std::mt19937 random(2);
  for (int round = 0; round < 1000; ++round) {
    const double distance = std::pow(10, uniform(random, -3, 12));
    const Vec3 center = 100.0 * checks::random_direction(random);
    View view = random_view(random, center, distance, 1);
    view.eye += 0.1 * distance * view.right;
    const Box bounds{center - Vec3(1.0), center + Vec3(1.0)};
    const FrameRays frame = frame_rays(view, bounds);
    int exponent = 0;
    const double mantissa = std::frexp(frame.base_s, &exponent);
    ASSERT_EQ(std::ldexp(mantissa, 26), std::round(std::ldexp(mantissa, 26)));
    const double rounding = 4 * kEpsilon * (distance + 100);
    ASSERT_LE(std::abs(frame.base_s - distance), 0x1p-26 * distance + rounding);
    ASSERT_LE(glm::length(frame.pivot - (view.eye + frame.base_s * view.forward)), rounding);
    // Nothing is seen up to the tolerance beyond the eye.
    const bool is_perspective = view.projection == Projection::kPerspective;
    const double nearest = thickness_tolerance(bounds) - frame.base_s;
    ASSERT_EQ(frame.first_t, is_perspective ? nearest : -std::numeric_limits<double>::max());
  }
}

// --- Crossings ---

/// Lengths are often exact in few bits, so that rays are exactly in a cap's plane.
constexpr test_support::SizeRange kSizes{
    .low = 0.5, .high = 2, .even_share = 0.6, .step = 0.25, .most_fragments = 12};

/// A primitive with rays about it.
struct Target {
  Primitive primitive;
  FrameRays frame;
  CanonicalPrimitive canonical;

  Target(const Variant& variant, const Placement& placement, MapKind map, std::mt19937& random) {
    test_support::Sizes sizes(random, kSizes);
    primitive = variant.make(sizes);
    frame.pivot = placement.from_world * checks::random_direction(random);
    primitive.local_to_world = checks::placed(placement, map, frame.pivot, random);
    canonical = canonicalize(primitive);
  }
};

const Variant& variant_of(size_t number) {
  const std::vector<Variant>& variants = test_support::convex_variants();
  return variants[number % variants.size()];
}

/// Calls back with a Target of every convex variant, map and place, several times in a full run.
/// mesh_crossings_test.cpp has the others.
template <typename Visit>
void for_each_target(std::mt19937& random, Visit&& visit) {
  const std::vector<Variant>& variants = test_support::convex_variants();
  const int rounds = test_support::full_run() ? 20 : 1;
  for (int round = 0; round < rounds; ++round) {
    for (const Placement& placement : kPlacements) {
      for (int map = 0; map < kMapKinds; ++map) {
        for (size_t i = 0; i < variants.size(); ++i) {
          if (test_support::does_less() && (size_t(map) + i) % 3 != 0) continue;
          const Variant& variant = variants[i];
          SCOPED_TRACE(variant.name);
          visit(Target(variant, placement, static_cast<MapKind>(map), random), placement);
          if (testing::Test::HasFailure()) return;
        }
      }
    }
  }
}

class CrossingsOf : public testing::TestWithParam<int> {};

TEST_P(CrossingsOf, RaysAreThoseOfExtendedPrecision) {
  const RayKind kind = static_cast<RayKind>(GetParam());
  std::mt19937 random(3);
  double worst = 0;
  int crossed = 0;
  for_each_target(random, [&](const Target& target, const Placement& placement) {
    SCOPED_TRACE(placement.name);
    ASSERT_TRUE(is_valid(target.primitive));
    const RayOracle oracle(target.primitive, target.frame.pivot);
    checks::SpecialRays rays(target.primitive, target.frame.pivot, random);
    const std::vector<PivotRay> lanes = rays.next(kind);
    PacketSegments segments;
    intersect(target.frame, checks::packet_of(lanes), target.canonical, segments);
    for (uint32_t lane = 0; lane < kPacketRays; ++lane) {
      const double start = segments.start[lane], end = segments.end[lane];
      worst = std::max(worst, oracle.expect_segment(lanes[lane], start, end));
      crossed += start < end;
    }
  });
  EXPECT_GT(crossed, 1000);
  std::printf("%d crossed; the worst is off by %.2f roundings\n", crossed,
              worst * checks::kRoundings);
}

INSTANTIATE_TEST_SUITE_P(Packets, CrossingsOf, testing::Range(0, checks::kRayKinds),
                         [](const testing::TestParamInfo<int>& kind) {
                           return checks::name_of(static_cast<RayKind>(kind.param));
                         });

/// The eye's distance has no cost up to 2^26 sizes; beyond that it moves the pivot away.
TEST(Crossings, AreAsExactFromFarAway) {
  std::mt19937 random(4);
  for (const double distance : {3.0, 1e2, 1e4, 1e7, 1e8, 1e9, 1e10, 1e12}) {
    double worst = 0;  // as a share of the model's size
    int crossed = 0;
    for (int round = 0; round < (test_support::full_run() ? 2000 : 100); ++round) {
      const Placement placement{"", 1, uniform(random, 0, 1), 0};
      Target target(variant_of(static_cast<size_t>(round)), placement, MapKind::kTurned, random);
      const Box& bounds = target.canonical.bounds;
      const double size = bounds.diagonal();
      const View view = random_view(random, bounds.center(), distance * size, size / 2);
      target.frame = frame_rays(view, bounds);
      const Packet packet = random_packet(random, target.frame);
      PacketSegments segments;
      intersect(target.frame, packet.rays, target.canonical, segments);
      const RayOracle oracle(target.primitive, target.frame.pivot);
      for (uint32_t lane = 0; lane < kPacketRays; ++lane) {
        const Ray& exact = packet.exact[lane];
        const LongRay ray{exact_origin(target.frame, exact), LongVec3(exact.direction)};
        const double share = oracle.expect_segment(ray, segments.start[lane], segments.end[lane]);
        const double bound = static_cast<double>(oracle.error_bound(ray)) / size;
        if (distance <= 1e7) {
          ASSERT_LE(bound, 1e-14);
        }
        worst = std::max(worst, share * bound);
        crossed += segments.start[lane] < segments.end[lane];
      }
      if (HasFailure()) return;
    }
    EXPECT_GT(crossed, 200);
    std::printf("from %g sizes away: surfaces displaced by up to %.1e of the size\n", distance,
                worst);
  }
}

/// Returns how far a point, relative to the pivot, is outside of a primitive's enclosure, in
/// canonical space; negative inside.
Real canonical_gap(const Target& target, const LongVec3& point) {
  const CanonicalPrimitive& primitive = target.canonical;
  const LongVec3 center = LongVec3(primitive.center) - LongVec3(target.frame.pivot);
  const LongVec3 p = LongMat3(primitive.world_to_canonical) * (point - center);
  if (primitive.enclosure == Shape::kSphere) return glm::length(p) - 1;
  const Real slope = primitive.radius_slope;
  const Real radius = std::max<Real>(primitive.radius_mid + slope * p.z, 0);
  const Real wall = (std::hypot(p.x, p.y) - radius) / (1 + std::abs(slope));
  return std::max(std::abs(p.z) - 1, wall);
}

/// In units of the tested distance: a primitive that is found to be disjoint is so in extended
/// precision, and one that is four times as far away, within float's precision, is found.
TEST(Apart, IsWhoIsFurtherAway) {
  std::mt19937 random(6);
  int told = 0;
  for_each_target(random, [&](const Target& target, const Placement& placement) {
    if (target.canonical.ball_radius > 0) return;
    SCOPED_TRACE(placement.name);
    const double distance = placement.size * std::pow(10, uniform(random, -9, 0));
    checks::SpecialRays rays(target.primitive, target.frame.pivot, random);
    const std::vector<PivotRay> lanes =
        rays.next(static_cast<RayKind>(random() % checks::kRayKinds));
    const RayPacket packet = checks::packet_of(lanes);
    PacketSegments segments;
    intersect(target.frame, packet, target.canonical, segments);
    double t[kPacketRays];
    for (uint32_t lane = 0; lane < kPacketRays; ++lane) {
      const bool crosses = segments.start[lane] < segments.end[lane];
      const double step = std::exp(uniform(random, -3, 6)) * distance;
      t[lane] = (crosses ? segments.start[lane] : 0) - step / glm::length(lanes[lane].direction);
    }
    const LaneMask apart = find_apart(target.frame, packet, target.canonical, t, distance);
    const double reach = distance * target.canonical.canonical_stretch;
    for (uint32_t lane = 0; lane < kPacketRays; ++lane) {
      const bool is_told = (apart >> lane & 1) != 0;
      const LongVec3 point = LongRay(lanes[lane]).at(t[lane]);
      const Real gap = canonical_gap(target, point) / reach;
      told += is_told;
      if (is_told) {
        // Rays that start far from the pivot are rounded on their way.
        const Real rounding = 4 * kEpsilon * glm::length(lanes[lane].origin) / distance;
        ASSERT_GE(gap + rounding, 1) << "distance " << distance;
      }
      const Vec3 center = target.canonical.center - target.frame.pivot;
      const double furthest = 1e5 * distance;
      const bool is_near = glm::length(center) < furthest && glm::length(point) < furthest;
      if (is_near && reach > 1e-5) {
        ASSERT_TRUE(is_told || gap < 4) << gap;
      }
    }
  });
  EXPECT_GT(told, test_support::does_less() ? 300 : 1000);
}

/// The list of one primitive.
struct SingleList {
  CellList cells;
  double nearest_t = -std::numeric_limits<double>::max();
  TraceList trace;

  SingleList(const CanonicalPrimitive& primitive, bool complement) {
    const BlistTest test{0, complement, complement ? kListFalse : kListTrue,
                         complement ? kListTrue : kListFalse};
    assign(cells, std::span(&test, 1));
    trace.primitives = &primitive;
    trace.list = &cells;
    trace.nearest_t = &nearest_t;
    trace.earliest_t = nearest_t;
  }
};

FrameRays from_infinity(FrameRays frame) {
  frame.first_t = -std::numeric_limits<double>::max();
  return frame;
}

TEST(Hits, AreWhereSegmentsStartWithTheNormalsThere) {
  std::mt19937 random(5);
  for_each_target(random, [&](const Target& target, const Placement& placement) {
    SCOPED_TRACE(placement.name);
    const RayOracle oracle(target.primitive, target.frame.pivot);
    checks::SpecialRays rays(target.primitive, target.frame.pivot, random);
    const std::vector<PivotRay> lanes =
        rays.next(static_cast<RayKind>(random() % checks::kRayKinds));
    const RayPacket packet = checks::packet_of(lanes);
    PacketSegments segments;
    intersect(target.frame, packet, target.canonical, segments);
    const SingleList list(target.canonical, false);
    PacketWorkspace workspace;
    PacketHits hits;
    trace_packet(from_infinity(target.frame), packet, kAllLanes, list.trace, TraceParameters{},
                 nullptr, workspace, hits);
    for (uint32_t lane = 0; lane < kPacketRays; ++lane) {
      const bool crosses = segments.start[lane] < segments.end[lane];
      ASSERT_EQ((hits.hits >> lane & 1) != 0, crosses);
      if (!crosses) continue;
      ASSERT_EQ(hits.t[lane], segments.start[lane]);
      const LongVec3 point = LongRay(lanes[lane]).at(hits.t[lane]);
      oracle.expect_normal(point, lane_of(hits.normal, lane), oracle.error_bound(lanes[lane]));
    }
  });
}

/// Rays, 4e-5 from the first to the last, straight down onto a plate with a pocket whose wall is
/// `aside` of them. Only some rays may reach the pocket.
struct PocketTrace {
  uint64_t intersections;
  double z[kPacketRays];
};
PocketTrace trace_beside_a_pocket(double aside, LaneMask may_reach = kAllLanes) {
  const CanonicalPrimitive primitives[] = {
      canonicalize(make_frustum(-1, 1, 10, 10)),
      canonicalize(make_frustum(0, 5, 1, 1, {Mat3{1.0}, {0, 1 + aside, 0}}))};
  const BlistTest tests[] = {{0, 0, 1, kListFalse}, {1, 1, kListFalse, kListTrue}};
  CellList cells;
  assign(cells, tests);
  View view;
  view.projection = Projection::kOrthographic;
  view.eye = {0, 0, 20};
  view.forward = {0, 0, -1};
  view.right = {1, 0, 0};
  view.up = {0, 1, 0};
  view.half_height = 5e-4;
  view.width_px = view.height_px = 100;
  const FrameRays frame = frame_rays(view, primitives[0].bounds);
  RayPacket rays;
  make_block_rays(frame, 48, 48, rays);
  const double nearest_t[] = {-20, -20};
  TraceList list;
  list.primitives = primitives;
  list.list = &cells;
  list.nearest_t = nearest_t;
  list.earliest_t = -20;
  const LaneMask reached[] = {may_reach, kAllLanes};  // the last test is evaluated first
  list.reached = reached;
  TraceParameters parameters;
  parameters.thickness_tolerance = 1e-9;
  PacketWorkspace workspace;
  PacketHits hits;
  trace_packet(frame, rays, kAllLanes, list, parameters, nullptr, workspace, hits);
  EXPECT_EQ(hits.hits, kAllLanes);
  PocketTrace trace{workspace.intersections, {}};
  for (uint32_t lane = 0; lane < kPacketRays; ++lane) {
    trace.z[lane] = view.eye.z - (frame.base_s + hits.t[lane]);
  }
  return trace;
}

TEST(Hits, DoNotIntersectWhatTheyLieBeside) {
  const auto expect = [](double aside, uint64_t intersections, double z) {
    const PocketTrace trace = trace_beside_a_pocket(aside);
    EXPECT_EQ(trace.intersections, intersections);
    EXPECT_NEAR(trace.z[0], z, 1e-12);
  };
  expect(0.1, kPacketRays, 1);
  // The rays are almost on the pocket's wall, and inside it.
  expect(3e-5, 2 * kPacketRays, 1);
  expect(-0.1, 2 * kPacketRays, 0);
}

TEST(Hits, IntersectLanesThatMayMeetOnly) {
  checks::for_each_simd_level([](SimdLevel level) {
    SCOPED_TRACE(checks::name_of(level));
    const LaneMask may_reach = 1u << 1 | 1u << 6 | 1u << 31;
    const PocketTrace trace = trace_beside_a_pocket(-0.1, may_reach);
    EXPECT_EQ(trace.intersections, kPacketRays + 3 * 4);  // four lanes at a time
    for (uint32_t lane = 0; lane < kPacketRays; ++lane) {
      EXPECT_NEAR(trace.z[lane], may_reach >> lane & 1 ? 0 : 1, 1e-12) << lane;
    }
  });
}

TEST(FindReached, TellsThePixelsOfTwoBlocks) {
  std::mt19937 random(12);
  const uint32_t x = 40, y = 24;
  std::vector<Extent> extents;
  std::vector<ScreenSlab> slabs;
  std::vector<uint32_t> primitives;
  const auto add = [&](double low_x, double high_x, double low_y, double high_y) {
    const double half[] = {0.5 * (high_x - low_x), 0.5 * (high_y - low_y), 0};
    extents.push_back(
        {{low_x + half[0], low_y + half[1], 0}, {half[0], half[1], half[2]}, kInfinity, 0});
    slabs.push_back({});
    primitives.push_back(static_cast<uint32_t>(primitives.size()) | CellList::kComplementBit);
  };
  add(-1e6, 1e6, -1e6, 1e6);
  add(x, x, y, y);
  add(x + 7, 1e6, y + 7, 1e6);
  add(-1e6, x - 1, y, y + 7);
  add(x, x + 7, y + 8, 1e6);
  for (int i = 0; i < 2000; ++i) {
    const double from_x = std::floor(uniform(random, x - 10, x + 10));
    const double from_y = std::floor(uniform(random, y - 10, y + 10));
    add(from_x, from_x + std::floor(uniform(random, 0, 12)), from_y,
        from_y + std::floor(uniform(random, 0, 12)));
    if (i % 2 == 0) continue;
    extents.back().inside2 = -1;
    for (const int line : {0, 1}) {
      const double angle = uniform(random, 0, 7), at = uniform(random, -3, 8);
      const double along[] = {std::cos(angle), std::sin(angle)};
      slabs.back().x[line] = static_cast<float>(along[0]);
      slabs.back().y[line] = static_cast<float>(along[1]);
      slabs.back().limit[line] =
          i % 8 == 1 && line == 0
              ? std::numeric_limits<float>::infinity()
              : static_cast<float>(along[0] * (x + 4) + along[1] * (y + 4) + at);
    }
  }
  // Returns how far a pixel is beyond the lines.
  const auto beyond = [&](size_t i, double pixel_x, double pixel_y) {
    double furthest = -kInfinity;
    for (const int line : {0, 1}) {
      const ScreenSlab& slab = slabs[i];
      furthest =
          std::max(furthest, slab.x[line] * pixel_x + slab.y[line] * pixel_y - slab.limit[line]);
    }
    return extents[i].inside2 < 0 ? furthest : -kInfinity;
  };
  const auto holds = [](const Extent& extent, double pixel_x, double pixel_y) {
    return std::abs(pixel_x - extent.center[0]) <= extent.half[0] &&
           std::abs(pixel_y - extent.center[1]) <= extent.half[1];
  };
  checks::for_each_simd_level([&](SimdLevel level) {
    SCOPED_TRACE(checks::name_of(level));
    std::vector<LaneMask> blocks[2];
    for (auto& block : blocks) block.resize(primitives.size());
    find_reached(extents.data(), slabs.data(), primitives, x, y, blocks[0].data(),
                 blocks[1].data());
    for (size_t i = 0; i < extents.size(); ++i) {
      for (uint32_t lane = 0; lane < 2 * kPacketRays; ++lane) {
        const LaneMask lanes = blocks[lane / kPacketRays][i];
        const double pixel[] = {static_cast<double>(x + lane % kPacketWidth_px),
                                static_cast<double>(y + lane / kPacketWidth_px)};
        const double past = beyond(i, pixel[0], pixel[1]);
        if (std::abs(past) < 1e-4) continue;  // within float's error
        ASSERT_EQ((lanes >> lane % kPacketRays & 1) != 0,
                  holds(extents[i], pixel[0], pixel[1]) && past < 0)
            << i << ' ' << lane;
      }
    }
  });
}

// --- Instruction sets ---

/// Collects all bytes that a packet's functions give for the same input.
class Bytes {
 public:
  template <typename T>
  void add(const T* values, size_t count) {
    const auto* first = reinterpret_cast<const uint8_t*>(values);
    bytes_.insert(bytes_.end(), first, first + count * sizeof(T));
  }
  bool operator==(const Bytes&) const = default;

 private:
  std::vector<uint8_t> bytes_;
};

Bytes bytes_of_all() {
  std::mt19937 random(6);
  Bytes bytes;
  for (int round = 0; round < 1000; ++round) {
    const Placement& placement = kPlacements[random() % std::size(kPlacements)];
    const std::vector<Variant>& variants = test_support::all_variants();
    const Target target(variants[random() % variants.size()], placement,
                        static_cast<MapKind>(random() % kMapKinds), random);
    checks::SpecialRays rays(target.primitive, target.frame.pivot, random);
    const RayPacket special =
        checks::packet_of(rays.next(static_cast<RayKind>(random() % checks::kRayKinds)));
    const View view =
        random_view(random, target.canonical.center, 100 * placement.size, 2 * placement.size);
    const FrameRays frame = frame_rays(view, target.canonical.bounds);
    const RayPacket made = random_packet(random, frame).rays;
    bytes.add(&made, 1);
    const SingleList list(target.canonical, random() % 2);
    for (const RayPacket* packet : {&special, &made}) {
      const FrameRays& own = packet == &made ? frame : target.frame;
      if (target.canonical.is_convex) {
        PacketSegments segments;
        intersect(own, *packet, target.canonical, segments);
        bytes.add(segments.start, kPacketRays);
        bytes.add(segments.end, kPacketRays);
      } else {
        CrossingSearch search;
        find_all_crossings(own, *packet, target.canonical, search);
        for (const CrossingSearch::Lane& lane : search.lanes) {
          bytes.add(lane.found.data(), lane.found.size());
        }
      }
      PacketWorkspace workspace;
      PacketHits hits;
      trace_packet(from_infinity(own), *packet, kAllLanes, list.trace, TraceParameters{}, nullptr,
                   workspace, hits);
      bytes.add(&hits.hits, 1);
      for (uint32_t lane = 0; lane < kPacketRays; ++lane) {
        if (!(hits.hits >> lane & 1)) continue;
        bytes.add(&hits.t[lane], 1);
        const Vec3 normal = lane_of(hits.normal, lane);
        bytes.add(&normal, 1);
      }
    }
  }
  return bytes;
}

TEST(Packets, EveryInstructionSetGivesTheSameBits) {
  const Bytes expected = bytes_of_all();
  checks::for_each_simd_level(
      [&](SimdLevel level) { EXPECT_EQ(bytes_of_all(), expected) << checks::name_of(level); });
}

}  // namespace
}  // namespace csgcore
