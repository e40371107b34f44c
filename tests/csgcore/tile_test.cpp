// What tells the tiles of a picture which primitives their rays can meet: never too little.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <numeric>

#include "checks.hpp"
#include "csgcore/polyhedron.hpp"
#include "packet_blocks.hpp"
#include "screen_outline.hpp"
#include "simd_levels.hpp"
#include "support/models.hpp"
#include "tile_list.hpp"
#include "trace_scenes.hpp"
#include "whole_list.hpp"

namespace csgcore {
namespace {

using checks::uniform;

/// Primitives on the screen, as a TileTracer sees them.
struct Screen {
  FrameRays frame;
  std::vector<CanonicalPrimitive> primitives;
  Extents extents;
  std::vector<ScreenOutline> outlines;  // of those whose inside2 < 0, on the screen
  std::vector<ScreenCorners> corners;   // of those that are large there

  Screen(const std::vector<Primitive>& scene, const FrameRays& rays, bool centers_only)
      : frame(rays) {
    Extents world;
    for (const Primitive& primitive : scene) {
      primitives.push_back(canonicalize(primitive));
      world.push_back(extent_of(primitives.back()));
    }
    extents.resize(world.size());
    outlines.resize(world.size());
    corners.resize(world.size());
    const ScreenOptions options{centers_only};
    std::vector<uint32_t> indices(world.size());
    std::iota(indices.begin(), indices.end(), 0u);
    find_screen_extents(world.data(), indices, frame, options, extents.data());
    std::erase_if(indices, [&](uint32_t i) {
      const double half = std::min(extents[i].half[0], extents[i].half[1]);
      return !is_outlined(i) && !(half >= kCorneredHalf_px);
    });
    find_outlines(primitives.data(), indices, frame, options, extents.data(), outlines.data(),
                  corners.data());
  }

  /// Of what fills its box badly.
  bool is_outlined(size_t i) const {
    return extents[i].inside2 < 0 && fate_on_screen(extents[i]) == ScreenFate::kVisible;
  }

  bool is_cornered(size_t i) const { return is_outlined(i) && extents[i].inside2 == kCornered; }

  bool is_beyond_line(size_t i, const glm::dvec2& point_px) const {
    const Vec3 at{point_px, 0};
    const Box box{at, at};
    return (is_outlined(i) && misses(outlines[i], box)) ||
           (is_cornered(i) && misses(corners[i], box));
  }

  /// The rays of so many points of the picture, at most kPacketRays.
  RayPacket rays_through(const std::vector<glm::dvec2>& points_px) const {
    PacketLaterals laterals;
    for (uint32_t lane = 0; lane < kPacketRays; ++lane) {
      const glm::dvec2& point = points_px[std::min<size_t>(lane, points_px.size() - 1)];
      laterals.u[lane] = frame.u(point.x);
      laterals.v[lane] = frame.v(point.y);
    }
    RayPacket rays;
    make_rays(frame, laterals, rays);
    return rays;
  }

