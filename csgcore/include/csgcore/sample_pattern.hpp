// Where within a pixel its samples lie: one fixed pattern for all pixels and all renderers, so that
// pictures are deterministic and comparable.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace csgcore {

/// Sample i of n, 0 ≤ i < n: its offset from the pixel's centre, in pixels (x to the right, y
/// downwards), each in (−½, ½). A single sample is the centre.
///
/// A Fibonacci lattice: evenly spaced in x, so that an upright edge is seen in n steps of equal
/// size, and in y multiples of the golden ratio modulo 1, no two of which are equal and whose gaps
/// take at most three sizes (Niederreiter, Random Number Generation and Quasi-Monte Carlo Methods,
/// 1992, chapter 5). A half-turn about the centre maps the pattern onto itself, so that on the
/// average no edge is shifted.
inline std::array<double, 2> sample_offset(uint32_t i, uint32_t n) {
  // From the middle sample, so that the half-turn holds bit for bit.
  const double from_middle = i - 0.5 * (n - 1.0);
  const double y = from_middle * (std::numbers::phi - 1);  // 1/φ
  return {from_middle / n, y - std::round(y)};
}

}  // namespace csgcore
