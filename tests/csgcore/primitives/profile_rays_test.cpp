// Tests the rays of extrusions and revolutions, in double, against other primitives and against the
// figures' definition in extended precision.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <numbers>

#include "checks.hpp"
#include "csgcore/csg_tree.hpp"
#include "csgcore/image.hpp"
#include "csgcore/polyhedron.hpp"
#include "csgcore/tracer.hpp"
#include "primitives/intersect.hpp"
#include "profile_figures.hpp"
#include "simd_levels.hpp"
#include "special_rays.hpp"
#include "support/full_run.hpp"

namespace csgcore {
namespace {

using checks::circle;
using checks::LongRay;
using checks::LongVec3;
using checks::PivotRay;
using checks::polygon;
using checks::RayKind;
using checks::Real;
using checks::uniform;
using Kind = ProfileEdge::Kind;

std::shared_ptr<const Profile> filled(const std::vector<ProfileLoop>& loops) {
  return std::make_shared<Profile>(loops, FillRule::kNonZero);
}

struct Crossed {
  CrossingSearch search;
  std::vector<Vec3> normals[kPacketRays];

  Crossed(const Primitive& primitive, const FrameRays& frame, const RayPacket& rays) {
    const CanonicalPrimitive canonical = canonicalize(primitive);
    find_all_crossings(frame, rays, canonical, search);
    find_crossing_normals(frame, rays, canonical, search, normals);
  }
  /// The segments of a lane that have a length.
  std::vector<std::pair<double, double>> segments(uint32_t lane) const {
    std::vector<std::pair<double, double>> result;
    int winding = 0;
    double start = 0;
    for (const Crossing& crossing : search.lanes[lane].found) {
      if (winding == 0) start = crossing.t;
      winding += crossing.turn;
      if (winding == 0 && start < crossing.t) result.emplace_back(start, crossing.t);
    }
    EXPECT_EQ(winding, 0);
    return result;
  }
};

// --- Solids that are other primitives, too ---

struct Pair {
  const char* name;
  Primitive made, known;
};

/// Returns solids of a profile with the primitives that they are.
std::vector<Pair> known_solids(std::mt19937& random) {
  const int arcs = 2 + static_cast<int>(random() % 3);
  const bool turn = random() % 2;
  const double first = random() % 2 ? 0 : uniform(random, 0, 6);
  const double radius = uniform(random, 0.5, 3), low = -uniform(random, 0, 2),
               high = uniform(random, 1, 2);
  const auto disc = filled({circle({0, 0}, radius, arcs, turn, first)});
  const auto beside = filled({circle({3, -1}, radius, arcs, turn, first)});
  Primitive moved = make_frustum(low, high, radius, radius);
  moved.local_to_world.translation = {3, -1, 0};
  const auto ball = filled({{{Kind::kArc, turn, {0, turn ? radius : -radius}, {0, 0}},
                             {Kind::kLine, true, {0, turn ? -radius : radius}, {}}}});
  return {
      {"disc, extruded", make_extrusion(disc, low, high), make_frustum(low, high, radius, radius)},
      {"disc, pointed", make_extrusion(disc, low, high, 0.5, 0),
       make_frustum(low, high, 0.5 * radius, 0)},
      {"disc, widened", make_extrusion(disc, low, high, 0.25, 2),
       make_frustum(low, high, 0.25 * radius, 2 * radius)},
      {"disc beside the axis", make_extrusion(beside, low, high), moved},
      {"rectangle, revolved",
       make_revolution(filled({polygon({{0, low}, {radius, low}, {radius, high}, {0, high}})})),
       make_frustum(low, high, radius, radius)},
      {"triangle, revolved",
       make_revolution(filled({polygon({{0, low}, {radius, low}, {0, high}})})),
       make_frustum(low, high, radius, 0)},
      {"trapezium, revolved",
       make_revolution(filled({polygon({{0, low}, {1, low}, {radius, high}, {0, high}})})),
       make_frustum(low, high, 1, radius)},
      {"half disc, revolved", make_revolution(ball), make_sphere(radius)},
  };
}

Affine random_map(std::mt19937& random) {
  Affine map;
  if (random() % 3 == 0) return map;
  const Vec3 z = checks::random_direction(random);
  const Vec3 x = glm::normalize(glm::cross(z, checks::random_direction(random)));
  map.linear = Mat3{x, glm::cross(z, x), z};
  if (random() % 2) map.linear[1] *= -uniform(random, 0.2, 3);
  map.translation = 3.0 * checks::random_direction(random);
  return map;
}

class KnownSolids : public testing::TestWithParam<int> {};

TEST_P(KnownSolids, AreCrossedWhereTheyAre) {
  const RayKind kind = static_cast<RayKind>(GetParam());
  std::mt19937 random(10);
  double worst = 0;
  uint32_t crossed = 0;
  const uint32_t rounds = test_support::full_run() ? 1000 : test_support::sample_size(60);
  for (uint32_t round = 0; round < rounds; ++round) {
    const Affine map = random_map(random);
    for (Pair& pair : known_solids(random)) {
      SCOPED_TRACE(pair.name);
      pair.made.local_to_world = map;
      pair.known.local_to_world = compose(map, pair.known.local_to_world);
      FrameRays frame;
      frame.pivot = map.translation + checks::random_direction(random);
      const checks::RayOracle oracle(pair.known, frame.pivot);
      checks::SpecialRays rays(pair.known, frame.pivot, random);
      const std::vector<PivotRay> lanes = rays.next(kind);
      const Crossed found(pair.made, frame, checks::packet_of(lanes));
      for (uint32_t lane = 0; lane < kPacketRays; ++lane) {
        const auto segments = found.segments(lane);
        // A ray that touches the surface may leave the solid in between, by a rounding.
        const LongRay ray = lanes[lane];
        for (size_t i = 1; i < segments.size(); ++i) {
          const Real between = (Real(segments[i - 1].second) + segments[i].first) / 2;
          ASSERT_LE(std::abs(oracle.gap(ray.at(between))), oracle.error_bound(ray));
        }
        constexpr double kNone = std::numeric_limits<double>::infinity();
        const double start = segments.empty() ? kNone : segments.front().first;
        const double end = segments.empty() ? -kNone : segments.back().second;
        worst = std::max(worst, oracle.expect_segment(lanes[lane], start, end));
        crossed += !segments.empty();
      }
      if (HasFailure()) return;
    }
  }
  EXPECT_GT(crossed, 16 * rounds);
  std::printf("%u crossed; the worst is off by %.2f roundings\n", crossed,
              worst * checks::kRoundings);
}

INSTANTIATE_TEST_SUITE_P(Profiles, KnownSolids, testing::Range(0, checks::kRayKinds),
                         [](const testing::TestParamInfo<int>& kind) {
                           return checks::name_of(static_cast<RayKind>(kind.param));
                         });

TEST(Extrusions, OfSquaresAreBoxes) {
  std::mt19937 random(11);
  for (int round = 0; round < 300; ++round) {
    const Affine map = random_map(random);
    const Primitive made =
        make_extrusion(filled({polygon({{-1, -2}, {2, -2}, {2, 1}, {-1, 1}})}), -1, 2, 1, 1, map);
    const Primitive box = make_polyhedron(Polyhedron::box({{-1, -2, -1}, {2, 1, 2}}), map);
    std::vector<PivotRay> lanes(kPacketRays);
    for (PivotRay& ray : lanes) {
      ray = {checks::random_point(random, {Vec3(-4.0), Vec3(4.0)}),
             checks::random_direction(random)};
    }
    const FrameRays frame;
    const RayPacket packet = checks::packet_of(lanes);
    const Crossed found(made, frame, packet);
    PacketSegments expected;
    intersect(frame, packet, canonicalize(box), expected);
    for (uint32_t lane = 0; lane < kPacketRays; ++lane) {
      const auto segments = found.segments(lane);
      ASSERT_EQ(!segments.empty(), expected.start[lane] < expected.end[lane]);
      if (segments.empty()) continue;
      EXPECT_NEAR(segments[0].first, expected.start[lane], 1e-13);
      EXPECT_NEAR(segments[0].second, expected.end[lane], 1e-13);
    }
  }
}

// --- Random solids ---

Primitive random_solid(std::mt19937& random, const Affine& map) {
  if (random() % 2) return make_revolution(checks::random_profile(random, true), map);
  const double scales[] = {1, 0, 0.5, 2};
  const double bottom = random() % 2 ? 1 : scales[random() % 4];
  const double top = bottom == 0 ? 1 : random() % 2 ? bottom : scales[random() % 4];
  return make_extrusion(checks::random_profile(random, false), -1, 2, bottom, top, map);
}

/// Makes rays at a solid that are hard on it: through vertices, along edges and faces, tangent,
/// level, upright, in the caps' planes. They are so in local space.
class HardRays {
 public:
  /// How far the point of interest may be, in lengths of the direction.
  static constexpr double kFurthest = 3;

