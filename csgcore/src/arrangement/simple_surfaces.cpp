#include "arrangement/simple_surfaces.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>

#include "csgcore/stop_scope.hpp"

namespace csgcore {
namespace {

/// Finds the edges of facets by their ends, in the order in which the facet runs through them.
class EdgeTable {
 public:
  explicit EdgeTable(std::span<const Facet> surface)
      : surface_(surface), slots_(std::bit_ceil(8 * surface.size()), kNoPlace) {}

  /// Adds the facet's edge from one corner to the next. Returns whether it is new.
  bool add(uint32_t facet, size_t corner) {
    const auto& corners = surface_[facet].corners;
    uint32_t& slot = slots_[slot_of(corners[corner], corners[(corner + 1) % 3])];
    if (slot != kNoPlace) return false;
    slot = static_cast<uint32_t>(3 * facet + corner);
    return true;
  }
  /// Returns three times the edge's facet, and the corner where it starts; kNoPlace: there is none.
  uint32_t find(uint32_t from, uint32_t to) const { return slots_[slot_of(from, to)]; }

 private:
  size_t slot_of(uint32_t from, uint32_t to) const {
    // Edges of one corner stand together, as those of its neighbours do, unless they are many.
    constexpr size_t kTogether = 8;
    const uint64_t hash = (uint64_t{from} << 32 | to) * 0x9e3779b97f4a7c15u;
    size_t slot = kTogether * from + (hash >> 61);
    for (size_t tries = 0;; ++tries, ++slot) {
      if (tries == kTogether) slot = hash >> 29;
      slot &= slots_.size() - 1;
      if (slots_[slot] == kNoPlace) return slot;
      const auto& corners = surface_[slots_[slot] / 3].corners;
      const size_t corner = slots_[slot] % 3;
      if (corners[corner] == from && corners[(corner + 1) % 3] == to) return slot;
    }
  }

