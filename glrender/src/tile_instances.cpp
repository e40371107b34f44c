#include "tile_instances.hpp"

#include <span>

#include "glrender/context.hpp"

namespace glrender {
namespace {

using csgcore::BlistTest;
using csgcore::ListedTile;

/// Every segment is found once, and the Blist is evaluated before and behind each segment's ends.
bool is_too_long(const csgcore::Solid& solid, std::span<const BlistTest> tests) {
  const uint64_t evaluations = 2 * tests.size() + 2;
  return rounds(solid, tests) + evaluations * tests.size() > kMostTileRounds;
}

Path path_of(const csgcore::Solid& solid, std::span<const BlistTest> tests, bool eye_inside) {
  if (tests.size() == 1 && !eye_inside && are_convex(solid, tests)) return Path::kSingle;
  if (tests.size() <= short_list(false, true)) return Path::kShortList;
  if (is_too_long(solid, tests)) refuse_lists();
  return Path::kLongList;
}

}  // namespace

void refuse_lists() {
  throw ListsTooLong(
      "more primitives lie behind each other on the screen than OpenGL can evaluate for a pixel "
      "(draw by cells)");
}

void add_tiles(const csgcore::TileLists& lists, const Frame& frame, const csgcore::Solid& solid,
               bool eye_inside, InstanceStreams& streams) {
  for (const ListedTile& tile : lists.tiles) {
    const std::span<const BlistTest> tests =
        std::span(lists.tests).subspan(tile.first_test, tile.test_count);
    const auto x = static_cast<float>(tile.area.x);
    const auto y = static_cast<float>(tile.area.y);
    const auto cut_t = static_cast<float>(tile.cut_s - frame.eye_distance);
    streams.front_faces[static_cast<size_t>(path_of(solid, tests, eye_inside))].push_back(
        {{x, y, cut_t},
         {x + static_cast<float>(tile.area.width), y + static_cast<float>(tile.area.height), 0},
         tile.first_test,
         tile.test_count});
  }
}

}  // namespace glrender
