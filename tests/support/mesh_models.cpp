#include "mesh_models.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <numbers>
#include <utility>

namespace test_support {
namespace {

using csgcore::TriangleMesh;
using csgcore::Vec3;

constexpr double kTurn = 2 * std::numbers::pi;

/// Adds the quadrangle from four vertices, counterclockwise.
void add_quad(Shell& shell, uint32_t a, uint32_t b, uint32_t c, uint32_t d) {
  shell.triangles.push_back({a, b, c});
  shell.triangles.push_back({a, c, d});
}

/// Adds the walls between rings of `across` vertices each, from ring `first` to ring `last`. A ring
/// is counterclockwise as seen from the later ones.
void add_wall(Shell& shell, uint32_t across, uint32_t first, uint32_t last) {
  for (uint32_t i = 0; i < across; ++i) {
    const uint32_t next = (i + 1) % across;
    add_quad(shell, first * across + i, first * across + next, last * across + next,
             last * across + i);
  }
}

/// Returns the point of the rod's or the torus' surface.
Vec3 on_ring(double ring_radius, double tube_radius, double around, double across, double z) {
  const double radius = ring_radius + tube_radius * std::cos(across);
  return {radius * std::cos(around), radius * std::sin(around), z + tube_radius * std::sin(across)};
}

}  // namespace

std::shared_ptr<const TriangleMesh> mesh_of(Shell shell) {
  return std::make_shared<const TriangleMesh>(std::move(shell.vertices),
                                              std::move(shell.triangles));
}

Shell open_box_shell(const Vec3& min, const Vec3& max) {
  Shell shell;
  for (const double z : {min.z, max.z}) {
    shell.vertices.insert(
        shell.vertices.end(),
        {{min.x, min.y, z}, {max.x, min.y, z}, {max.x, max.y, z}, {min.x, max.y, z}});
  }
  add_wall(shell, 4, 0, 1);
  add_quad(shell, 3, 2, 1, 0);
  return shell;
}

Shell box_shell(const Vec3& min, const Vec3& max) {
  Shell shell = open_box_shell(min, max);
  add_quad(shell, 4, 5, 6, 7);
  return shell;
}

Shell sheet_shell(uint32_t side) {
  Shell shell;
  for (uint32_t y = 0; y <= side; ++y) {
    for (uint32_t x = 0; x <= side; ++x) shell.vertices.push_back({x, y, 0});
  }
  for (uint32_t y = 0; y < side; ++y) {
    for (uint32_t x = 0; x < side; ++x) {
      const uint32_t first = y * (side + 1) + x, above = first + side + 1;
      add_quad(shell, first, first + 1, above + 1, above);
    }
  }
  return shell;
}

Shell slab_shell(uint32_t side) {
  const Shell bottom = reversed(sheet_shell(side));
  Shell shell = joined({bottom, sheet_shell(side)});
  const auto upper = static_cast<uint32_t>(bottom.vertices.size());
  for (uint32_t i = upper; i < 2 * upper; ++i) shell.vertices[i].z = 1;
  const auto add_walls = [&](uint32_t first, int step) {
    for (uint32_t i = 0; i < side; ++i) {
      const uint32_t next = first + static_cast<uint32_t>(step);
      add_quad(shell, first, next, upper + next, upper + first);
      first = next;
    }
  };
  const int row = static_cast<int>(side) + 1;
  add_walls(0, 1);
  add_walls(side, row);
  add_walls(upper - 1, -1);
  add_walls(upper - 1 - side, -row);
  return shell;
}

Shell l_prism_shell(double height) {
  Shell shell;
  for (const double z : {0.0, height}) {
    shell.vertices.insert(shell.vertices.end(),
                          {{0, 0, z}, {2, 0, z}, {2, 1, z}, {1, 1, z}, {1, 2, z}, {0, 2, z}});
  }
  add_wall(shell, 6, 0, 1);
  add_quad(shell, 3, 2, 1, 0);
  add_quad(shell, 5, 4, 3, 0);
  add_quad(shell, 6, 7, 8, 9);
  add_quad(shell, 6, 9, 10, 11);
  return shell;
}

Shell torus_shell(double ring_radius, double tube_radius, uint32_t around, uint32_t across) {
  Shell shell;
  for (uint32_t i = 0; i < around; ++i) {
    for (uint32_t j = 0; j < across; ++j) {
      // A ring is counterclockwise against the direction in which the angle grows.
      shell.vertices.push_back(
          on_ring(ring_radius, tube_radius, kTurn * i / around, -kTurn * j / across, 0));
    }
  }
  for (uint32_t i = 0; i < around; ++i) add_wall(shell, across, i, (i + 1) % around);
  return shell;
}

Shell coil_shell(double ring_radius, double rod_radius, double pitch, uint32_t turns,
                 uint32_t steps, uint32_t across) {
  Shell shell;
  const uint32_t rings = turns * steps;
  for (uint32_t i = 0; i <= rings; ++i) {
    for (uint32_t j = 0; j < across; ++j) {
      shell.vertices.push_back(on_ring(ring_radius, rod_radius, kTurn * i / steps,
                                       -kTurn * j / across, pitch * i / steps));
    }
  }
  for (uint32_t i = 0; i < rings; ++i) add_wall(shell, across, i, i + 1);
  const uint32_t last = rings * across;
  for (uint32_t j = 1; j + 1 < across; ++j) {
    shell.triangles.push_back({0, j + 1, j});
    shell.triangles.push_back({last, last + j, last + j + 1});
  }
  return shell;
}

Shell ball_shell(double radius, uint32_t divisions, const Vec3& center) {
  Shell shell;
  shell.vertices = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  for (uint32_t octant = 0; octant < 8; ++octant) {
    const uint32_t x = octant & 1, y = 2 + (octant >> 1 & 1), z = 4 + (octant >> 2);
    const bool is_mirrored = ((octant ^ octant >> 1 ^ octant >> 2) & 1) != 0;
    shell.triangles.push_back({x, is_mirrored ? z : y, is_mirrored ? y : z});
  }
  for (uint32_t division = 0; division < divisions; ++division) {
    std::map<std::pair<uint32_t, uint32_t>, uint32_t> middles;
    const auto middle = [&](uint32_t a, uint32_t b) {
      const auto [place, is_new] =
          middles.try_emplace(std::minmax(a, b), static_cast<uint32_t>(shell.vertices.size()));
      if (is_new) shell.vertices.push_back(glm::normalize(shell.vertices[a] + shell.vertices[b]));
      return place->second;
    };
    for (const auto& [a, b, c] : std::exchange(shell.triangles, {})) {
      const uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      shell.triangles.insert(shell.triangles.end(),
                             {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
  }
  for (Vec3& vertex : shell.vertices) vertex = center + radius * vertex;
  return shell;
}

Shell reversed(Shell shell) {
  for (TriangleMesh::Triangle& triangle : shell.triangles) std::swap(triangle[1], triangle[2]);
  return shell;
}

Shell joined(std::initializer_list<Shell> shells) {
  Shell result;
  for (const Shell& shell : shells) {
    const auto first = static_cast<uint32_t>(result.vertices.size());
    result.vertices.insert(result.vertices.end(), shell.vertices.begin(), shell.vertices.end());
    for (TriangleMesh::Triangle triangle : shell.triangles) {
      for (uint32_t& vertex : triangle) vertex += first;
      result.triangles.push_back(triangle);
    }
  }
  return result;
}

}  // namespace test_support