  std::span<const Facet> surface_;
  std::vector<uint32_t> slots_;
};

/// Returns six times the volume that the facets enclose, rounded.
double volume_of(const Facets& facets, std::span<const Facet> surface) {
  const Vec3 origin = to_vec3(facets.points[surface.front().corners[0]]);
  double sum = 0;
  for (const Facet& facet : surface) {
    const auto& [a, b, c] = facet.corners;
    const Vec3 p = to_vec3(facets.points[a]) - origin;
    const Vec3 q = to_vec3(facets.points[b]) - origin;
    const Vec3 r = to_vec3(facets.points[c]) - origin;
    sum += p.x * (q.y * r.z - q.z * r.y) + p.y * (q.z * r.x - q.x * r.z) +
           p.z * (q.x * r.y - q.y * r.x);
  }
  return sum;
}

/// A corner no further from a facet's plane may have been in it before rounding, which moves each
/// of the four points by less than a unit of the grid.
constexpr double kFlat = 4;

/// Returns whether the facets are, but for rounding, the boundary of a convex solid. All face away
/// from a middle, or towards it, and seen from there one of them alone lies behind the centre of
/// the largest: since each edge has two of them, which run through it in opposite directions, one
/// lies in every direction. Everywhere they bend towards the middle.
bool is_convex(const Facets& facets, std::span<const Facet> surface) {
  const auto corner = [&](const Facet& facet, size_t i) {
    return to_vec3(facets.points[facet.corners[i % 3]]);
  };
  Vec3 middle(0.0);
  for (const Facet& facet : surface) {
    middle += corner(facet, 0) + corner(facet, 1) + corner(facet, 2);
  }
  middle /= 3 * static_cast<double>(surface.size());
  EdgeTable edges(surface);
  std::vector<Vec3> normals;  // of length 1, towards the middle
  normals.reserve(surface.size());
  size_t largest = 0;
  double largest_area = 0;
  int facing = 0;
  for (uint32_t i = 0; i < surface.size(); ++i) {
    const auto& [a, b, c] = surface[i].corners;
    const Vec3 normal =
        plane_through(facets.points[a], facets.points[b], facets.points[c]).rounded_normal;
    const double area = glm::length(normal);
    const double height = glm::dot(normal, middle - corner(surface[i], 0));
    if (facing == 0) facing = sign_of(height);
    if (!(height * facing > kFlat * area)) return false;
    normals.push_back(normal * (facing / area));
    if (area > largest_area) largest = i;
    largest_area = std::max(area, largest_area);
    for (size_t j = 0; j < 3; ++j) {
      if (!edges.add(i, j)) return false;
    }
  }
  const Facet& first = surface[largest];
  const Vec3 direction =
      glm::normalize(corner(first, 0) + corner(first, 1) + corner(first, 2) - 3.0 * middle);
  constexpr double kRounding = 0x1p-40;  // of a sine: more than that of sums and products
  for (uint32_t i = 0; i < surface.size(); ++i) {
    bool lies_there = i != largest;
    for (size_t j = 0; j < 3; ++j) {
      const Vec3 from = corner(surface[i], j) - middle;
      const Vec3 to = corner(surface[i], j + 1) - middle;
      const double turn = -facing * glm::dot(glm::cross(from, to), direction);
      if (turn < -kRounding * glm::length(from) * glm::length(to)) lies_there = false;
      const uint32_t other = edges.find(surface[i].corners[(j + 1) % 3], surface[i].corners[j]);
      if (other == kNoPlace) return false;
      const Vec3 apex = corner(surface[other / 3], other % 3 + 2);
      if (glm::dot(normals[i], apex - corner(surface[i], 0)) < -kFlat) return false;
    }
    if (lies_there) return false;
  }
  return true;
}

/// Returns whether rounding may have folded the surface: a corner of a facet is so near to the edge
/// opposite it that it may be on the other side, and the facet lies over its neighbour; or all
/// corners are so near to the plane of the largest facet.
bool may_be_folded(const Facets& facets, std::span<const Facet> surface) {
  Vec3 largest(0.0);
  Vec3 origin(0.0);
  for (const Facet& facet : surface) {
    const auto& [a, b, c] = facet.corners;
    const Vec3 p = to_vec3(facets.points[a]);
    const Vec3 q = to_vec3(facets.points[b]) - p;
    const Vec3 r = to_vec3(facets.points[c]) - p;
    const Vec3 area = glm::cross(q, r);
    const double longest = std::max({glm::dot(q, q), glm::dot(r, r), glm::dot(r - q, r - q)});
    if (glm::dot(area, area) <= kFlat * kFlat * longest) return true;
    if (glm::dot(area, area) <= glm::dot(largest, largest)) continue;
    largest = area;
    origin = p;
  }
  const double most = kFlat * glm::length(largest);
  return std::ranges::all_of(surface, [&](const Facet& facet) {
    return std::ranges::all_of(facet.corners, [&](uint32_t corner) {
      return std::abs(glm::dot(largest, to_vec3(facets.points[corner]) - origin)) <= most;
    });
  });
}

}  // namespace

std::vector<bool> find_simple_surfaces(Surfaces operands, Facets& facets) {
  std::vector<std::span<Facet>> surfaces(operands.size());
  for (size_t begin = 0; begin < facets.facets.size();) {
    size_t end = begin + 1;
    const uint32_t operand = facets.facets[begin].operand;
    while (end < facets.facets.size() && facets.facets[end].operand == operand) ++end;
    surfaces[operand] = std::span(facets.facets).subspan(begin, end - begin);
    begin = end;
  }
  std::vector<uint8_t> may_cross(operands.size(), 0);
  const std::stop_token* const stop = stop_of_work;
  tbb::parallel_for(size_t{0}, operands.size(), [&](size_t i) {
    const StopScope scope(stop);
    stop_point();
    const std::span<Facet> surface = surfaces[i];
    if (surface.empty()) return;
    const bool is_simple = operands[i]->is_simple &&
                           surface.size() == operands[i]->triangles.size() &&
                           !may_be_folded(facets, surface);
    if (!is_simple && !is_convex(facets, surface)) {
      may_cross[i] = 1;
      return;
    }
    if (volume_of(facets, surface) >= 0) return;
    for (Facet& facet : surface) std::swap(facet.corners[1], facet.corners[2]);
  });
  return {may_cross.begin(), may_cross.end()};
}

}  // namespace csgcore
