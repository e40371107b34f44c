#include "seen_ray.hpp"

#include <cmath>
#include <glm/geometric.hpp>

namespace validation {

using csgcore::Hits;
using csgcore::Vec3;

Seen seen_at(const Hits& hits, std::size_t pixel) {
  return {hits.primitive[pixel], hits.s[pixel], hits.position[pixel], hits.normal[pixel]};
}

Json json_of(const Vec3& v) { return {v.x, v.y, v.z}; }

Json json_of(const csgcore::Ray& ray, csgcore::Projection projection) {
  const bool is_perspective = projection == csgcore::Projection::kPerspective;
  return {{"origin", json_of(ray.origin)},
          {"direction", json_of(ray.direction)},
          {"projection", is_perspective ? "perspective" : "orthographic"}};
}

Json json_of(const Seen& seen) {
  if (!seen.hit()) return {{"hit", false}};
  return {{"hit", true},
          {"primitive", seen.primitive},
          {"position", json_of(seen.position)},
          {"normal", json_of(seen.normal)}};
}

csgcore::Ray moved(const csgcore::Ray& ray, double angle, double aside, double forward) {
  const Vec3 ahead = glm::normalize(ray.direction);
  const Vec3 across = std::abs(ahead.x) < 0.5 ? Vec3(1, 0, 0) : Vec3(0, 1, 0);
  const Vec3 right = glm::normalize(glm::cross(ahead, across));
  const Vec3 up = glm::cross(right, ahead);
  const Vec3 sideways = std::cos(angle) * right + std::sin(angle) * up;
  return {ray.origin + aside * sideways + forward * ahead, ray.direction};
}

}  // namespace validation
