// The tiles of the screen, as instances for the GPU.
#pragma once

#include "csgcore/tile_lists.hpp"
#include "frame.hpp"
#include "traversal.hpp"

namespace glrender {

/// Throws ListsTooLong.
[[noreturn]] void refuse_lists();

/// Adds all tiles to the front faces, each by the path of its list. `eye_inside` means what it
/// means in InstanceSorter. Throws ListsTooLong. Precondition: no list is longer than kLongList.
void add_tiles(const csgcore::TileLists& lists, const Frame& frame, const csgcore::Solid& solid,
               bool eye_inside, InstanceStreams& streams);

}  // namespace glrender
