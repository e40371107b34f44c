// The positions of samples within a pixel: one fixed pattern for all pixels and all renderers, so
// that pictures are deterministic and comparable.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace csgcore {

/// Returns the offset of sample i of n, 0 ≤ i < n, from the pixel's centre, in pixels (x to the
/// right, y downwards), each in (−½, ½). A single sample lies at the centre.
///
/// The pattern is a Fibonacci lattice. It is evenly spaced in x, so that an upright edge is seen in
/// n steps of equal size. In y it takes multiples of the golden ratio modulo 1, which are all
/// different and whose gaps have at most three sizes (Niederreiter, Random Number Generation and
/// Quasi-Monte Carlo Methods, 1992, chapter 5). A half-turn about the centre maps the pattern onto
/// itself, so that on average no edge is shifted.
inline std::array<double, 2> sample_offset(uint32_t i, uint32_t n) {
  // Counting from the middle sample makes the half-turn's symmetry exact to the bit.
  const double from_middle = i - 0.5 * (n - 1.0);
  const double y = from_middle * (std::numbers::phi - 1);  // 1/φ
  return {from_middle / n, y - std::round(y)};
}

}  // namespace csgcore
