#include "base/plane_faces.hpp"

#include <glm/geometric.hpp>

namespace frontend {

bool parallel(const csgcore::Vec3& unit_a, const csgcore::Vec3& unit_b) {
  return glm::length(glm::cross(unit_a, unit_b)) <= kParallel;
}

}  // namespace frontend
