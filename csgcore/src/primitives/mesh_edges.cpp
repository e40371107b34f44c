#include "primitives/mesh_edges.hpp"

#include <tbb/parallel_sort.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "csgcore/stop_scope.hpp"

namespace csgcore {
namespace {

using Triangle = EdgedTriangle;

/// Spreads a number over all 64 bits (the finaliser of SplitMix64: Steele, Lea, Flood 2014).
uint64_t mixed(uint64_t x) {
  x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9u;
  x = (x ^ (x >> 27)) * 0x94D049BB133111EBu;
  return x ^ (x >> 31);
}

/// An edge in either direction.
uint64_t key_of(uint32_t a, uint32_t b) {
  return a < b ? uint64_t{a} << 32 | b : uint64_t{b} << 32 | a;
}

/// One of a triangle's edges.
struct SideOfTriangle {
  uint64_t key;
  uint32_t triangle;
  bool is_forwards;  // from the lower vertex to the higher one
};

std::vector<SideOfTriangle> sorted_sides(std::span<const Triangle> triangles) {
  std::vector<SideOfTriangle> sides;
  sides.reserve(3 * triangles.size());
  for (uint32_t i = 0; i < triangles.size(); ++i) {
    for (size_t k = 0; k < 3; ++k) {
      const uint32_t a = triangles[i][k], b = triangles[i][(k + 1) % 3];
      sides.push_back({key_of(a, b), i, a < b});
    }
  }
  stop_point();
  tbb::parallel_sort(sides.begin(), sides.end(),
                     [](const SideOfTriangle& a, const SideOfTriangle& b) {
                       return a.key != b.key ? a.key < b.key : a.triangle < b.triangle;
                     });
  stop_point();
  return sides;
}

/// Calls visit(sides) with the sides along each edge.
template <typename Visit>
void for_each_edge(std::span<const SideOfTriangle> sides, const Visit& visit) {
  for (size_t begin = 0, end = 0; begin < sides.size(); begin = end) {
    while (end < sides.size() && sides[end].key == sides[begin].key) ++end;
    visit(sides.subspan(begin, end - begin));
  }
}

}  // namespace

bool is_balanced(std::span<const Triangle> triangles) {
  uint64_t sums[2] = {};
  for (const Triangle& triangle : triangles) {
    for (size_t k = 0; k < 3; ++k) {
      const uint32_t a = triangle[k], b = triangle[(k + 1) % 3];
      const uint64_t first = mixed(key_of(a, b) + 0x9E3779B97F4A7C15u);
      const uint64_t second = mixed(first + 0x9E3779B97F4A7C15u);
      sums[0] += a < b ? first : ~first + 1;
      sums[1] += a < b ? second : ~second + 1;
    }
  }
  return sums[0] == 0 && sums[1] == 0;
}

uint64_t count_open_edges(std::span<const Triangle> triangles) {
  if (is_balanced(triangles)) return 0;
  uint64_t open = 0;
  for_each_edge(sorted_sides(triangles), [&open](std::span<const SideOfTriangle> sides) {
    const auto forwards = std::ranges::count_if(sides, &SideOfTriangle::is_forwards);
    if (2 * static_cast<size_t>(forwards) != sides.size()) ++open;
  });
  return open;
}

void face_alike(std::span<Triangle> triangles) {
  struct Neighbour {
    uint32_t triangle;
    bool faces_alike;
  };
  constexpr uint32_t kNone = 0xFFFFFFFFu;
  std::vector<std::array<Neighbour, 3>> neighbours(
      triangles.size(), {Neighbour{kNone, true}, Neighbour{kNone, true}, Neighbour{kNone, true}});
  const auto add = [&](uint32_t triangle, const Neighbour& neighbour) {
    for (Neighbour& place : neighbours[triangle]) {
      if (place.triangle != kNone) continue;
      place = neighbour;
      return;
    }
  };
  for_each_edge(sorted_sides(triangles), [&](std::span<const SideOfTriangle> sides) {
    if (sides.size() != 2) return;
    const bool alike = sides[0].is_forwards != sides[1].is_forwards;
    add(sides[0].triangle, {sides[1].triangle, alike});
    add(sides[1].triangle, {sides[0].triangle, alike});
  });
  std::vector<uint8_t> is_seen(triangles.size()), is_turned(triangles.size());
  std::vector<uint32_t> part;
  for (uint32_t first = 0; first < triangles.size(); ++first) {
    if (is_seen[first]) continue;
    stop_point();
    part.assign(1, first);
    is_seen[first] = 1;
    size_t turned = 0;
    for (size_t i = 0; i < part.size(); ++i) {
      for (const Neighbour& neighbour : neighbours[part[i]]) {
        if (neighbour.triangle == kNone || is_seen[neighbour.triangle]) continue;
        is_seen[neighbour.triangle] = 1;
        is_turned[neighbour.triangle] = is_turned[part[i]] != (neighbour.faces_alike ? 0 : 1);
        turned += is_turned[neighbour.triangle];
        part.push_back(neighbour.triangle);
      }
    }
    const bool turns_others = 2 * turned > part.size();
    for (const uint32_t triangle : part) {
      if ((is_turned[triangle] != 0) == turns_others) continue;
      std::swap(triangles[triangle][1], triangles[triangle][2]);
    }
  }
}

}  // namespace csgcore