  /// The picture's point that shows a point of the world in front of the eye.
  glm::dvec2 project(const Vec3& point) const {
    const View& view = frame.view;
    const Vec3 offset = point - view.eye;
    const double depth =
        view.projection == Projection::kPerspective ? glm::dot(offset, view.forward) : 1.0;
    const double unit = view.half_height / (0.5 * view.height_px);
    return {glm::dot(offset, view.right) / (depth * unit) + 0.5 * view.width_px - 0.5,
            0.5 * view.height_px - 0.5 - glm::dot(offset, view.up) / (depth * unit)};
  }
};

std::vector<Primitive> random_primitives(std::mt19937& random, int count) {
  std::vector<Primitive> primitives;
  while (static_cast<int>(primitives.size()) < count) {
    primitives.push_back(checks::random_primitive(random));
  }
  return primitives;
}

/// The same, stretched to needles and pressed to plates.
std::vector<Primitive> stretched_primitives(std::mt19937& random, int count) {
  std::vector<Primitive> primitives = random_primitives(random, count);
  for (Primitive& primitive : primitives) {
    for (int axis = 0; axis < 3; ++axis) {
      primitive.local_to_world.linear[axis] *= std::pow(10.0, uniform(random, -5, 1));
    }
  }
  return primitives;
}

/// The space that random_primitives fill, about.
const Box kSpace{Vec3(-8.0), Vec3(8.0)};

FrameRays rays_of(const View& view) { return frame_rays(view, kSpace); }

/// Views of that: from outside, from amidst them, from one point of it.
std::vector<View> random_views(std::mt19937& random) {
  std::vector<View> views;
  for (const double distance : {40.0, 12.0, 3.0, 0.0, 1e5}) {
    for (const Projection projection : {Projection::kPerspective, Projection::kOrthographic}) {
      View view = checks::view_of(kSpace, checks::random_direction(random), distance);
      view.projection = projection;
      view.half_height = projection == Projection::kOrthographic ? 5 : distance > 100 ? 5e-5 : 0.4;
      view.width_px = 120;
      view.height_px = 90;
      views.push_back(view);
    }
  }
  return views;
}

/// The part of a segment that is in front of the eye; false if there is none.
bool is_seen(const FrameRays& frame, const PacketSegments& segments, uint32_t lane) {
  return segments.start[lane] < segments.end[lane] && segments.end[lane] > frame.first_t;
}

/// Pixels' centres next to where points of the surface are seen, or the very points.
std::vector<glm::dvec2> points_at(const Screen& screen, const Primitive& primitive,
                                  std::mt19937& random, bool centers_only) {
  std::vector<glm::dvec2> points;
  const View& view = screen.frame.view;
  for (uint32_t i = 0; i < kPacketRays; ++i) {
    glm::dvec2 point = screen.project(checks::surface_point(primitive, random));
    point.x = std::clamp(point.x, -0.5, view.width_px - 0.5);
    point.y = std::clamp(point.y, -0.5, view.height_px - 0.5);
    if (centers_only) {
      point.x = std::min(std::floor(point.x + 1), view.width_px - 1.0);
      point.y = std::min(std::floor(point.y + 1), view.height_px - 1.0);
    }
    points.push_back(point);
  }
  return points;
}

class ScreenExtents : public testing::TestWithParam<bool> {};

TEST_P(ScreenExtents, HoldWhatRaysMeet) {
  const bool centers_only = GetParam();
  std::mt19937 random(1);
  uint64_t seen = 0, unseen = 0;
  for (const View& view : random_views(random)) {
    std::vector<Primitive> primitives = random_primitives(random, 300);
    for (const Primitive& hard : stretched_primitives(random, 300)) primitives.push_back(hard);
    const Screen screen(primitives, rays_of(view), centers_only);
    for (size_t i = 0; i < primitives.size(); ++i) {
      const Extent& extent = screen.extents[i];
      unseen += fate_on_screen(extent) != ScreenFate::kVisible;
      const auto points = points_at(screen, primitives[i], random, centers_only);
      PacketSegments segments;
      intersect(screen.frame, screen.rays_through(points), screen.primitives[i], segments);
      for (uint32_t lane = 0; lane < kPacketRays; ++lane) {
        if (!is_seen(screen.frame, segments, lane)) continue;
        ++seen;
        ASSERT_EQ(fate_on_screen(extent), ScreenFate::kVisible);
        ASSERT_LE(std::abs(points[lane].x - extent.center[0]), extent.half[0]);
        ASSERT_LE(std::abs(points[lane].y - extent.center[1]), extent.half[1]);
        ASSERT_FALSE(screen.is_beyond_line(i, points[lane]));
        ASSERT_GE(segments.start[lane], nearest_t(extent));
        ASSERT_LE(segments.end[lane], furthest_t(extent));
      }
    }
  }
  EXPECT_GT(seen, 5000u);
  EXPECT_GT(unseen, 200u);
}

INSTANTIATE_TEST_SUITE_P(Tiles, ScreenExtents, testing::Bool(), [](const auto& centers_only) {
  return centers_only.param ? "OfCentres" : "OfAllPoints";
});

/// Of what lies wholly on the screen, well before the eye: to a hundredth of its size.
TEST(ScreenExtents, AreTight) {
  std::mt19937 random(2);
  uint64_t tight = 0, tight_lines = 0, tight_corners = 0;
  for (View& view : random_views(random)) {
    view.width_px *= 4;  // so that many are large
    view.height_px *= 4;
    const std::vector<Primitive> primitives = random_primitives(random, 60);
    const Screen screen(primitives, rays_of(view), false);
    for (size_t i = 0; i < primitives.size(); ++i) {
      const Extent& extent = screen.extents[i];
      const bool is_perspective = view.projection == Projection::kPerspective;
      if (fate_on_screen(extent) != ScreenFate::kVisible) continue;
      if (is_perspective && nearest_t(extent) < screen.frame.first_t + 1) continue;
      // What encloses it is shown in its place.
      const Polyhedron* polyhedron = primitives[i].polyhedron.get();
      if (polyhedron && polyhedron->vertices().size() > 64) continue;
      glm::dvec2 low(1e9), high(-1e9);
      double beyond[2] = {-1e9, -1e9};  // how far the furthest is beyond the lines
      double least[ScreenCorners::kCount], most[ScreenCorners::kCount];
      std::fill(std::begin(least), std::end(least), 1e9);
      std::fill(std::begin(most), std::end(most), -1e9);
      const ScreenOutline& outline = screen.outlines[i];
      for (int point = 0; point < 3000; ++point) {
        const glm::dvec2 at = screen.project(checks::surface_point(primitives[i], random));
        low = glm::min(low, at);
        high = glm::max(high, at);
        for (const int line : {0, 1}) {
          const double past = outline.x[line] * at.x + outline.y[line] * at.y - outline.limit[line];
          beyond[line] = std::max(beyond[line], past);
        }
        for (int corner = 0; corner < ScreenCorners::kCount; ++corner) {
          const auto [x, y] = kCornerDirections[corner];
          least[corner] = std::min(least[corner], x * at.x + y * at.y);
          most[corner] = std::max(most[corner], x * at.x + y * at.y);
        }
      }
      for (const int axis : {0, 1}) {
        const double slack = 0.03 * (high[axis] - low[axis]);
        ASSERT_NEAR(extent.center[axis] - extent.half[axis], low[axis], slack);
        ASSERT_NEAR(extent.center[axis] + extent.half[axis], high[axis], slack);
      }
      ++tight;
      for (int corner = 0; screen.is_cornered(i) && corner < ScreenCorners::kCount; ++corner) {
        const double slack = 0.06 * glm::length(high - low);
        ASSERT_NEAR(screen.corners[i].low[corner], least[corner], slack);
        ASSERT_NEAR(screen.corners[i].high[corner], most[corner], slack);
        ++tight_corners;
      }
      const bool shows_wall = primitives[i].shape == Shape::kFrustum;
      if (!screen.is_outlined(i) || (!shows_wall && !polyhedron)) continue;
      for (const int line : {0, 1}) {
        if (outline.limit[line] == std::numeric_limits<float>::infinity()) continue;
        ASSERT_NEAR(beyond[line], 0, 0.03 * glm::length(high - low));
        ++tight_lines;
      }
    }
  }
  EXPECT_GT(tight, 100u);
  EXPECT_GT(tight_lines, 100u);
  EXPECT_GT(tight_corners, 100u);
}

std::vector<uint32_t> indices(size_t count) {
  std::vector<uint32_t> result(count + kVectorPadding);
  for (uint32_t i = 0; i < count; ++i) result[i] = i | (i % 3 == 0 ? CellList::kComplementBit : 0);
  return result;
}

/// Points of a box on the screen, its corners among them.
std::vector<glm::dvec2> points_in(const Box& tile, std::mt19937& random) {
  std::vector<glm::dvec2> points;
  for (const double x : {tile.min.x, tile.max.x}) {
    for (const double y : {tile.min.y, tile.max.y}) points.push_back({x, y});
  }
  while (points.size() < kPacketRays) {
    points.push_back(
        {uniform(random, tile.min.x, tile.max.x), uniform(random, tile.min.y, tile.max.y)});
  }
  return points;
}

bool any_seen(const Screen& screen, const RayPacket& rays, size_t primitive) {
  PacketSegments segments;
  intersect(screen.frame, rays, screen.primitives[primitive], segments);
  bool result = false;
  for (uint32_t lane = 0; lane < kPacketRays; ++lane) {
    result |= is_seen(screen.frame, segments, lane);
  }
  return result;
}

TEST(ScreenOutlines, MissOnlyTilesWhoseRaysMissThem) {
  std::mt19937 random(3);
  uint64_t missed = 0, missed_by_corners = 0;
  for (View& view : random_views(random)) {
    view.width_px *= 4;  // so that many are large
    view.height_px *= 4;
    const std::vector<Primitive> primitives = random_primitives(random, 64);
    const Screen screen(primitives, rays_of(view), true);
    for (int round = 0; round < 200; ++round) {
      const double x = uniform(random, 0, 472), y = uniform(random, 0, 352);
      const double side = uniform(random, 0, 100);
      const Box tile{{x, y, 0}, {x + side, y + uniform(random, 0.5, 1) * side, 0}};
      const RayPacket rays = screen.rays_through(points_in(tile, random));
      for (uint32_t i = 0; i < 64; ++i) {
        const bool by_lines = screen.is_outlined(i) && misses(screen.outlines[i], tile);
        const bool by_corners = screen.is_cornered(i) && misses(screen.corners[i], tile);
        if (!by_lines && !by_corners) continue;
        ++missed;
        missed_by_corners += !by_lines && overlaps(screen.extents[i], tile);
        ASSERT_FALSE(any_seen(screen, rays, i)) << i;
      }
    }
  }
  EXPECT_GT(missed, 1000u);
  EXPECT_GT(missed_by_corners, 100u);
}

/// The screen's functions have no other test of their instruction sets.
TEST(ScreenOutlines, EveryInstructionSetAgrees) {
  std::mt19937 random(5);
  const std::vector<View> views = random_views(random);
  const std::vector<Primitive> primitives = random_primitives(random, 203);
  for (View view : views) {
    view.width_px *= 4;  // so that some are large
    view.height_px *= 4;
    const Screen expected(primitives, rays_of(view), true);
    checks::for_each_simd_level([&](SimdLevel level) {
      SCOPED_TRACE(checks::name_of(level));
      const Screen screen(primitives, rays_of(view), true);
      EXPECT_EQ(std::memcmp(screen.extents.data(), expected.extents.data(),
                            expected.extents.size() * sizeof(Extent)),
                0);
      for (size_t i = 0; i < primitives.size(); ++i) {
        if (!screen.is_outlined(i)) continue;
        for (const int line : {0, 1}) {
          EXPECT_EQ(screen.outlines[i].x[line], expected.outlines[i].x[line]);
          EXPECT_EQ(screen.outlines[i].y[line], expected.outlines[i].y[line]);
          EXPECT_EQ(screen.outlines[i].limit[line], expected.outlines[i].limit[line]);
        }
        if (!screen.is_cornered(i)) continue;
        EXPECT_EQ(std::memcmp(&screen.corners[i], &expected.corners[i], sizeof(ScreenCorners)), 0);
      }
    });
  }
}

/// The screen's extents against a tile, which has any depth.
TEST(ScreenExtents, RectanglesMeetATileOrNot) {
  constexpr double kAnyDepth = std::numeric_limits<double>::infinity();
  std::mt19937 random(6);
  Extents extents(200);
  for (Extent& extent : extents) {
    extent = {};
    for (const int axis : {0, 1}) {
      extent.center[axis] = uniform(random, -10, 10);
      extent.half[axis] = uniform(random, -1, 5);  // empty ones too
    }
    const bool is_empty = std::min(extent.half[0], extent.half[1]) < 0;
    extent.outside2 = is_empty ? -1 : std::numeric_limits<double>::infinity();
    extent.inside2 = random() % 2 ? 0.0 : -1.0;
  }
  const Box tile{{-2, -3, -kAnyDepth}, {4, 1, kAnyDepth}};
  const std::vector<uint32_t> all = indices(static_cast<uint32_t>(extents.size()));
  checks::for_each_simd_level([&](SimdLevel level) {
    for (uint32_t first = 0; first + 64 < extents.size(); first += 13) {
      const ExtentAnswers answers =
          test_extents(extents.data(), all.data() + first, 64, {tile, tile, 0});
      for (uint32_t bit = 0; bit < 64; ++bit) {
        const Extent& extent = extents[first + bit];
        bool meets = true;
        for (const int axis : {0, 1}) {
          meets &= extent.half[axis] >= 0 &&
                   extent.center[axis] - extent.half[axis] <= tile.max[axis] &&
                   extent.center[axis] + extent.half[axis] >= tile.min[axis];
        }
        EXPECT_EQ((answers.outside[0] >> bit & 1) == 0, meets) << checks::name_of(level);
        EXPECT_EQ((answers.open >> bit & 1) != 0, extent.inside2 < 0);
        EXPECT_EQ(answers.inside[0] >> bit & 1, 0u);
      }
    }
  });
}

// --- Lists made smaller ---

/// A list for a tile of a picture, as a TileTracer makes it.
class Simplifying {
 public:
  Simplifying(const Scene& scene, const View& view, std::optional<bool> last_value)
      : solid_(canonical_primitives(scene), scene.model),
        whole_(solid_, view),
        bounds_(solid_.primitives(), solid_.groups(), whole_.frame(), true),
        restrictor_(bounds_.extents(), bounds_),
        simplifier_(solid_.primitives(), solid_.groups(), bounds_, whole_.frame(), true, last_value,
                    0.0, thinnest_piece(solid_.bounds()), fates_) {
    bounds_.bound_all();
  }

