#include "edges/corners.hpp"

#include <cmath>
#include <glm/geometric.hpp>

namespace frontend {
namespace {

using csgcore::Vec3;

/// The sine of the angle below which two edges run along one line.
constexpr double kSameLine = 1e-5;
/// Designs have their corners at round numbers, which must not lie at the border of a cell.
constexpr double kShift = 0.382;

}  // namespace

void CornerSet::add(const Vec3& position, const Vec3& direction, uint32_t owner) {
  std::array<int64_t, 3> key;
  for (int axis = 0; axis < 3; ++axis) {
    key[static_cast<size_t>(axis)] = std::llround(position[axis] / size_ + kShift);
  }
  const auto [entry, is_new] = corners_.try_emplace(key);
  Corner& corner = entry->second;
  if (is_new) {
    corner.position = position;
    corner.direction = direction;
    corner.owner = owner;
    return;
  }
  if (glm::length(glm::cross(corner.direction, direction)) > kSameLine) {
    corner.turns = true;
    corner.is_passed = false;
  } else if (glm::dot(corner.direction, direction) < 0) {
    corner.is_passed = !corner.turns;
  }
}

}  // namespace frontend
