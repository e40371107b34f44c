// Tests the extents of primitives on the screen: they are never too small.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <numeric>

#include "checks.hpp"
#include "csgcore/polyhedron.hpp"
#include "primitives/intersect.hpp"
#include "rays/frame_rays.hpp"
#include "rays/packet_blocks.hpp"
#include "screen/screen_slab.hpp"
#include "simd_levels.hpp"
#include "solid/extent_tests.hpp"
#include "support/models.hpp"
#include "tiles/tile_list.hpp"
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
  std::vector<ScreenSlab> slabs;    // of those with inside2 < 0, on the screen
  std::vector<ScreenKDop> corners;  // of those that are large on the screen

  Screen(const std::vector<Primitive>& scene, const FrameRays& rays, bool centers_only)
      : frame(rays) {
    Extents world;
    for (const Primitive& primitive : scene) {
      primitives.push_back(canonicalize(primitive));
      world.push_back(extent_of(primitives.back()));
    }
    extents.resize(world.size());
    slabs.resize(world.size());
    corners.resize(world.size());
    const ScreenOptions options{centers_only};
    std::vector<uint32_t> indices(world.size());
    std::iota(indices.begin(), indices.end(), 0u);
    find_screen_extents(world.data(), indices, frame, options, extents.data());
    std::erase_if(indices, [&](uint32_t i) {
      const double half = std::min(extents[i].half[0], extents[i].half[1]);
      return !has_slab(i) && !(half >= kCorneredHalf_px);
    });
    find_slabs(primitives.data(), indices, frame, options, extents.data(), slabs.data(),
               corners.data());
  }

  /// Returns whether the primitive fills its box badly.
  bool has_slab(size_t i) const { return extents[i].inside2 < 0 && is_visible(extents[i]); }

  bool is_cornered(size_t i) const { return has_slab(i) && extents[i].inside2 == kCornered; }

  bool is_beyond_line(size_t i, const glm::dvec2& point_px) const {
    const Vec3 at{point_px, 0};
    const Box box{at, at};
    return (has_slab(i) && misses(slabs[i], box)) || (is_cornered(i) && misses(corners[i], box));
  }

  /// Returns the rays through these points of the picture, of which there are at most kPacketRays.
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

  /// Returns the place in the picture of a point of the world in front of the eye.
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

/// Random primitives, stretched to needles and pressed to plates.
std::vector<Primitive> stretched_primitives(std::mt19937& random, int count) {
  std::vector<Primitive> primitives = random_primitives(random, count);
  for (Primitive& primitive : primitives) {
    for (int axis = 0; axis < 3; ++axis) {
      primitive.local_to_world.linear[axis] *= std::pow(10.0, uniform(random, -5, 1));
    }
  }
  return primitives;
}

/// About the space that random_primitives fill.
const Box kSeenSpace{Vec3(-8.0), Vec3(8.0)};

FrameRays rays_of(const View& view) { return frame_rays(view, kSeenSpace); }

/// Returns views of that space: from outside, from its middle, from one point of it.
std::vector<View> random_views(std::mt19937& random) {
  std::vector<View> views;
  for (const double distance : {40.0, 12.0, 3.0, 0.0, 1e5}) {
    for (const Projection projection : {Projection::kPerspective, Projection::kOrthographic}) {
      View view = checks::view_of(kSeenSpace, checks::random_direction(random), distance);
      view.projection = projection;
      view.half_height = projection == Projection::kOrthographic ? 5 : distance > 100 ? 5e-5 : 0.4;
      view.width_px = 120;
      view.height_px = 90;
      views.push_back(view);
    }
  }
  return views;
}

/// Returns the rays' segments with a convex primitive; for another one, from its first crossing to
/// its last.
PacketSegments segments_of(const FrameRays& frame, const RayPacket& rays,
                           const CanonicalPrimitive& primitive) {
  PacketSegments segments;
  if (primitive.is_convex) {
    intersect(frame, rays, primitive, segments);
    return segments;
  }
  CrossingSearch search;
  find_all_crossings(frame, rays, primitive, search);
  for (uint32_t lane = 0; lane < kPacketRays; ++lane) {
    const std::vector<Crossing>& found = search.lanes[lane].found;
    segments.start[lane] = found.empty() ? 1 : found.front().t;
    segments.end[lane] = found.empty() ? 0 : found.back().t;
  }
  return segments;
}

