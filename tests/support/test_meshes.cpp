#include "test_meshes.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <numbers>
#include <utility>

namespace test_support {

using csgcore::TriangleMesh;
using csgcore::Vec3;

namespace {

double uniform(std::mt19937& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

/// Adds a grid of vertices that is closed in one direction: `rings` of `across` vertices each, and
/// the triangles between neighbouring rings.
void join_rings(MeshParts& parts, uint32_t first, uint32_t rings, uint32_t across, bool is_ring) {
  for (uint32_t i = 0; i + (is_ring ? 0 : 1) < rings; ++i) {
    const uint32_t from = first + i * across, to = first + (i + 1) % rings * across;
    for (uint32_t k = 0; k < across; ++k) {
      const uint32_t next = (k + 1) % across;
      parts.triangles.push_back({from + k, to + k, to + next});
      parts.triangles.push_back({from + k, to + next, from + next});
    }
  }
}

}  // namespace

uint32_t MeshParts::add(const Vec3& vertex) {
  vertices.push_back(vertex);
  return static_cast<uint32_t>(vertices.size() - 1);
}

void MeshParts::add(const MeshParts& other) {
  const auto base = static_cast<uint32_t>(vertices.size());
  vertices.insert(vertices.end(), other.vertices.begin(), other.vertices.end());
  for (const auto& [a, b, c] : other.triangles) {
    triangles.push_back({base + a, base + b, base + c});
  }
}

MeshParts MeshParts::moved(const Vec3& offset) const {
  MeshParts result = *this;
  for (Vec3& vertex : result.vertices) vertex += offset;
  return result;
}

MeshParts MeshParts::scaled(const Vec3& factors) const {
  MeshParts result = *this;
  for (Vec3& vertex : result.vertices) vertex *= factors;
  return result;
}

MeshParts MeshParts::inside_out() const {
  MeshParts result = *this;
  for (TriangleMesh::Triangle& triangle : result.triangles) std::swap(triangle[1], triangle[2]);
  return result;
}

std::shared_ptr<const TriangleMesh> MeshParts::mesh() const {
  return std::make_shared<TriangleMesh>(vertices, triangles);
}

MeshParts parts_of(const csgcore::Mesh& mesh) {
  MeshParts parts{mesh.vertices, {}};
  for (const std::vector<uint32_t>& face : mesh.faces) {
    for (size_t i = 2; i < face.size(); ++i) {
      parts.triangles.push_back({face[0], face[i - 1], face[i]});
    }
  }
  return parts;
}

MeshParts tetrahedron_parts(double scale) {
  return {{scale * Vec3(1, 1, 1), scale * Vec3(-1, -1, 1), scale * Vec3(-1, 1, -1),
           scale * Vec3(1, -1, -1)},
          {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
}

MeshParts box_parts(const Vec3& min, const Vec3& max) {
  MeshParts parts;
  for (int i = 0; i < 8; ++i) {
    parts.add(Vec3(i & 1 ? max.x : min.x, i & 2 ? max.y : min.y, i & 4 ? max.z : min.z));
  }
  parts.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                     {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return parts;
}

MeshParts open_box_parts(const Vec3& min, const Vec3& max) {
  MeshParts parts = box_parts(min, max);
  std::erase_if(parts.triangles, [&](const TriangleMesh::Triangle& triangle) {
    return std::ranges::all_of(triangle, [&](uint32_t i) { return parts.vertices[i].z == max.z; });
  });
  return parts;
}

MeshParts sheet_parts(uint32_t side) {
  MeshParts parts;
  for (uint32_t y = 0; y <= side; ++y) {
    for (uint32_t x = 0; x <= side; ++x) parts.add(Vec3(x, y, 0));
  }
  for (uint32_t y = 0; y < side; ++y) {
    for (uint32_t x = 0; x < side; ++x) {
      const uint32_t first = y * (side + 1) + x, above = first + side + 1;
      parts.triangles.push_back({first, first + 1, above + 1});
      parts.triangles.push_back({first, above + 1, above});
    }
  }
  return parts;
}

MeshParts slab_parts(uint32_t side) {
  MeshParts parts = joined({sheet_parts(side).inside_out(), sheet_parts(side).moved({0, 0, 1})});
  const auto upper = static_cast<uint32_t>(parts.vertices.size() / 2);
  const auto add_wall = [&](uint32_t first, int step) {
    for (uint32_t i = 0; i < side; ++i) {
      const uint32_t next = first + static_cast<uint32_t>(step);
      parts.triangles.push_back({first, next, upper + next});
      parts.triangles.push_back({first, upper + next, upper + first});
      first = next;
    }
  };
  const int row = static_cast<int>(side) + 1;
  add_wall(0, 1);
  add_wall(side, row);
  add_wall(upper - 1, -1);
  add_wall(upper - 1 - side, -row);
  return parts;
}

MeshParts sliced_box_parts(const Vec3& half, uint32_t cuts, std::mt19937& random) {
  std::vector<double> places[3];
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double>& own = places[axis];
    own = {-half[axis], half[axis]};
    for (uint32_t i = 0; i < cuts; ++i) {
      const double near = own[random() % own.size()];
      const double step = random() % 2 ? 1e-9 * half[axis] : uniform(random, 0, half[axis]);
      const double place = near > 0 ? near - step : near + step;
      if (std::abs(place) < half[axis]) own.push_back(place);
    }
    std::sort(own.begin(), own.end());
    own.erase(std::unique(own.begin(), own.end()), own.end());
  }
  MeshParts parts;
  std::map<std::array<size_t, 3>, uint32_t> known;
  const auto vertex = [&](const std::array<size_t, 3>& at) {
    const auto [entry, is_new] = known.try_emplace(at, 0u);
    if (is_new) {
      entry->second = parts.add(Vec3(places[0][at[0]], places[1][at[1]], places[2][at[2]]));
    }
    return entry->second;
  };
  for (size_t axis = 0; axis < 3; ++axis) {
    const size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (const bool is_high : {false, true}) {
      for (size_t i = 0; i + 1 < places[u].size(); ++i) {
        for (size_t k = 0; k + 1 < places[v].size(); ++k) {
          const auto corner = [&](size_t du, size_t dv) {
            std::array<size_t, 3> at{};
            at[axis] = is_high ? places[axis].size() - 1 : 0;
            at[u] = i + du;
            at[v] = k + dv;
            return vertex(at);
          };
          const uint32_t a = corner(0, 0), b = corner(1, 0), c = corner(1, 1), d = corner(0, 1);
          if (is_high) {
            parts.triangles.push_back({a, b, c});
            parts.triangles.push_back({a, c, d});
          } else {
            parts.triangles.push_back({a, c, b});
            parts.triangles.push_back({a, d, c});
          }
        }
      }
    }
  }
  return parts;
}

MeshParts l_prism_parts(double length, double thickness, double height) {
  const double l = length, t = thickness;
  // Counterclockwise. Vertex 3, in the inner corner, sees all others.
  const double outline[][2] = {{0, 0}, {l, 0}, {l, t}, {t, t}, {t, l}, {0, l}};
  MeshParts parts;
  for (const double z : {0.0, height}) {
    for (const auto& [x, y] : outline) parts.add(Vec3(x, y, z));
  }
  for (const auto& [a, b] : {std::pair{4u, 5u}, {5u, 0u}, {0u, 1u}, {1u, 2u}}) {
    parts.triangles.push_back({3, b, a});
    parts.triangles.push_back({9, 6 + a, 6 + b});
  }
  for (uint32_t a = 0; a < 6; ++a) {
    const uint32_t b = (a + 1) % 6;
    parts.triangles.push_back({a, b, 6 + b});
    parts.triangles.push_back({a, 6 + b, 6 + a});
  }
  return parts;
}

MeshParts torus_parts(double radius, double tube_radius, uint32_t around, uint32_t across) {
  MeshParts parts;
  for (uint32_t i = 0; i < around; ++i) {
    const double angle = 2 * std::numbers::pi * i / around;
    for (uint32_t k = 0; k < across; ++k) {
      const double turn = 2 * std::numbers::pi * k / across;
      const double r = radius + tube_radius * std::cos(turn);
      parts.add(Vec3(r * std::cos(angle), r * std::sin(angle), tube_radius * std::sin(turn)));
    }
  }
  join_rings(parts, 0, around, across, true);
  return parts;
}

MeshParts helix_parts(double radius, double tube_radius, double pitch, double turns,
                      uint32_t per_turn, uint32_t across) {
  MeshParts parts;
  const auto rings = static_cast<uint32_t>(std::ceil(turns * per_turn)) + 1;
  for (uint32_t i = 0; i < rings; ++i) {
    const double angle = 2 * std::numbers::pi * i / per_turn;
    for (uint32_t k = 0; k < across; ++k) {
      const double turn = 2 * std::numbers::pi * k / across;
      const double r = radius + tube_radius * std::cos(turn);
      parts.add(Vec3(r * std::cos(angle), r * std::sin(angle),
                     pitch * i / per_turn + tube_radius * std::sin(turn)));
    }
  }
  join_rings(parts, 0, rings, across, false);
  const uint32_t last = (rings - 1) * across;
  for (uint32_t k = 1; k + 1 < across; ++k) {
    parts.triangles.push_back({0, k, k + 1});
    parts.triangles.push_back({last, last + k + 1, last + k});
  }
  return parts;
}

MeshParts icosphere_parts(double radius, uint32_t divisions) {
  constexpr double kPhi = std::numbers::phi;
  MeshParts parts;
  parts.vertices = {{-1, kPhi, 0}, {1, kPhi, 0}, {-1, -kPhi, 0}, {1, -kPhi, 0},
                    {0, -1, kPhi}, {0, 1, kPhi}, {0, -1, -kPhi}, {0, 1, -kPhi},
                    {kPhi, 0, -1}, {kPhi, 0, 1}, {-kPhi, 0, -1}, {-kPhi, 0, 1}};
  parts.triangles = {{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                     {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                     {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                     {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
  for (uint32_t division = 0; division < divisions; ++division) {
    std::map<std::pair<uint32_t, uint32_t>, uint32_t> middles;
    const auto middle = [&](uint32_t a, uint32_t b) {
      const auto [entry, is_new] = middles.try_emplace(std::minmax(a, b), 0u);
      if (is_new) entry->second = parts.add(0.5 * (parts.vertices[a] + parts.vertices[b]));
      return entry->second;
    };
    std::vector<TriangleMesh::Triangle> divided;
    for (const auto& [a, b, c] : parts.triangles) {
      const uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      divided.insert(divided.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
    }
    parts.triangles = std::move(divided);
  }
  for (Vec3& vertex : parts.vertices) vertex = radius * glm::normalize(vertex);
  return parts;
}

MeshParts height_field_parts(double size, uint32_t cells, double low, double high,
                             std::mt19937& random) {
  MeshParts parts;
  const uint32_t side = cells + 1;
  for (const bool is_top : {false, true}) {
    for (uint32_t y = 0; y < side; ++y) {
      for (uint32_t x = 0; x < side; ++x) {
        parts.add(
            Vec3(size * x / cells, size * y / cells, is_top ? uniform(random, low, high) : 0));
      }
    }
  }
  const uint32_t top = side * side;
  for (uint32_t y = 0; y < cells; ++y) {
    for (uint32_t x = 0; x < cells; ++x) {
      const uint32_t a = y * side + x, b = a + 1, c = b + side, d = a + side;
      parts.triangles.push_back({top + a, top + b, top + c});
      parts.triangles.push_back({top + a, top + c, top + d});
      parts.triangles.push_back({a, c, b});
      parts.triangles.push_back({a, d, c});
    }
  }
  const auto wall = [&](uint32_t a, uint32_t b) {
    parts.triangles.push_back({a, b, top + b});
    parts.triangles.push_back({a, top + b, top + a});
  };
  for (uint32_t i = 0; i < cells; ++i) {
    wall(i, i + 1);
    wall(i * side + cells, (i + 1) * side + cells);
    wall(cells * side + i + 1, cells * side + i);
    wall((i + 1) * side, i * side);
  }
  return parts;
}

MeshParts star_parts(double low, double high, uint32_t divisions, std::mt19937& random) {
  MeshParts parts = icosphere_parts(1, divisions);
  for (Vec3& vertex : parts.vertices) vertex *= uniform(random, low, high);
  return parts;
}

MeshParts joined(std::initializer_list<MeshParts> shells) {
  MeshParts result;
  for (const MeshParts& shell : shells) result.add(shell);
  return result;
}

MeshParts with_holes(const MeshParts& parts, double share, std::mt19937& random) {
  MeshParts result{parts.vertices, {}};
  for (const TriangleMesh::Triangle& triangle : parts.triangles) {
    if (uniform(random, 0, 1) >= share) result.triangles.push_back(triangle);
  }
  return result;
}

}  // namespace test_support