  HardRays(const Primitive& primitive, std::mt19937& random)
      : primitive_(primitive), random_(random) {}

  PivotRay next() {
    const Vec3 point = surface_point();
    Vec3 direction = checks::random_direction(random_);
    switch (random_() % 6) {
      case 0:
        direction = axis();
        break;
      case 1:
        direction.z = random_() % 2 ? 0 : 1e-12;
        break;
      case 2:
        direction = other_ - point;
        break;
      case 3:
        direction = tangent_ + (random_() % 2 ? 0.0 : 0.5) * along_;
        break;
      case 4:
        direction = Vec3{0, 0, 1} + (random_() % 2 ? 1e-9 : 0.0) * direction;
        break;
      default:
        break;
    }
    if (!(glm::length(direction) > 1e-6)) direction = axis();
    const Vec3 origin = point - uniform(random_, 0, kFurthest) * direction;
    return {primitive_.local_to_world.point(origin),
            primitive_.local_to_world.direction(direction)};
  }

 private:
  Vec3 axis() {
    Vec3 result(0.0);
    result[static_cast<int>(random_() % 3)] = random_() % 2 ? 1 : -1;
    return result;
  }
  Vec3 surface_point() {
    const ProfileLoop& loop =
        primitive_.profile()->loops()[random_() % primitive_.profile()->loops().size()];
    const size_t i = random_() % loop.size();
    const Vec2 start = i == 0 ? loop.back().end : loop[i - 1].end;
    const double at = random_() % 2 ? static_cast<double>(random_() % 2) : uniform(random_, 0, 1);
    const checks::EdgePoint edge = checks::edge_point(start, loop[i], at);
    if (primitive_.shape() == Shape::kRevolution) {
      const double angle = random_() % 2 ? 0 : uniform(random_, 0, 6);
      const double c = std::cos(angle), s = std::sin(angle);
      tangent_ = {c * edge.tangent.x, s * edge.tangent.x, edge.tangent.y};
      along_ = {-s, c, 0};
      other_ = {c * start.x, s * start.x, start.y};
      return {c * edge.place.x, s * edge.place.x, edge.place.y};
    }
    const double share =
        random_() % 2 ? static_cast<double>(random_() % 2) : uniform(random_, 0, 1);
    const auto& shape = primitive_.as<ExtrusionShape>();
    const auto at_share = [&shape](const Vec2& p, double u) {
      const double scale = shape.scale_bottom + u * (shape.scale_top - shape.scale_bottom);
      return Vec3{scale * p.x, scale * p.y, shape.z_min + u * (shape.z_max - shape.z_min)};
    };
    tangent_ = {edge.tangent.x, edge.tangent.y, 0};
    along_ = at_share(edge.place, 1) - at_share(edge.place, 0);
    other_ = at_share(start, random_() % 2);
    return at_share(edge.place, share);
  }

