#include "export/written_mesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>
#include <utility>
#include <vector>

#include "frontend/error.hpp"

namespace frontend {
namespace {

using csgcore::TriangleSet;
using csgcore::Vec3;
using TriangleCorners = std::array<uint32_t, 3>;

void round_to_float(std::vector<Vec3>& vertices, const std::string& name) {
  for (Vec3& vertex : vertices) {
    for (int axis = 0; axis < 3; ++axis) {
      if (std::abs(vertex[axis]) > std::numeric_limits<float>::max()) {
        throw Error(name, {}, "the solid is too large for the numbers of this format",
                    "export it as .off, or scale it down");
      }
      vertex[axis] = static_cast<float>(vertex[axis]);
    }
  }
}

/// Vertices that have become one, each named by the first of them.
class MergedVertices {
 public:
  explicit MergedVertices(size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), 0u);
  }

  void merge(uint32_t a, uint32_t b) {
    a = first_of(a);
    b = first_of(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

  uint32_t first_of(uint32_t vertex) {
    while (parent_[vertex] != vertex) {
      parent_[vertex] = parent_[parent_[vertex]];
      vertex = parent_[vertex];
    }
    return vertex;
  }

 private:
  std::vector<uint32_t> parent_;
};

bool has_equal_corners(const TriangleCorners& t) {
  return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
}

/// Removes pairs of triangles with the same corners that run in opposite directions.
void remove_backed_triangles(std::vector<TriangleCorners>& triangles) {
  struct Sorted {
    TriangleCorners corners;  // ascending
    bool is_odd;              // whether the triangle runs the other way around
    uint32_t index;
  };
  std::vector<Sorted> all;
  all.reserve(triangles.size());
  for (const TriangleCorners& t : triangles) {
    TriangleCorners corners = t;
    std::sort(corners.begin(), corners.end());
    const bool is_odd = !(t == corners || (t[1] == corners[0] && t[2] == corners[1]) ||
                          (t[2] == corners[0] && t[0] == corners[1]));
    all.push_back({corners, is_odd, static_cast<uint32_t>(all.size())});
  }
  std::sort(all.begin(), all.end(), [](const Sorted& a, const Sorted& b) {
    return std::tie(a.corners, a.index) < std::tie(b.corners, b.index);
  });
  std::vector<bool> goes(triangles.size());
  for (size_t begin = 0, end = 0; begin < all.size(); begin = end) {
    std::vector<uint32_t> open;  // triangles of one direction that no other one backs
    bool is_odd = false;
    for (; end < all.size() && all[end].corners == all[begin].corners; ++end) {
      if (open.empty() || all[end].is_odd == is_odd) {
        is_odd = all[end].is_odd;
        open.push_back(all[end].index);
      } else {
        goes[open.back()] = goes[all[end].index] = true;
        open.pop_back();
      }
    }
  }
  size_t next = 0;
  std::erase_if(triangles, [&](const TriangleCorners&) { return goes[next++]; });
}

/// Removes vertices that no triangle has.
void remove_unused_vertices(TriangleSet& surface) {
  constexpr uint32_t kUnused = 0xFFFFFFFFu;
  std::vector<uint32_t> place(surface.vertices.size(), kUnused);
  for (const TriangleCorners& t : surface.triangles) {
    for (const uint32_t corner : t) place[corner] = 0;
  }
  uint32_t count = 0;
  for (size_t i = 0; i < place.size(); ++i) {
    if (place[i] == kUnused) continue;
    surface.vertices[count] = surface.vertices[i];
    place[i] = count++;
  }
  surface.vertices.resize(count);
  for (TriangleCorners& t : surface.triangles) {
    for (uint32_t& corner : t) corner = place[corner];
  }
}

}  // namespace

TriangleSet written_mesh(const TriangleSet& surface, Precision precision, const std::string& name) {
  TriangleSet result = surface;
  if (precision == Precision::kFloat) round_to_float(result.vertices, name);
  const std::vector<Vec3>& places = result.vertices;
  MergedVertices merged(places.size());
  bool collapses = false;
  for (const TriangleCorners& t : result.triangles) {
    for (size_t i = 0; i < 3; ++i) {
      const uint32_t a = t[i], b = t[(i + 1) % 3];
      if (places[a] != places[b]) continue;
      merged.merge(a, b);
      collapses = true;
    }
  }
  if (collapses) {
    for (TriangleCorners& t : result.triangles) {
      for (uint32_t& corner : t) corner = merged.first_of(corner);
    }
    std::erase_if(result.triangles, has_equal_corners);
    remove_backed_triangles(result.triangles);
  }
  remove_unused_vertices(result);
  return result;
}

}  // namespace frontend
