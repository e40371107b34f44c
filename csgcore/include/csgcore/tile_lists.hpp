// What the rays of each tile of the screen can meet: the tracer's tiles (tracer.hpp), for renderers
// that evaluate lists themselves.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "csgcore/blist.hpp"
#include "csgcore/hits.hpp"
#include "csgcore/solid.hpp"
#include "csgcore/view.hpp"

namespace csgcore {

struct TileListOptions {
  Boundary boundary = Boundary::kFirst;
  /// Rays go through the pixels' centres only, not through any point of them.
  bool centers_only = true;
  /// The renderer's own: how much closer to the eye a surface may lie before it counts as that much
  /// beyond it. World units, > 0.
  double thickness_tolerance = 0;
  /// Tiles of 8 pixels with longer lists are divided once more, to 8×4; those with lists longer
  /// than the second down to 2×2, and if that does not help either, there is no result.
  uint32_t short_list = 32;
  uint32_t longest_list = std::numeric_limits<uint32_t>::max();
  /// Worker threads; 0: as many as there are. The lists do not depend on it.
  unsigned threads = 0;
};

struct ListedTile {
  PixelArea area;
  /// Of TileLists::tests, a function that equals the solid's wherever the tile's rays go, up to
  /// cut_s. Not constant. For first boundaries it may also hold in voids that the solid encloses,
  /// which no ray from outside gets to.
  uint32_t first_test = 0;
  uint32_t test_count = 0;
  /// View's s at which every ray of the tile has met its first boundary: the function is without
  /// what lies behind it. +∞: it is without nothing.
  double cut_s = 0;
};

struct TileLists {
  /// Those with anything to meet, row by row from the top left corner, each from its own.
  std::vector<ListedTile> tiles;
  std::vector<BlistTest> tests;
};

/// Replaces `lists`; false, with nothing in them, if one would be longer than the longest.
bool list_tiles(const Solid& solid, const View& view, const TileListOptions& options,
                TileLists& lists);

}  // namespace csgcore
