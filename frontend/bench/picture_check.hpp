// Compares pictures of different renderers before they are timed.
#pragma once

#include <cstdint>

#include "csgcore/image.hpp"

namespace bench {

/// Counts the pixels of `image` that show another face than `exact`, or a face where the other
/// shows none. Precondition: both have the same size, and measured channels.
uint64_t wrong_pixels(const csgcore::Image& image, const csgcore::Image& exact);

/// Returns whether every channel is the same, bit for bit.
bool is_same(const csgcore::Image& a, const csgcore::Image& b);

/// Returns whether the rounding of float explains so many wrong pixels in an OpenGL picture of
/// `hits` hits.
bool float_explains(uint64_t wrong_pixels, uint64_t hits);

}  // namespace bench