/// Returns whether a part of the segment is in front of the eye.
bool is_seen(const FrameRays& frame, const PacketSegments& segments, uint32_t lane) {
  return segments.start[lane] < segments.end[lane] && segments.end[lane] > frame.first_t;
}

/// Returns places in the picture where points of the surface are seen, or pixels' centres next to
/// them.
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
      unseen += !is_visible(extent);
      const auto points = points_at(screen, primitives[i], random, centers_only);
      const PacketSegments segments =
          segments_of(screen.frame, screen.rays_through(points), screen.primitives[i]);
      for (uint32_t lane = 0; lane < kPacketRays; ++lane) {
        if (!is_seen(screen.frame, segments, lane)) continue;
        ++seen;
        ASSERT_TRUE(is_visible(extent));
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

/// The extent of a primitive entirely on the screen, well in front of the eye, is tight to a
/// hundredth of its size.
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
      if (!is_visible(extent)) continue;
      if (is_perspective && nearest_t(extent) < screen.frame.first_t + 1) continue;
      // What encloses it is shown in its place.
      if (!test_support::test_kind_of(primitives[i].shape()).is_told_tightly()) continue;
      const Polyhedron* polyhedron = primitives[i].polyhedron();
      if (polyhedron && polyhedron->vertices().size() > 64) continue;
      glm::dvec2 low(1e9), high(-1e9);
      double beyond[2] = {-1e9, -1e9};  // how far the furthest point is beyond the lines
      double least[ScreenKDop::kCount], most[ScreenKDop::kCount];
      std::fill(std::begin(least), std::end(least), 1e9);
      std::fill(std::begin(most), std::end(most), -1e9);
      const ScreenSlab& slab = screen.slabs[i];
      for (int point = 0; point < 3000; ++point) {
        const glm::dvec2 at = screen.project(checks::surface_point(primitives[i], random));
        low = glm::min(low, at);
        high = glm::max(high, at);
        for (const int line : {0, 1}) {
          const double past = slab.x[line] * at.x + slab.y[line] * at.y - slab.limit[line];
          beyond[line] = std::max(beyond[line], past);
        }
        for (int corner = 0; corner < ScreenKDop::kCount; ++corner) {
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
      for (int corner = 0; screen.is_cornered(i) && corner < ScreenKDop::kCount; ++corner) {
        const double slack = 0.06 * glm::length(high - low);
        ASSERT_NEAR(screen.corners[i].low[corner], least[corner], slack);
        ASSERT_NEAR(screen.corners[i].high[corner], most[corner], slack);
        ++tight_corners;
      }
      const bool shows_wall = primitives[i].shape() == Shape::kFrustum;
      if (!screen.has_slab(i) || (!shows_wall && !polyhedron)) continue;
      for (const int line : {0, 1}) {
        if (slab.limit[line] == std::numeric_limits<float>::infinity()) continue;
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
  const PacketSegments segments = segments_of(screen.frame, rays, screen.primitives[primitive]);
  bool result = false;
  for (uint32_t lane = 0; lane < kPacketRays; ++lane) {
    result |= is_seen(screen.frame, segments, lane);
  }
  return result;
}

TEST(ScreenSlabs, MissOnlyTilesWhoseRaysMissThem) {
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
        const bool by_lines = screen.has_slab(i) && misses(screen.slabs[i], tile);
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

/// No other test covers the instruction sets of the screen's functions.
TEST(ScreenSlabs, EveryInstructionSetAgrees) {
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
        if (!screen.has_slab(i)) continue;
        for (const int line : {0, 1}) {
          EXPECT_EQ(screen.slabs[i].x[line], expected.slabs[i].x[line]);
          EXPECT_EQ(screen.slabs[i].y[line], expected.slabs[i].y[line]);
          EXPECT_EQ(screen.slabs[i].limit[line], expected.slabs[i].limit[line]);
        }
        if (!screen.is_cornered(i)) continue;
        EXPECT_EQ(std::memcmp(&screen.corners[i], &expected.corners[i], sizeof(ScreenKDop)), 0);
      }
    });
  }
}

/// Tests the screen's extents against a tile, which has any depth.
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

}  // namespace
}  // namespace csgcore