  const Primitive& primitive_;
  std::mt19937& random_;
  Vec3 tangent_, along_, other_;
};

/// Whether the solid holds points of a ray, in extended precision.
class Judge {
 public:
  Judge(const Primitive& primitive, const PivotRay& ray) : primitive_(primitive), ray_(ray) {
    to_local_ = glm::inverse(checks::LongMat3(primitive.local_to_world.linear));
  }
  bool holds(const LongVec3& offset, Real t) const {
    return checks::holds_local(primitive_, local(offset, t));
  }
  bool is_at_edge(Real t) const { return checks::is_at_edge(primitive_, local(LongVec3(0), t)); }
  /// Returns whether some point next to that at t is inside, or outside if `inside` is false.
  bool holds_nearby(bool inside, Real t, std::mt19937& random) const {
    constexpr int kPoints = 300;
    constexpr Real kNearby = 1e-10;
    for (int i = 0; i < kPoints; ++i) {
      const Real distance = kNearby * std::pow(Real(10), -(i % 3));
      if (holds(distance * LongVec3(checks::random_direction(random)), t) == inside) return true;
    }
    return false;
  }

 private:
  LongVec3 local(const LongVec3& offset, Real t) const {
    const LongVec3 point = LongRay(ray_).at(t) + offset;
    return to_local_ * (point - LongVec3(primitive_.local_to_world.translation));
  }

