// The tracer's tiles (tracer.hpp), each with the list that its rays need, for renderers that
// evaluate lists themselves.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "csgcore/blist.hpp"
#include "csgcore/image.hpp"
#include "csgcore/solid.hpp"
#include "csgcore/view.hpp"

namespace csgcore {

struct TileListOptions {
  Boundary boundary = Boundary::kFirst;
  /// True: rays go through the pixels' centres only. False: they may go through any point of a
  /// pixel.
  bool centers_only = true;
  /// The thickness tolerance that the renderer draws with (NUMERICS.md, "The definition"). World
  /// units, > 0.
  double thickness_tolerance = 0;
  /// A tile of 8×8 pixels is divided once more, to 8×4, if its list is longer than short_list.
  /// Tiles with lists longer than longest_list are divided down to 2×2 pixels; if a list is still
  /// longer then, list_tiles() fails.
  uint32_t short_list = 32;
  uint32_t longest_list = std::numeric_limits<uint32_t>::max();
  /// Number of worker threads; 0: as many as there are. The lists do not depend on it.
  unsigned threads = 0;
};

struct ListedTile {
  PixelArea area;
  /// The range of TileLists::tests that is the tile's list. Along the tile's rays, it has the
  /// solid's values up to cut_s. It is not empty; its jump targets count from first_test.
  uint32_t first_test = 0;
  uint32_t test_count = 0;
  /// A value of View's s before which every ray of the tile has ended (see Boundary). The list may
  /// lack primitives behind it. +∞: it lacks none.
  double cut_s = 0;
};

struct TileLists {
  /// The tiles whose lists are not constant, in the order of their top left corners: row by row,
  /// and from left to right.
  std::vector<ListedTile> tiles;
  std::vector<BlistTest> tests;
};

/// Replaces `lists`. Returns false, and leaves them empty, if a list would be longer than
/// longest_list.
bool list_tiles(const Solid& solid, const View& view, const TileListOptions& options,
                TileLists& lists);

}  // namespace csgcore
