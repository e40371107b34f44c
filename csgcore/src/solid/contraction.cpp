#include "solid/contraction.hpp"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "primitives/primitive_kind.hpp"

namespace csgcore {
namespace {

/// What a plane is moved by so that rounding keeps nothing out, as a share of the coordinates from
/// which its limit is computed.
constexpr double kRounding = 0x1p-44;

Vec3 corner_of(const Box& box, int corner) {
  return {(corner & 1) ? box.max.x : box.min.x, (corner & 2) ? box.max.y : box.min.y,
          (corner & 4) ? box.max.z : box.min.z};
}

}  // namespace

ConvexCell::ConvexCell(const Box& box) {
  edges_.reserve(64);
  for (int axis = 0; axis < 3; ++axis) {
    const int u = 1 << ((axis + 1) % 3), v = 1 << ((axis + 2) % 3);
    for (int side = 0; side < 2; ++side) {
      const int first = side << axis;
      const int corners[] = {first, first | u, first | u | v, first | v};
      for (int i = 0; i < 4; ++i) {
        edges_.push_back({corner_of(box, corners[i]), corner_of(box, corners[(i + 1) % 4]),
                          static_cast<uint32_t>(2 * axis + side)});
      }
    }
  }
}

/// A face has a point of the plane on two of its edges, or on none: whether a vertex is left is
/// decided once, by the same arithmetic for all of its edges.
void ConvexCell::clip(const Vec3& normal, double limit) {
  constexpr uint32_t kMostCellFaces = 6 + Contractor::kMostTests;
  std::array<std::optional<Vec3>, kMostCellFaces> cut;  // by face: the point of its first cut edge
  const size_t count = edges_.size();
  const uint32_t cap = faces_++;
  size_t kept = 0;
  for (size_t i = 0; i < count; ++i) {
    Edge edge = edges_[i];
    const double start = glm::dot(normal, edge.start) - limit;
    const double end = glm::dot(normal, edge.end) - limit;
    if (start > 0 && end > 0) continue;
    if (start > 0 || end > 0) {
      // Computed from the end within, so that both faces of the edge get the same point.
      const Vec3& inner = start > 0 ? edge.end : edge.start;
      const Vec3& outer = start > 0 ? edge.start : edge.end;
      const double share = std::min(start, end) / (std::min(start, end) - std::max(start, end));
      const Vec3 point = inner + share * (outer - inner);
      (start > 0 ? edge.start : edge.end) = point;
      std::optional<Vec3>& other = cut[edge.face];
      if (other) {
        edges_.push_back({*other, point, edge.face});
        edges_.push_back({*other, point, cap});
      } else {
        other = point;
      }
    }
    edges_[kept++] = edge;
  }
  edges_.erase(edges_.begin() + static_cast<std::ptrdiff_t>(kept),
               edges_.begin() + static_cast<std::ptrdiff_t>(count));
}

std::optional<Contraction> Contractor::contract(const CellList& list, const Box& cell,
                                                const Vec3& direction) const {
  std::array<Sides, kMostTests> sides;
  for (uint32_t i = 0; i < list.count(); ++i) {
    sides[i] = sides_of(primitives_[list.primitive[i] & kPrimitiveBits], cell);
  }
  struct Open {
    uint32_t number;  // of the next test
    ConvexCell part;
  };
  std::vector<Open> open;
  open.push_back({list.root, ConvexCell(cell)});
  Contraction result;
  double farthest = -std::numeric_limits<double>::infinity();
  while (!open.empty()) {
    const Open next = std::move(open.back());
    open.pop_back();
    if (next.number == CellList::kFalse || next.part.empty()) continue;
    if (next.number == CellList::kTrue) {
      Vec3 sum(0.0);
      double vertices = 0;
      bool has_tip = false;
      next.part.visit_vertices([&](const Vec3& vertex) {
        result.box.merge(vertex);
        sum += vertex;
        vertices += 1;
        if (glm::dot(direction, vertex) <= farthest) return;
        farthest = glm::dot(direction, vertex);
        result.tip = vertex;
        has_tip = true;
      });
      if (has_tip) result.middle = sum / vertices;
      continue;
    }
    const uint32_t i = next.number - CellList::kFirst;
    const auto add = [&](uint32_t number, const HalfSpace& side) {
      if (number == CellList::kFalse) return;
      Open& part = open.emplace_back(Open{number, next.part});
      if (side.normal != Vec3(0.0)) part.part.clip(side.normal, side.limit);
    };
    add(list.if_inside[i], sides[i].within);
    add(list.if_outside[i], sides[i].without);
  }
  if (result.box.empty()) return std::nullopt;
  return result;
}

Contractor::Sides Contractor::sides_of(const CanonicalPrimitive& primitive, const Box& cell) const {
  const Vec3 middle = primitive.world_to_canonical * (cell.center() - primitive.center);
  const Vec3 canonical_normal = kind_of(primitive.shape).outwards(primitive, middle);
  if (canonical_normal == Vec3(0.0)) return {};
  const Vec3 normal =
      glm::normalize(glm::transpose(primitive.world_to_canonical) * canonical_normal);
  const Vec3 furthest = furthest_point(primitive, normal);
  const Vec3 terms = glm::max(glm::abs(furthest), glm::max(glm::abs(cell.min), glm::abs(cell.max)));
  const double rounding = kRounding * std::max({terms.x, terms.y, terms.z});
  const double support = glm::dot(normal, furthest);
  return {{normal, support - margin_ + rounding},
          without(primitive, cell, normal, support, rounding)};
}

/// All of the cell that lies below a plane lies within the convex primitive if the corners of that
/// part do. Finds the highest plane.
Contractor::HalfSpace Contractor::without(const CanonicalPrimitive& primitive, const Box& cell,
                                          const Vec3& normal, double support,
                                          double rounding) const {
  if (!primitive.is_convex) return {};
  double heights[8];
  double lowest = std::numeric_limits<double>::infinity(), highest = support;
  for (int i = 0; i < 8; ++i) {
    const Vec3 corner = corner_of(cell, i);
    heights[i] = glm::dot(normal, corner);
    lowest = std::min(lowest, heights[i]);
    if (!contains(primitive, corner)) highest = std::min(highest, heights[i]);
  }
  const auto is_within = [&](double height) {
    for (int i = 0; i < 8; ++i) {
      for (const int bit : {1, 2, 4}) {
        const int j = i ^ bit;
        if (!(heights[i] <= height && heights[j] > height)) continue;
        const double share = (height - heights[i]) / (heights[j] - heights[i]);
        const Vec3 from = corner_of(cell, i);
        if (!contains(primitive, from + share * (corner_of(cell, j) - from))) return false;
      }
    }
    return true;
  };
  if (highest <= lowest) return {};
  // On the face of a polyhedron a point may be found on either side.
  const double on_face = highest - rounding;
  if (on_face > lowest && is_within(on_face)) {
    lowest = on_face;
  } else {
    constexpr int kSteps = 10;
    const double bottom = lowest;
    for (int step = 0; step < kSteps; ++step) {
      const double middle = 0.5 * lowest + 0.5 * highest;
      (is_within(middle) ? lowest : highest) = middle;
    }
    if (lowest == bottom) return {};
  }
  return {-normal, -(lowest + margin_)};
}

}  // namespace csgcore