  struct Outcome {
    uint32_t before = 0, after = 0;  // literals
    uint64_t hits = 0;
  };
  /// Fails if rays through the tile's pixels see different things by the two lists.
  Outcome expect_same_hits(const Tile& tile, Boundary boundary) {
    CellList list, simplified;
    Outcome outcome;
    if (!restrict_to(tile, list)) return outcome;
    outcome.before = list.count();
    const auto simplicity = simplifier_.simplify(tile, list, restrictor_, simplified);
    if (simplicity == TileSimplifier::Outcome::kNothing) return outcome;
    const bool cuts = simplicity == TileSimplifier::Outcome::kCut;
    outcome.after = simplified.count();
    EXPECT_LT(outcome.after, outcome.before);
    for_each_block(tile, [&](const PacketBlock& block) {
      RayPacket rays;
      make_block_rays(whole_.frame(), block, rays);
      const PacketHits by_all = trace(list, rays, block.lanes, boundary);
      const PacketHits by_few = trace(simplified, rays, block.lanes, boundary);
      // What lies behind a cut counts only where nothing before it does.
      const LaneMask lanes = cuts ? by_few.hits : block.lanes;
      EXPECT_EQ(by_all.hits & lanes, by_few.hits & lanes);
      for (uint32_t lane = 0; lane < kPacketRays; ++lane) {
        if (!(by_few.hits >> lane & 1)) continue;
        ++outcome.hits;
        EXPECT_EQ(by_few.t[lane], by_all.t[lane]);
        EXPECT_EQ(simplified.primitive[by_few.index[lane]], list.primitive[by_all.index[lane]]);
      }
    });
    return outcome;
  }

