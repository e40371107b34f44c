// Tests the triangles of figures with holes.
#include <gtest/gtest.h>

#include <map>
#include <utility>

#include "meshes/triangulation.hpp"

namespace frontend {
namespace {

using glm::dvec2;
using Rings = std::vector<std::vector<uint32_t>>;

struct Faces {
  double area = 0;
  double folded = 0;                                   // of the triangles that run clockwise
  std::map<std::pair<uint32_t, uint32_t>, int> edges;  // how often each is passed, less its twin
};

Faces faces_of(const Rings& rings, const std::vector<dvec2>& places) {
  std::vector<uint32_t> corners, ends;
  std::vector<dvec2> corner_places;
  for (const std::vector<uint32_t>& ring : rings) {
    for (const uint32_t corner : ring) {
      corners.push_back(corner);
      corner_places.push_back(places[corner]);
    }
    ends.push_back(static_cast<uint32_t>(corners.size()));
  }
  std::vector<std::array<uint32_t, 3>> triangles;
  triangulate_all(corners, ends, corner_places, triangles);
  Faces result;
  for (const auto& triangle : triangles) {
    const dvec2 &a = places[triangle[0]], &b = places[triangle[1]], &c = places[triangle[2]];
    const double area = ((b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y)) / 2;
    (area < 0 ? result.folded : result.area) += std::abs(area);
    for (size_t i = 0; i < 3; ++i) {
      const uint32_t from = triangle[i], to = triangle[(i + 1) % 3];
      ++result.edges[{from, to}];
      --result.edges[{to, from}];
    }
  }
  std::erase_if(result.edges, [](const auto& edge) { return edge.second <= 0; });
  return result;
}

size_t edge_count(const Rings& rings) {
  size_t count = 0;
  for (const auto& ring : rings) count += ring.size();
  return count;
}

void add_square(double x, double y, double size, bool is_hole, Rings& rings,
                std::vector<dvec2>& places) {
  const auto first = static_cast<uint32_t>(places.size());
  const double far = size;
  places.insert(places.end(), {{x, y}, {x + far, y}, {x + far, y + far}, {x, y + far}});
  rings.push_back(is_hole ? std::vector<uint32_t>{first, first + 3, first + 2, first + 1}
                          : std::vector<uint32_t>{first, first + 1, first + 2, first + 3});
}

TEST(RingFaces, HaveTheRingsForTheirBoundary) {
  Rings rings;
  std::vector<dvec2> places;
  add_square(0, 0, 10, false, rings, places);
  for (const double y : {1.0, 4.0, 7.0}) {
    for (const double x : {1.0, 4.0, 7.0}) add_square(x, y, 2, true, rings, places);
  }
  add_square(4.5, 4.5, 1, false, rings, places);  // an island
  const Faces faces = faces_of(rings, places);
  EXPECT_DOUBLE_EQ(faces.area, 100 - 9 * 4 + 1);
  EXPECT_EQ(faces.folded, 0);
  EXPECT_EQ(faces.edges.size(), edge_count(rings));
}

TEST(RingFaces, TakeAHoleBehindACorner) {
  // The corner at (6, 3) stands between the hole and the side that it looks at.
  const std::vector<dvec2> places{{0, 0}, {10, 0}, {10, 8}, {6, 3}, {5, 8},
                                  {0, 8}, {1, 2},  {1, 4},  {3, 3}};
  const Rings rings{{0, 1, 2, 3, 4, 5}, {6, 7, 8}};
  const Faces faces = faces_of(rings, places);
  EXPECT_EQ(faces.folded, 0);
  EXPECT_EQ(faces.edges.size(), edge_count(rings));
  EXPECT_DOUBLE_EQ(faces.area, 80 - 12.5 - 2);
}

}  // namespace
}  // namespace frontend
