#include "solids/surface_edges.hpp"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <limits>
#include <tuple>
#include <utility>

namespace frontend {
namespace {

using csgcore::TriangleSet;
using csgcore::Vec3;

/// A triangle's side.
struct TriangleSide {
  uint32_t least, most;
  uint32_t triangle;
  uint32_t corner;  // where the side starts
};

std::vector<TriangleSide> sides_of(const TriangleSet& surface) {
  std::vector<TriangleSide> sides;
  sides.reserve(3 * surface.triangles.size());
  for (uint32_t t = 0; t < surface.triangles.size(); ++t) {
    const auto& triangle = surface.triangles[t];
    for (uint32_t k = 0; k < 3; ++k) {
      const auto [least, most] = std::minmax(triangle[k], triangle[(k + 1) % 3]);
      sides.push_back({least, most, t, k});
    }
  }
  std::ranges::sort(sides, [](const TriangleSide& a, const TriangleSide& b) {
    return std::tuple(a.least, a.most, a.triangle) < std::tuple(b.least, b.most, b.triangle);
  });
  return sides;
}

double height_over(const TriangleSet& surface, uint32_t triangle, uint32_t vertex) {
  const auto& t = surface.triangles[triangle];
  const Vec3& corner = surface.vertices[t[0]];
  const Vec3 normal = glm::cross(surface.vertices[t[1]] - corner, surface.vertices[t[2]] - corner);
  const double length = glm::length(normal);
  if (length == 0) return 0;
  return glm::dot(normal / length, surface.vertices[vertex] - corner);
}

}  // namespace

std::vector<SurfaceEdge> edges_of(const TriangleSet& surface) {
  const std::vector<TriangleSide> sides = sides_of(surface);
  const auto is_same = [&](size_t i, size_t j) {
    return sides[i].least == sides[j].least && sides[i].most == sides[j].most;
  };
  std::vector<SurfaceEdge> edges;
  edges.reserve(sides.size() / 2);
  for (size_t i = 0; i + 1 < sides.size(); i += 2) {
    const TriangleSide &left = sides[i], &right = sides[i + 1];
    const auto &a = surface.triangles[left.triangle], &b = surface.triangles[right.triangle];
    const bool is_shared = (i > 0 && is_same(i - 1, i)) || !is_same(i, i + 1) ||
                           (i + 2 < sides.size() && is_same(i + 1, i + 2));
    double height = std::numeric_limits<double>::infinity();
    if (!is_shared) {
      height = height_over(surface, left.triangle, b[(right.corner + 2) % 3]);
      // Along a narrow ledge the solid turns inwards by no more than its width.
      if (height > 0) {
        height = std::min(height, height_over(surface, right.triangle, a[(left.corner + 2) % 3]));
      }
    }
    edges.push_back(
        {a[left.corner], a[(left.corner + 1) % 3], left.triangle, right.triangle, height});
  }
  return edges;
}

double slack_of(const TriangleSet& surface) {
  constexpr double kRounding = 0x1p-28;
  csgcore::Box box;
  for (const Vec3& vertex : surface.vertices) box.merge(vertex);
  return box.empty() ? 0 : kRounding * box.diagonal();
}

std::vector<uint32_t> pieces_of(const TriangleSet& surface, const std::vector<SurfaceEdge>& edges) {
  std::vector<uint32_t> root(surface.triangles.size());
  for (uint32_t i = 0; i < root.size(); ++i) root[i] = i;
  const auto find = [&](uint32_t i) {
    while (root[i] != i) i = root[i] = root[root[i]];
    return i;
  };
  for (const SurfaceEdge& edge : edges) {
    const uint32_t a = find(edge.left), b = find(edge.right);
    root[std::max(a, b)] = std::min(a, b);
  }
  std::vector<uint32_t> result(root.size());
  uint32_t count = 0;
  for (uint32_t i = 0; i < root.size(); ++i) {
    const uint32_t first = find(i);  // the least of its piece
    result[i] = first == i ? count++ : result[first];
  }
  return result;
}

void join_vertices(TriangleSet& surface) {
  std::vector<uint32_t> order(surface.vertices.size());
  for (uint32_t i = 0; i < order.size(); ++i) order[i] = i;
  const auto place = [&](uint32_t i) {
    const Vec3& v = surface.vertices[i];
    return std::array{v.x, v.y, v.z};
  };
  std::ranges::sort(order, [&](uint32_t a, uint32_t b) {
    return std::pair(place(a), a) < std::pair(place(b), b);
  });
  std::vector<uint32_t> first(order.size());  // by vertex: the first one at its place
  for (size_t i = 0; i < order.size(); ++i) {
    const bool is_same = i > 0 && place(order[i]) == place(order[i - 1]);
    first[order[i]] = is_same ? first[order[i - 1]] : order[i];
  }
  std::vector<uint32_t> number(order.size());
  uint32_t count = 0;
  for (uint32_t i = 0; i < order.size(); ++i) {
    if (first[i] != i) continue;
    number[i] = count;
    surface.vertices[count++] = surface.vertices[i];
  }
  surface.vertices.resize(count);
  for (auto& triangle : surface.triangles) {
    for (uint32_t& vertex : triangle) vertex = number[first[vertex]];
  }
  std::erase_if(surface.triangles,
                [](const auto& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; });
}

}  // namespace frontend