  const Primitive& primitive_;
  const PivotRay& ray_;
  checks::LongMat3 to_local_;
};

/// Between two crossings the ray is inside or outside throughout, as the definition says; at a
/// crossing the two sides of the face differ, as near to it as 1e-12 of the size.
TEST(RandomSolids, AreCrossedWhereTheDefinitionSays) {
  std::mt19937 random(12), nearby(1);
  constexpr double kSize = 10, kNear = 1e-12 * kSize, kShort = 1e-6;
  int crossings = 0, near_edges = 0, between = 0;
  const int rounds = test_support::full_run() ? 10000 : 120;
  for (int round = 0; round < rounds; ++round) {
    const Primitive primitive = random_solid(random, random() % 2 ? Affine{} : random_map(random));
    if (!is_valid(primitive)) continue;
    HardRays rays(primitive, random);
    std::vector<PivotRay> lanes(kPacketRays);
    for (PivotRay& ray : lanes) ray = rays.next();
    const Crossed found(primitive, FrameRays{}, checks::packet_of(lanes));
    for (uint32_t lane = 0; lane < kPacketRays; ++lane) {
      SCOPED_TRACE(testing::Message() << "round " << round << ", lane " << lane);
      const Judge judge(primitive, lanes[lane]);
      const double length = glm::length(lanes[lane].direction);
      const auto segments = found.segments(lane);
      const double beyond = HardRays::kFurthest + 100 / length;
      std::vector<double> ends{-beyond};
      for (const auto& [start, end] : segments) ends.insert(ends.end(), {start, end});
      ends.push_back(beyond);
      for (size_t i = 1; i < ends.size(); ++i) {
        // A piece as short as this may be a touch of a corner.
        if ((ends[i] - ends[i - 1]) * length < kShort) continue;
        // Next to the surface, as on rays along a face, either is right.
        for (const double share : {0.1, 0.5, 0.9}) {
          const Real t = ends[i - 1] + share * (ends[i] - ends[i - 1]);
          if (judge.is_at_edge(t)) continue;
          const bool is_inside = i % 2 == 0;
          ASSERT_TRUE(judge.holds(LongVec3(0), t) == is_inside ||
                      judge.holds_nearby(is_inside, t, nearby))
              << "between " << i - 1 << " and " << i;
          ++between;
        }
      }
      const std::vector<Crossing>& all = found.search.lanes[lane].found;
      for (size_t i = 0; i < all.size(); ++i) {
        const Vec3& normal = found.normals[lane][i];
        ASSERT_NEAR(glm::length(normal), 1, 1e-12);
        const LongVec3 across = Real(kNear) * LongVec3(normal);
        ++crossings;
        if (judge.holds(across, all[i].t) != judge.holds(-across, all[i].t)) continue;
        ++near_edges;
        ASSERT_TRUE(judge.is_at_edge(all[i].t) || (judge.holds_nearby(true, all[i].t, nearby) &&
                                                   judge.holds_nearby(false, all[i].t, nearby)))
            << "crossing " << i;
      }
    }
  }
  std::printf("%d crossings, %d of them at other faces' edges; %d points between\n", crossings,
              near_edges, between);
  EXPECT_GT(crossings, 20 * rounds);
  EXPECT_GT(between, 20 * rounds);
}

TEST(RandomSolids, AreLeftAsOftenAsEntered) {
  std::mt19937 random(13);
  const int rounds = test_support::full_run() ? 30000 : 1000;
  for (int round = 0; round < rounds; ++round) {
    const Primitive primitive = random_solid(random, Affine{});
    if (!is_valid(primitive)) continue;
    HardRays rays(primitive, random);
    std::vector<PivotRay> lanes(kPacketRays);
    for (PivotRay& ray : lanes) ray = rays.next();
    const Crossed found(primitive, FrameRays{}, checks::packet_of(lanes));
    for (const CrossingSearch::Lane& lane : found.search.lanes) {
      int turns = 0;
      double last = -std::numeric_limits<double>::infinity();
      for (const Crossing& crossing : lane.found) {
        turns += crossing.turn;
        ASSERT_GE(crossing.t, last);
        last = crossing.t;
      }
      ASSERT_EQ(turns, 0);
    }
  }
}

TEST(Revolutions, HaveLoopsThatAreLeftAsOftenAsEntered) {
  std::mt19937 random(14);
  const int rounds = test_support::full_run() ? 40000 : 2000;
  int crossings = 0;
  for (int round = 0; round < rounds; ++round) {
    // Filled so, a loop that is left more or less often than entered leaves the ray inside.
    const Primitive primitive =
        make_revolution(filled(checks::beside_axis(checks::random_loops(random), random)));
    if (!is_valid(primitive)) continue;
    HardRays rays(primitive, random);
    std::vector<PivotRay> lanes(kPacketRays);
    for (PivotRay& ray : lanes) ray = rays.next();
    const Crossed found(primitive, FrameRays{}, checks::packet_of(lanes));
    for (const CrossingSearch::Lane& lane : found.search.lanes) {
      int turns = 0;
      for (const Crossing& crossing : lane.found) turns += crossing.turn;
      ASSERT_EQ(turns, 0);
      crossings += static_cast<int>(lane.found.size());
    }
  }
  EXPECT_GT(crossings, 10 * rounds);
}

TEST(RandomSolids, AreTheSameWithEveryInstructionSet) {
  std::mt19937 random(15);
  for (int round = 0; round < 300; ++round) {
    const Primitive primitive = random_solid(random, random_map(random));
    if (!is_valid(primitive)) continue;
    HardRays rays(primitive, random);
    std::vector<PivotRay> lanes(kPacketRays);
    for (PivotRay& ray : lanes) ray = rays.next();
    const RayPacket packet = checks::packet_of(lanes);
    std::unique_ptr<Crossed> first;
    checks::for_each_simd_level([&](SimdLevel level) {
      SCOPED_TRACE(checks::name_of(level));
      auto found = std::make_unique<Crossed>(primitive, FrameRays{}, packet);
      if (!first) {
        first = std::move(found);
        return;
      }
      for (uint32_t lane = 0; lane < kPacketRays; ++lane) {
        const auto &a = first->search.lanes[lane].found, &b = found->search.lanes[lane].found;
        ASSERT_EQ(a.size(), b.size());
        for (size_t i = 0; i < a.size(); ++i) {
          ASSERT_EQ(a[i].t, b[i].t);
          ASSERT_EQ(a[i].face, b[i].face);
          ASSERT_EQ(first->normals[lane][i], found->normals[lane][i]);
        }
      }
    });
  }
}

// --- Bounds and cells ---

TEST(RandomSolids, AreWithinTheirBoundsAndEnclosures) {
  std::mt19937 random(16);
  const int rounds = test_support::full_run() ? 2000 : 60;
  for (int round = 0; round < rounds; ++round) {
    const Primitive primitive = random_solid(random, random_map(random));
    if (!is_valid(primitive)) continue;
    const CanonicalPrimitive canonical = canonicalize(primitive);
    const double slack = 1e-13 * canonical.bounds.diagonal();
    HardRays rays(primitive, random);
    Box reached;
    for (int i = 0; i < 300; ++i) {
      std::vector<PivotRay> lanes(1, rays.next());
      lanes.resize(kPacketRays, lanes[0]);
      const Crossed found(primitive, FrameRays{}, checks::packet_of(lanes));
      for (const auto& [start, end] : found.segments(0)) {
        for (const double t : {start, end}) {
          const Vec3 p = lanes[0].origin + t * lanes[0].direction;
          reached.merge(p);
          const Vec3 at = canonical.world_to_canonical * (p - canonical.center);
          ASSERT_LE(std::hypot(at.x, at.y),
                    canonical.radius_mid + canonical.radius_slope * at.z + 1e-13);
          ASSERT_LE(std::abs(at.z), 1 + 1e-13);
        }
      }
    }
    for (int axis = 0; axis < 3; ++axis) {
      ASSERT_GE(reached.min[axis], canonical.bounds.min[axis] - slack);
      ASSERT_LE(reached.max[axis], canonical.bounds.max[axis] + slack);
    }
  }
}

TEST(RandomSolids, HaveCellsThatAreWhatIsClaimed) {
  std::mt19937 random(17);
  int counts[3] = {};
  int undecided = 0;
  const int rounds = test_support::full_run() ? 3000 : 120;
  for (int round = 0; round < rounds; ++round) {
    const Affine map = random() % 2 ? Affine{} : random_map(random);
    const Primitive primitive = random_solid(random, map);
    if (!is_valid(primitive)) continue;
    const CanonicalPrimitive canonical = canonicalize(primitive);
    const auto inverse_linear = glm::inverse(map.linear);
    for (int i = 0; i < 40; ++i) {
      const Box& bounds = canonical.bounds;
      const Vec3 center = checks::random_point(random, bounds);
      const Vec3 half = std::exp(uniform(random, -5, -1)) * bounds.size();
      const Box cell{center - half, center + half};
      const Classification claim = classify(canonical, cell);
      ++counts[static_cast<int>(claim)];
      int held = 0;
      constexpr int kPoints = 15;
      for (int k = 0; k < kPoints; ++k) {
        const Vec3 p = checks::random_point(random, cell);
        const bool holds =
            checks::holds_local(primitive, LongVec3(inverse_linear * (p - map.translation)));
        ASSERT_FALSE(holds && claim == Classification::kOutside) << "round " << round;
        ASSERT_FALSE(!holds && claim == Classification::kInside) << "round " << round;
        held += holds;
      }
      undecided += claim == Classification::kCrosses && (held == 0 || held == kPoints);
    }
  }
  EXPECT_GT(counts[static_cast<int>(Classification::kInside)], 100);
  EXPECT_GT(counts[static_cast<int>(Classification::kOutside)], 150);
  EXPECT_LT(undecided, 0.5 * counts[static_cast<int>(Classification::kCrosses)]);
}

// --- Pictures ---

TEST(RandomSolids, LookTheSameByTilesAndByCells) {
  std::mt19937 random(18);
  const int rounds = test_support::full_run() ? 1000 : 40;
  int hits = 0;
  for (int round = 0; round < rounds; ++round) {
    Scene scene;
    CsgTreeBuilder builder;
    builder.open(static_cast<Op>(round % 3));
    while (scene.primitives.size() < 3) {
      Primitive primitive = random_solid(random, random_map(random));
      if (!is_valid(primitive)) continue;
      primitive.id = static_cast<uint32_t>(scene.primitives.size());
      builder.primitive(primitive.id);
      scene.primitives.push_back(primitive);
    }
    builder.close();
    scene.model = builder.finish();
    const Solid solid(canonical_primitives(scene), scene.model);
    const Subdivision subdivision(solid, SubdivisionOptions{});
    Box bounds;
    for (const CanonicalPrimitive& primitive : solid.primitives()) {
      bounds.merge(primitive.bounds);
    }
    const Vec3 axes[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const Vec3 direction = round % 2 ? axes[random() % 3] : checks::random_direction(random);
    View view = checks::view_of(bounds, direction, 2 * bounds.diagonal());
    view.width_px = 160;
    view.height_px = 120;
    Hits by_tiles, by_cells;
    TraceStats stats;
    trace(solid, view, TraceOptions{}, by_tiles, stats);
    trace(subdivision, view, TraceOptions{}, by_cells, stats);
    ASSERT_EQ(by_tiles.primitive, by_cells.primitive) << "round " << round;
    ASSERT_EQ(by_tiles.s, by_cells.s);
    ASSERT_EQ(by_tiles.normal, by_cells.normal);
    hits += static_cast<int>(by_tiles.s.size() - static_cast<size_t>(std::ranges::count(
                                                     by_tiles.primitive, Hits::kMiss)));
  }
  EXPECT_GT(hits, 500 * rounds);
}

}  // namespace
}  // namespace csgcore
