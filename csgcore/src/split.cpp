#include "split.hpp"

#include <algorithm>
#include <array>

namespace csgcore {
namespace {

/// Planes per axis are kBins − 1: more of them cost more to count than the better plane saves.
constexpr int kBins = 8;

double area(const Vec3& size) { return size.x * size.y + size.y * size.z + size.z * size.x; }

int bin_of(double value, double low, double scale) {
  const double bin = (value - low) * scale;
  return bin <= 0 ? 0 : (bin >= kBins ? kBins - 1 : static_cast<int>(bin));
}

}  // namespace

Split cyclic_split(const Box& cell, uint32_t depth) {
  const uint32_t axis = depth % 3;
  return {axis, cell.center()[axis]};
}

Split surface_area_split(std::span<const CanonicalPrimitive> primitives,
                         std::span<const Literal> literals, const Box& cell) {
  std::array<std::array<uint32_t, kBins>, 3> starts{};  // per axis and bin: boxes that begin there
  std::array<std::array<uint32_t, kBins>, 3> ends{};
  const Vec3 size = cell.size();
  const Vec3 scale = double(kBins) / size;
  for (const Literal& literal : literals) {
    const Box& bounds = primitives[literal.primitive].bounds;
    for (int axis = 0; axis < 3; ++axis) {
      ++starts[axis][bin_of(bounds.min[axis], cell.min[axis], scale[axis])];
      ++ends[axis][bin_of(bounds.max[axis], cell.min[axis], scale[axis])];
    }
  }
  const uint32_t longest = size.x >= size.y ? (size.x >= size.z ? 0 : 2) : (size.y >= size.z ? 1 : 2);
  Split best{longest, cell.center()[longest]};
  // The middle of the longest axis is what a plane must beat: both halves with all primitives.
  Vec3 half = size;
  half[longest] *= 0.5;
  double best_cost = 2.0 * area(half) * static_cast<double>(literals.size());
  for (uint32_t axis = 0; axis < 3; ++axis) {
    uint32_t below = 0;
    uint32_t above = static_cast<uint32_t>(literals.size());
    for (int plane = 1; plane < kBins; ++plane) {
      below += starts[axis][plane - 1];
      above -= ends[axis][plane - 1];
      Vec3 lower = size;
      lower[axis] = size[axis] * plane / kBins;
      Vec3 upper = size;
      upper[axis] = size[axis] - lower[axis];
      const double cost = area(lower) * below + area(upper) * above;
      if (cost < best_cost) {
        best_cost = cost;
        best = {axis, cell.min[axis] + lower[axis]};
      }
    }
  }
  return best;
}

}  // namespace csgcore