 private:
  /// False if it is constant.
  bool restrict_to(const Tile& tile, CellList& list) {
    restrictor_.restrict(*solid_.cell_list(), box_of(tile, true), list);
    return !list.is_constant();
  }

  PacketHits trace(const CellList& list, const RayPacket& rays, LaneMask lanes, Boundary boundary) {
    PacketHits hits;
    if (list.is_constant()) return hits;
    const std::vector<double> nearest(list.count(), -std::numeric_limits<double>::max());
    TraceList trace_list = whole_.list();
    trace_list.list = &list;
    trace_list.nearest_t = nearest.data();
    const TraceSubject subject{thinnest_piece(solid_.bounds()), boundary};
    trace_packet(whole_.frame(), rays, lanes, trace_list, subject, workspace_, hits);
    return hits;
  }

  const Solid solid_;
  checks::WholeList whole_;
  ScreenBounds bounds_;
  Restrictor restrictor_;
  Fates fates_;
  TileSimplifier simplifier_;
  PacketWorkspace workspace_;
};

class Simplifier : public testing::TestWithParam<Boundary> {};

TEST_P(Simplifier, DropsOnlyWhatItsRaysDoNotSee) {
  const Boundary boundary = GetParam();
  // Where rays go on, nothing is hidden behind what they meet first.
  const auto last_value =
      boundary == Boundary::kFirst ? std::optional<bool>(true) : std::optional<bool>();
  uint64_t dropped = 0, hits = 0;
  constexpr uint32_t kSide_px = 96, kTile_px = 16;
  for (uint32_t seed = 1; seed <= 6; ++seed) {
    const Scene scene = checks::crowd(seed);
    const Box bounds{Vec3(-6.0), Vec3(6.0)};
    for (const auto& [name, view] : checks::trace_views(bounds, kSide_px, kSide_px)) {
      if (name == "FromWithin") continue;
      SCOPED_TRACE(name);
      Simplifying simplifying(scene, view, last_value);
      for (uint32_t y = 0; y < kSide_px; y += kTile_px) {
        for (uint32_t x = 0; x < kSide_px; x += kTile_px) {
          const auto outcome = simplifying.expect_same_hits({x, y, kTile_px, kTile_px}, boundary);
          if (outcome.hits > 0) dropped += outcome.before - outcome.after;
          hits += outcome.hits;
        }
      }
    }
  }
  EXPECT_GT(dropped, 200u);
  EXPECT_GT(hits, 10000u);
}

/// The rims of walls too thin to exist, which rays nevertheless are within for long enough to be
/// found to end there; behind them many needles that they meet end on, before them some more, and
/// at last a ball.
TEST(Cuts, AWallThatDoesNotExistHidesNothing) {
  // Below the thinnest piece of such a scene, 1e-9 of its size; and what some tens of pixels are
  // small against, so that all their rays leave a wall at about one depth.
  constexpr double kThickness = 2e-8;
  constexpr double kPixel = 1e-10;
  const Mat3 lying{Vec3(0, 1, 0), Vec3(0, 0, 1), Vec3(1, 0, 0)};
  uint64_t behind = 0;
  for (uint32_t seed = 1; seed <= 60; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const bool is_one_tile = seed % 2 == 0;
    const double half_px = is_one_tile ? 4 : uniform(random, 4, 40);
    std::vector<Primitive> primitives;
    // In the order of a quadtree: they lie too close to each other for their groups to find one.
    const auto add_needles = [&](double low_x, const glm::dvec2& center_px, double reach_px,
                                 int bits) {
      for (uint32_t i = 0; i < 1u << 2 * bits; ++i) {
        glm::dvec2 at(uniform(random, 0, 1), uniform(random, 0, 1));
        for (int bit = 0; bit < bits; ++bit) {
          at += double(1 << bit) * glm::dvec2(i >> (2 * bit) & 1, i >> (2 * bit + 1) & 1);
        }
        at = kPixel * (center_px + reach_px * (at * std::ldexp(2.0, -bits) - 1.0));
        const double radius = uniform(random, 0.3, 1.2) * kPixel;
        primitives.push_back(make_frustum(low_x, low_x + 1, radius, radius, {lying, {0, at}}));
      }
    };
    const auto in_picture_px = [&] {
      return glm::dvec2(uniform(random, -half_px, half_px), uniform(random, -half_px, half_px));
    };
    for (int wall = 0; wall < 2; ++wall) {
      const double tilt = std::pow(10, uniform(random, -2.5, -1.5));
      const double cosine = std::sqrt(1 - tilt * tilt), angle = uniform(random, 0, 7);
      const Vec3 inward(0, std::cos(angle), std::sin(angle));
      const Vec3 along(0, -std::sin(angle), std::cos(angle));
      const Mat3 turned{0.1 * (Vec3(cosine, 0, 0) + tilt * along), inward,
                        Vec3(-tilt, 0, 0) + cosine * along};
      const double rim = uniform(random, -half_px, half_px) * kPixel;
      primitives.push_back(
          make_frustum(0, kThickness, 5, 5, {turned, Vec3(2.0 * wall, 0, 0) + (5 + rim) * inward}));
    }
    if (!is_one_tile) {
      primitives.push_back(make_sphere(1000 * kPixel, {Mat3(1.0), {20, 0, 0}}));
    }
    // Beside the picture, so that the size is more than 21 in any case.
    primitives.push_back(make_sphere(1, {Mat3(1.0), {20, 6, 0}}));
    add_needles(6, {0, 0}, 1.05 * half_px, 5);
    add_needles(6, in_picture_px(), 0.5 * half_px, 4);
    add_needles(-4, in_picture_px(), 0.5 * half_px, 3);
    const Scene scene = test_support::scene_of(Op::kUnion, std::move(primitives));
    const Solid solid(canonical_primitives(scene), scene.model);
    ASSERT_GT(solid.groups().count(), solid.groups().first_group());
    View view = checks::view_of({Vec3(0.0), Vec3(0.0)}, {1, 0, 0}, 9);
    view.projection = Projection::kOrthographic;
    view.width_px = view.height_px = static_cast<uint32_t>(2 * half_px);
    view.half_height = half_px * kPixel;
    const Hits expected = checks::WholeList(solid, view).picture();
    EXPECT_TRUE(checks::same_bits(checks::trace_by_tiles(solid, view), expected));
    EXPECT_EQ(std::ranges::count_if(expected.primitive, [](uint32_t p) { return p < 2; }), 0);
    behind += std::ranges::count(expected.primitive, 2u);
  }
  EXPECT_GT(behind, 1000u);
}

INSTANTIATE_TEST_SUITE_P(Tiles, Simplifier, testing::Values(Boundary::kFirst, Boundary::kBehind),
                         [](const auto& boundary) {
                           return boundary.param == Boundary::kFirst ? "First" : "Behind";
                         });

}  // namespace
}  // namespace csgcore
