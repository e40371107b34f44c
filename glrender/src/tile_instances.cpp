#include "tile_instances.hpp"

#include <span>

#include "glrender/context.hpp"

namespace glrender {
namespace {

using csgcore::ListedTile;
using csgcore::Literal;

/// Every segment is found once, and the function evaluated before and behind each of its ends.
bool is_too_long(const csgcore::Solid& solid, std::span<const Literal> literals) {
  const uint64_t evaluations = 2 * literals.size() + 2;
  return rounds(solid, literals) + evaluations * literals.size() > kMostTileRounds;
}

Path path_of(const csgcore::Solid& solid, std::span<const Literal> literals, bool eye_inside) {
  if (literals.size() == 1 && !eye_inside) return Path::kSingle;
  if (literals.size() <= short_list(false, true)) return Path::kShortList;
  if (is_too_long(solid, literals)) refuse_lists();
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
    const std::span<const Literal> literals =
        std::span(lists.literals).subspan(tile.first_literal, tile.literal_count);
    const auto x = static_cast<float>(tile.area.x);
    const auto y = static_cast<float>(tile.area.y);
    const auto cut_t = static_cast<float>(tile.cut_s - frame.eye_distance);
    streams.front_faces[static_cast<size_t>(path_of(solid, literals, eye_inside))].push_back(
        {{x, y, cut_t},
         {x + static_cast<float>(tile.area.width), y + static_cast<float>(tile.area.height), 0},
         tile.first_literal,
         tile.literal_count});
  }
}

}  // namespace glrender
