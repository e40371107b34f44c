#include "exact_cells.hpp"

#include <algorithm>
#include <bit>
#include <cassert>
#include <map>

#include "evaluate_tree.hpp"

namespace test_support {
namespace {

using csgcore::Vec3;
using oracle::FacetedSolid;

RationalPoint exact(const Vec3& v) { return {v.x, v.y, v.z}; }

Rational dot(const RationalPoint& a, const RationalPoint& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

RationalPoint cross(const RationalPoint& a, const RationalPoint& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// Returns n·M⁻¹·(x − t) ≤ o in world coordinates, multiplied by |det M|.
std::vector<RationalHalfSpace> half_spaces_in_world(const FacetedSolid& polyhedron) {
  const csgcore::Mat3& m = polyhedron.local_to_world.linear;
  const RationalPoint columns[] = {exact(m[0]), exact(m[1]), exact(m[2])};
  const RationalPoint cofactors[] = {cross(columns[1], columns[2]), cross(columns[2], columns[0]),
                                     cross(columns[0], columns[1])};
  const Rational determinant = dot(columns[0], cofactors[0]);
  std::vector<RationalHalfSpace> result;
  for (const csgcore::HalfSpace& local : polyhedron.half_spaces) {
    RationalHalfSpace& world = result.emplace_back();
    for (int axis = 0; axis < 3; ++axis) {
      for (int k = 0; k < 3; ++k) world.normal[axis] += local.normal[k] * cofactors[k][axis];
      if (determinant < 0) world.normal[axis] = -world.normal[axis];
    }
    world.offset = abs(determinant) * Rational(local.offset) +
                   dot(world.normal, exact(polyhedron.local_to_world.translation));
  }
  return result;
}

/// The faces of a convex solid, counterclockwise seen from outside; it is empty if it has none.
using Faces = std::vector<std::vector<RationalPoint>>;

Faces whole_box() {
  constexpr int kCorners[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                  {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  Faces faces;
  for (const auto& corners : kCorners) {
    std::vector<RationalPoint>& face = faces.emplace_back();
    for (const int corner : corners) {  // bit 0: x, bit 1: y, bit 2: z
      RationalPoint point;
      for (int axis = 0; axis < 3; ++axis) {
        point[axis] = corner >> axis & 1 ? ExactCells::kReach : -ExactCells::kReach;
      }
      face.push_back(point);
    }
  }
  return faces;
}

/// Returns the part of the solid within the half-space.
Faces cut(const Faces& solid, const RationalHalfSpace& half_space) {
  const auto height = [&](const RationalPoint& p) -> Rational {
    return dot(half_space.normal, p) - half_space.offset;
  };
  std::vector<std::vector<Rational>> heights;
  bool is_within = true, is_outside = true;
  for (const auto& face : solid) {
    std::vector<Rational>& of_face = heights.emplace_back();
    for (const RationalPoint& corner : face) {
      of_face.push_back(height(corner));
      is_within = is_within && of_face.back() <= 0;
      is_outside = is_outside && of_face.back() >= 0;
    }
  }
  if (is_within) return solid;
  if (is_outside) return {};
  Faces result;
  // Where a face is cut, its edge in the plane belongs, reversed, to the new face.
  std::map<RationalPoint, RationalPoint> next_in_plane;
  for (std::size_t f = 0; f < solid.size(); ++f) {
    std::vector<RationalPoint> part;
    std::vector<bool> in_plane;
    for (std::size_t i = 0; i < solid[f].size(); ++i) {
      const std::size_t next = (i + 1) % solid[f].size();
      const Rational &h = heights[f][i], &next_h = heights[f][next];
      if (h <= 0) {
        part.push_back(solid[f][i]);
        in_plane.push_back(h == 0);
      }
      if (sgn(h) * sgn(next_h) < 0) {
        const Rational share = h / (h - next_h);
        RationalPoint& point = part.emplace_back();
        for (int axis = 0; axis < 3; ++axis) {
          point[axis] = solid[f][i][axis] + share * (solid[f][next][axis] - solid[f][i][axis]);
        }
        in_plane.push_back(true);
      }
    }
    if (part.size() < 3) continue;  // it touches the plane from outside
    for (std::size_t i = 0; i < part.size(); ++i) {
      const std::size_t next = (i + 1) % part.size();
      if (in_plane[i] && in_plane[next]) next_in_plane[part[next]] = part[i];
    }
    result.push_back(std::move(part));
  }
  std::vector<RationalPoint>& face = result.emplace_back();
  const RationalPoint first = next_in_plane.begin()->first;
  for (RationalPoint point = first; face.empty() || point != first; point = next_in_plane.at(point))
    face.push_back(point);
  return result;
}

Rational volume_of(const Faces& solid) {
  Rational six_times = 0;
  for (const auto& face : solid) {
    for (std::size_t i = 2; i < face.size(); ++i) {
      six_times += dot(face[0], cross(face[i - 1], face[i]));
    }
  }
  return six_times / 6;
}

}  // namespace

ExactCells::ExactCells(const csgcore::CsgTree& tree, std::span<const FacetedSolid> polyhedra)
    : tree_(tree) {
  assert(polyhedra.size() <= kMostPolyhedra);
  for (const FacetedSolid& polyhedron : polyhedra) {
    polyhedra_.push_back(half_spaces_in_world(polyhedron));
  }
}

bool ExactCells::value(uint32_t inside) const {
  return evaluate_tree(tree_.tokens(), [&](uint32_t i) { return (inside >> i & 1) != 0; });
}

// The indicator function of the solid is a polynomial of those of the polyhedra, and a product of
// these is the indicator of an intersection. The coefficients are the Möbius transform of the
// tree's values.
Rational ExactCells::volume() const {
  const uint32_t subsets = 1u << polyhedra_.size();
  std::vector<int> coefficients(subsets);
  for (uint32_t subset = 0; subset < subsets; ++subset) coefficients[subset] = value(subset);
  for (uint32_t bit = 1; bit < subsets; bit *= 2) {
    for (uint32_t subset = 0; subset < subsets; ++subset) {
      if (subset & bit) coefficients[subset] -= coefficients[subset ^ bit];
    }
  }
  std::vector<Faces> pieces(subsets);
  pieces[0] = whole_box();
  Rational sum = 0;
  for (uint32_t subset = 1; subset < subsets; ++subset) {
    const uint32_t last = std::bit_floor(subset);
    Faces& piece = pieces[subset];
    piece = pieces[subset ^ last];
    for (const RationalHalfSpace& half_space : polyhedra_[std::countr_zero(last)]) {
      if (!piece.empty()) piece = cut(piece, half_space);
    }
    if (coefficients[subset] != 0) sum += coefficients[subset] * volume_of(piece);
  }
  return sum;
}

std::optional<bool> ExactCells::contains(const Vec3& point) const {
  const RationalPoint p = exact(point);
  uint32_t inside = 0;
  for (std::size_t i = 0; i < polyhedra_.size(); ++i) {
    Rational highest = -1;
    for (const RationalHalfSpace& half_space : polyhedra_[i]) {
      highest = std::max<Rational>(highest, dot(half_space.normal, p) - half_space.offset);
    }
    if (highest == 0) return std::nullopt;
    if (highest < 0) inside |= 1u << i;
  }
  return value(inside);
}

}  // namespace test_support
