#include "arrangement/simple_surfaces.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "csgcore/stop_scope.hpp"

namespace csgcore {
namespace {

struct EdgeOfFacet {
  uint32_t low;  // its ends
  uint32_t high;
  uint32_t facet;
  uint32_t apex;   // the facet's other corner
  bool is_rising;  // from low to high
  auto operator<=>(const EdgeOfFacet&) const = default;
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

/// Returns whether the facets around each corner wind once around the sum of their normals.
/// `corners` are all of them, in rising order.
bool wind_once(const Facets& facets, std::span<const Facet> surface,
               std::span<const uint32_t> corners) {
  const auto place_of = [&](uint32_t corner) {
    return static_cast<size_t>(std::ranges::lower_bound(corners, corner) - corners.begin());
  };
  struct Around {
    Vec3 normal{0.0};
    double angle = 0;
  };
  std::vector<Around> around(corners.size());
  const auto corner = [&](const Facet& facet, size_t i) {
    return to_vec3(facets.points[facet.corners[i % 3]]);
  };
  for (const Facet& facet : surface) {
    const Vec3 area =
        glm::cross(corner(facet, 1) - corner(facet, 0), corner(facet, 2) - corner(facet, 0));
    for (const uint32_t place : facet.corners)
      around[place_of(place)].normal += glm::normalize(area);
  }
  for (const Facet& facet : surface) {
    for (size_t i = 0; i < 3; ++i) {
      Around& at = around[place_of(facet.corners[i])];
      const Vec3 axis = glm::normalize(at.normal);
      const Vec3 p = corner(facet, i + 1) - corner(facet, i);
      const Vec3 q = corner(facet, i + 2) - corner(facet, i);
      at.angle += std::atan2(glm::dot(axis, glm::cross(p, q)),
                             glm::dot(p, q) - glm::dot(axis, p) * glm::dot(axis, q));
    }
  }
  return std::ranges::all_of(
      around, [](const Around& at) { return std::abs(at.angle - 2 * std::numbers::pi) < 1; });
}

/// Returns whether the facets are, but for rounding, the boundary of a convex solid. At each edge
/// two of them meet, and bend towards the same side everywhere; by Euler's formula they are one
/// sphere. A closed surface that is convex near each of its points bounds a convex solid (van
/// Heijenoort, "On locally convex manifolds", 1952).
bool is_convex(const Facets& facets, std::span<const Facet> surface) {
  std::vector<EdgeOfFacet> edges;
  edges.reserve(3 * surface.size());
  std::vector<uint32_t> corners;
  for (uint32_t i = 0; i < surface.size(); ++i) {
    for (size_t j = 0; j < 3; ++j) {
      const uint32_t a = surface[i].corners[j];
      const uint32_t b = surface[i].corners[(j + 1) % 3];
      edges.push_back({std::min(a, b), std::max(a, b), i, surface[i].corners[(j + 2) % 3], a < b});
      corners.push_back(a);
    }
  }
  if (edges.size() % 2 != 0) return false;
  std::ranges::sort(corners);
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  if (corners.size() + surface.size() != edges.size() / 2 + 2) return false;
  std::ranges::sort(edges);
  const auto plane_of = [&](uint32_t facet) {
    const auto& [a, b, c] = surface[facet].corners;
    return plane_through(facets.points[a], facets.points[b], facets.points[c]);
  };
  int bend = 0;
  for (size_t i = 0; i < edges.size(); i += 2) {
    const EdgeOfFacet& edge = edges[i];
    const EdgeOfFacet& other = edges[i + 1];
    if (edge.low != other.low || edge.high != other.high || edge.is_rising == other.is_rising) {
      return false;
    }
    if (i + 2 < edges.size() && edges[i + 2].low == edge.low && edges[i + 2].high == edge.high) {
      return false;
    }
    const GridPlane plane = plane_of(edge.facet);
    const Vec3 to_apex = to_vec3(facets.points[other.apex]) - to_vec3(plane.point);
    const double height = glm::dot(plane.rounded_normal, to_apex);
    const int next = sign_of(height);
    if (std::abs(height) < kFlat * glm::length(plane.rounded_normal)) {
      // Facets of one plane lie on different sides of their edge.
      const auto turn_of = [&](uint32_t apex) {
        return turn(facets.points[edge.low], facets.points[edge.high], facets.points[apex],
                    plane.axis());
      };
      if (turn_of(edge.apex) == turn_of(other.apex)) return false;
    } else if (bend == 0) {
      bend = next;
    } else if (bend != next) {
      return false;
    }
  }
  return bend != 0 && wind_once(facets, surface, corners);
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
    if (!operands[i]->is_simple && !is_convex(facets, surface)) {
      may_cross[i] = 1;
      return;
    }
    if (volume_of(facets, surface) >= 0) return;
    for (Facet& facet : surface) std::swap(facet.corners[1], facet.corners[2]);
  });
  return {may_cross.begin(), may_cross.end()};
}

}  // namespace csgcore
