// The tiles of the screen, as instances for the GPU.
#pragma once

#include "csgcore/tile_lists.hpp"
#include "frame.hpp"
#include "traversal.hpp"

namespace glrender {

/// Throws ListsTooLong.
[[noreturn]] void refuse_lists();

/// Adds all tiles to the front faces, by the path of their lists. `eye_inside` as in
/// InstanceSorter; no list is longer than kLongList. Throws ListsTooLong.
void add_tiles(const csgcore::TileLists& lists, const Frame& frame, const csgcore::Solid& solid,
               bool eye_inside, InstanceStreams& streams);

}  // namespace glrender
