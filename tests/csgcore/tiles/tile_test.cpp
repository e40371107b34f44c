// Tests what a tile's list may omit: nothing that its rays see.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "checks.hpp"
#include "packets/packet.hpp"
#include "rays/frame_rays.hpp"
#include "rays/packet_blocks.hpp"
#include "support/full_run.hpp"
#include "support/models.hpp"
#include "tiles/tile_list.hpp"
#include "trace_scenes.hpp"
#include "whole_list.hpp"

namespace csgcore {
namespace {

using checks::uniform;

/// A list for a tile of a picture, as a TileTracer makes it.
class Simplifying {
 public:
  Simplifying(const Scene& scene, const View& view, std::optional<bool> last_value)
      : solid_(canonical_primitives(scene), scene.model),
        whole_(solid_, view),
        bounds_(solid_.primitives(), solid_.groups(), whole_.frame(), true),
        restrictor_(bounds_.extents(), bounds_),
        culler_({solid_.primitives(), &solid_.groups(), bounds_.extents(), &whole_.frame(), true,
                 last_value, 0.0, thickness_tolerance(solid_.bounds())}) {}

  struct Outcome {
    uint32_t before = 0, after = 0;  // tests
    uint64_t hits = 0;
  };
  /// Fails if rays through the tile's pixels see different things by the two lists.
  Outcome expect_same_hits(const Tile& tile, Boundary boundary) {
    CellList list, culled;
    Outcome outcome;
    if (!restrict_to(tile, list)) return outcome;
    outcome.before = list.count();
    const auto simplicity = culler_.cull(tile, list, restrictor_, culled);
    if (simplicity == TileCuller::Outcome::kNothing) return outcome;
    const bool cuts = simplicity == TileCuller::Outcome::kCut;
    outcome.after = culled.count();
    EXPECT_LT(outcome.after, outcome.before);
    for_each_block(tile, [&](const PacketBlock& block) {
      RayPacket rays;
      make_block_rays(whole_.frame(), block, rays);
      const PacketHits by_all = trace(list, rays, block.lanes, boundary);
      const PacketHits by_few = trace(culled, rays, block.lanes, boundary);
      // What is behind a cut counts only on rays that hit nothing before it.
      const LaneMask lanes = cuts ? by_few.hits : block.lanes;
      EXPECT_EQ(by_all.hits & lanes, by_few.hits & lanes);
      for (uint32_t lane = 0; lane < kPacketRays; ++lane) {
        if (!(by_few.hits >> lane & 1)) continue;
        ++outcome.hits;
        EXPECT_EQ(by_few.t[lane], by_all.t[lane]);
        EXPECT_EQ(culled.primitive[by_few.index[lane]], list.primitive[by_all.index[lane]]);
      }
    });
    return outcome;
  }

 private:
  /// Makes the tile's list, with all groups expanded. Returns false if the list is constant.
  bool restrict_to(const Tile& tile, CellList& list) {
    const OperandGroups& groups = solid_.groups();
    const Box box = box_of(tile, true);
    restrictor_.restrict(groups.list(), box, list);
    for (;;) {
      std::vector<uint8_t> marked;
      for (const uint32_t entry : list.primitives()) {
        marked.push_back(groups.is_group(entry & kPrimitiveBits));
      }
      if (std::ranges::count(marked, 1) == 0) return !list.is_constant();
      const CellList closed = list;
      restrictor_.open(closed, groups, marked, box, list);
    }
  }

  PacketHits trace(const CellList& list, const RayPacket& rays, LaneMask lanes, Boundary boundary) {
    PacketHits hits;
    if (list.is_constant()) return hits;
    const std::vector<double> nearest(list.count(), -std::numeric_limits<double>::max());
    TraceList trace_list = whole_.list();
    trace_list.list = &list;
    trace_list.nearest_t = nearest.data();
    const TraceParameters parameters{thickness_tolerance(solid_.bounds()), boundary};
    trace_packet(whole_.frame(), rays, lanes, trace_list, parameters, nullptr, workspace_, hits);
    return hits;
  }

  const Solid solid_;
  checks::WholeList whole_;
  ScreenBounds bounds_;
  Restrictor restrictor_;
  TileCuller culler_;
  PacketWorkspace workspace_;
};

class Culler : public testing::TestWithParam<Boundary> {};

TEST_P(Culler, DropsOnlyWhatItsRaysDoNotSee) {
  const Boundary boundary = GetParam();
  // Where rays go on, what they meet first hides nothing.
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
      Simplifying culling(scene, view, last_value);
      for (uint32_t y = 0; y < kSide_px; y += kTile_px) {
        for (uint32_t x = 0; x < kSide_px; x += kTile_px) {
          const auto outcome = culling.expect_same_hits({x, y, kTile_px, kTile_px}, boundary);
          if (outcome.hits > 0) dropped += outcome.before - outcome.after;
          hits += outcome.hits;
        }
      }
    }
  }
  EXPECT_GT(dropped, 200u);
  EXPECT_GT(hits, 10000u);
}

/// The rims of walls that are too thin to exist. Rays are inside them for long enough to be found
/// to end there. Behind them are many needles that rays meet end on, in front of them some more,
/// and at last a ball.
TEST(Cuts, AWallThatDoesNotExistHidesNothing) {
  // It is less than the tolerance of such a scene, 1e-9 of its size. Some tens of pixels are small
  // compared with it, so that all their rays leave a wall at about one depth.
  constexpr double kThickness = 2e-8;
  constexpr double kPixel = 1e-10;
  const Mat3 lying{Vec3(0, 1, 0), Vec3(0, 0, 1), Vec3(1, 0, 0)};
  const uint32_t seeds = test_support::sample_size(60);
  uint64_t behind = 0;
  for (uint32_t seed = 1; seed <= seeds; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const bool is_one_tile = seed % 2 == 0;
    const double half_px = is_one_tile ? 4 : uniform(random, 4, 40);
    std::vector<Primitive> primitives;
    // The needles are in the order of a quadtree, so close to each other that groups do not
    // separate them.
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
    // A ball beside the picture makes the size more than 21 in any case.
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
  EXPECT_GT(behind, 16 * seeds);
}

INSTANTIATE_TEST_SUITE_P(Tiles, Culler, testing::Values(Boundary::kFirst, Boundary::kBehind),
                         [](const auto& boundary) {
                           return boundary.param == Boundary::kFirst ? "First" : "Behind";
                         });

}  // namespace
}  // namespace csgcore
