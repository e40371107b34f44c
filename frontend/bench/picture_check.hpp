// Pictures of different renderers, held against each other before they are timed.
#pragma once

#include <cstdint>

#include "csgcore/image.hpp"

namespace bench {

/// Of pictures with measured channels: pixels that show another face, or a face where the other
/// picture shows none. Precondition: they have the same size.
uint64_t wrong_pixels(const csgcore::Image& image, const csgcore::Image& exact);

/// Every channel is, bit for bit.
bool is_same(const csgcore::Image& a, const csgcore::Image& b);

/// Whether float explains that a picture of so many hits by OpenGL has wrong pixels.
bool float_explains(uint64_t wrong_pixels, uint64_t hits);

}  // namespace bench
