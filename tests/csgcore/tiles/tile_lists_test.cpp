// Tests the lists of screen tiles: along every ray of a tile they equal the whole solid's list.
#include "csgcore/tile_lists.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "csgcore/view.hpp"
#include "solid/operand_groups.hpp"
#include "support/models.hpp"
#include "trace_scenes.hpp"

namespace csgcore {
namespace {

constexpr uint32_t kWidth_px = 37;
constexpr uint32_t kHeight_px = 26;
/// Points that are tested on a ray.
constexpr int kDepths = 40;

TileListOptions options_of(const Solid& solid) {
  TileListOptions options;
  options.thickness_tolerance = 1e-6 * solid.bounds().diagonal();
  return options;
}

bool holds(const TileLists& lists, const ListedTile& tile, const Solid& solid, const Vec3& point) {
  const auto tests = std::span(lists.tests).subspan(tile.first_test, tile.test_count);
  return evaluate(
      tests, [&](uint32_t primitive) { return contains(solid.primitives()[primitive], point); });
}

/// Returns the depths between which a ray is tested.
std::pair<double, double> depths_of(const View& view, const Solid& solid) {
  const double middle = glm::dot(solid.bounds().center() - view.eye, view.forward);
  const double reach = solid.bounds().diagonal();
  const bool perspective = view.projection == Projection::kPerspective;
  return {perspective ? std::max(middle - reach, 1e-3 * reach) : middle - reach, middle + reach};
}

struct Found {
  uint64_t points = 0, inside = 0, cut_tiles = 0;
};

/// Fails if a tile's list differs from the solid at a point in front of its cut, or if there is
/// anything outside all tiles. `offset` is that of the rays from the pixels' centres.
void expect_the_solid(const Solid& solid, const View& view, const TileLists& lists,
                      const std::array<double, 2>& offset, Found& found) {
  std::vector<const ListedTile*> tile_of(size_t{kWidth_px} * kHeight_px);
  for (const ListedTile& tile : lists.tiles) {
    ASSERT_GT(tile.test_count, 0u);
    found.cut_tiles += std::isfinite(tile.cut_s);
    for (uint32_t y = tile.area.y; y < tile.area.y + tile.area.height; ++y) {
      for (uint32_t x = tile.area.x; x < tile.area.x + tile.area.width; ++x) {
        const ListedTile*& place = tile_of[size_t{y} * kWidth_px + x];
        ASSERT_EQ(place, nullptr) << "two tiles";
        place = &tile;
      }
    }
  }
  const auto [from_s, to_s] = depths_of(view, solid);
  const bool starts_inside =
      view.projection == Projection::kPerspective && solid.contains(view.eye);
  for (uint32_t y = 0; y < kHeight_px; ++y) {
    for (uint32_t x = 0; x < kWidth_px; ++x) {
      const ListedTile* tile = tile_of[size_t{y} * kWidth_px + x];
      const Ray ray = pixel_ray(view, x + offset[0], y + offset[1]);
      for (int i = 0; i < kDepths; ++i) {
        const double s = from_s + (to_s - from_s) * (i + 0.37) / kDepths;
        if (tile && s > tile->cut_s) break;
        const Vec3 point = ray.origin + s * ray.direction;
        const bool expected = solid.contains(point);
        const bool listed = tile && holds(lists, *tile, solid, point);
        ASSERT_EQ(listed, expected) << x << ", " << y << " at " << s;
        ++found.points;
        found.inside += expected;
      }
      if (!tile || !std::isfinite(tile->cut_s)) continue;
      // The value there is not the one that the ray starts with.
      const Vec3 point = ray.origin + tile->cut_s * ray.direction;
      ASSERT_NE(solid.contains(point), starts_inside) << x << ", " << y << ": cut";
    }
  }
}

class TileListsTest : public testing::TestWithParam<const char*> {};

INSTANTIATE_TEST_SUITE_P(, TileListsTest, testing::Values("spheres", "cones", "tree", "crowd"),
                         [](const auto& instance) { return std::string(instance.param); });

Scene scene_of(const std::string& name) {
  if (name == "spheres") return test_support::cylinder_minus_spheres(200);
  if (name == "cones") return test_support::cylinder_minus_cones(100);
  if (name == "tree") return test_support::random_tree(30, 7);
  return checks::crowd(3);
}

TEST_P(TileListsTest, SayWhatTheSolidSays) {
  const Scene scene = scene_of(GetParam());
  const Solid solid(canonical_primitives(scene), scene.model);
  ASSERT_FALSE(solid.bounds().empty());
  Found found;
  for (const auto& [name, view] : checks::trace_views(solid.bounds(), kWidth_px, kHeight_px)) {
    SCOPED_TRACE(name);
    TileListOptions options = options_of(solid);
    TileLists lists;
    ASSERT_TRUE(list_tiles(solid, view, options, lists));
    expect_the_solid(solid, view, lists, {0, 0}, found);
    if (HasFatalFailure()) return;
    // The same for rays anywhere in the pixels.
    options.centers_only = false;
    ASSERT_TRUE(list_tiles(solid, view, options, lists));
    for (uint32_t sample = 0; sample < 2; ++sample) {
      expect_the_solid(solid, view, lists, sample_offset(sample, 2), found);
      if (HasFatalFailure()) return;
    }
    // Behind a front the whole ray counts.
    options.boundary = Boundary::kBehind;
    ASSERT_TRUE(list_tiles(solid, view, options, lists));
    Found behind;
    expect_the_solid(solid, view, lists, {0.4, -0.4}, behind);
    if (HasFatalFailure()) return;
    EXPECT_EQ(behind.cut_tiles, 0u);
  }
  EXPECT_GT(found.inside, 1000u);
  if (GetParam() == std::string("spheres")) {
    EXPECT_GT(found.cut_tiles, 10u) << "nothing is hidden";
  }
}

TEST_P(TileListsTest, DoNotDependOnThreads) {
  const Scene scene = scene_of(GetParam());
  const Solid solid(canonical_primitives(scene), scene.model);
  const auto views = checks::trace_views(solid.bounds(), 320, 240);
  TileListOptions options = options_of(solid);
  options.threads = 1;
  TileLists one;
  ASSERT_TRUE(list_tiles(solid, views.front().view, options, one));
  ASSERT_GT(one.tiles.size(), 100u);
  for (const unsigned threads : {0u, 2u, 5u}) {
    options.threads = threads;
    TileLists many;
    ASSERT_TRUE(list_tiles(solid, views.front().view, options, many));
    EXPECT_TRUE(one.tests == many.tests);
    ASSERT_EQ(one.tiles.size(), many.tiles.size());
    for (size_t i = 0; i < one.tiles.size(); ++i) {
      EXPECT_TRUE(one.tiles[i].area == many.tiles[i].area);
      EXPECT_EQ(one.tiles[i].first_test, many.tiles[i].first_test);
      EXPECT_EQ(one.tiles[i].cut_s, many.tiles[i].cut_s);
    }
  }
}

TEST(TileLists, LongOnesAreOfSmallTiles) {
  const Scene scene = test_support::cylinder_minus_spheres(3000);
  const Solid solid(canonical_primitives(scene), scene.model);
  View view = checks::trace_views(solid.bounds(), 320, 240).front().view;
  TileListOptions options = options_of(solid);
  options.short_list = 8;
  uint32_t longest = 0;
  TileLists lists;
  ASSERT_TRUE(list_tiles(solid, view, options, lists));
  for (const ListedTile& tile : lists.tiles) {
    longest = std::max(longest, tile.test_count);
    EXPECT_GE(tile.area.width * tile.area.height, 32u);
  }
  options.longest_list = longest * 3 / 4;
  ASSERT_GT(options.longest_list, options.short_list);
  ASSERT_TRUE(list_tiles(solid, view, options, lists));
  uint64_t small = 0;
  for (const ListedTile& tile : lists.tiles) {
    EXPECT_LE(tile.test_count, options.longest_list);
    if (tile.test_count > options.short_list) {
      EXPECT_LE(tile.area.width * tile.area.height, 32u);
    }
    small += tile.area.width * tile.area.height < 32;
  }
  EXPECT_GT(small, 0u);
}

TEST(TileLists, ListsThatNoDivisionMakesShortEnoughAreRefused) {
  std::vector<Primitive> spheres;
  for (int i = 0; i < 40000; ++i) spheres.push_back(make_sphere(1 + 1e-6 * i));
  const Scene scene = test_support::scene_of(Op::kIntersection, std::move(spheres));
  const Solid solid(canonical_primitives(scene), scene.model);
  const View view = checks::trace_views(solid.bounds(), 640, 480).front().view;
  TileListOptions options = options_of(solid);
  options.longest_list = 128;
  TileLists lists;
  EXPECT_FALSE(list_tiles(solid, view, options, lists));
  EXPECT_TRUE(lists.tiles.empty());
  EXPECT_TRUE(lists.tests.empty());
}

TEST(TileLists, OfNothingAreNone) {
  const Scene nothing = test_support::scene_of(
      Op::kIntersection, {make_sphere(1), make_sphere(1, checks::moved({5, 0, 0}))});
  const Solid solid(canonical_primitives(nothing), nothing.model);
  TileListOptions options;
  options.thickness_tolerance = 1e-6;
  TileLists lists;
  EXPECT_TRUE(list_tiles(solid, View{}, options, lists));
  EXPECT_TRUE(lists.tiles.empty());
}

}  // namespace
}  // namespace csgcore
