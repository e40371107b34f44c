#include "primitives/revolution_path.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace csgcore {
namespace {

/// The solid lies within |z| ≤ 1, hypot(x, y) ≤ 1, and in a ball of this squared radius.
constexpr double kEnclosure2 = 2.0001;
/// A ray is level, or runs along the axis, if its direction has less than this share along it, or
/// across it. Within the solid it does not drift by a bit of its coordinates.
constexpr double kTrace = 1e-30;

}  // namespace

bool find_path(const Vec3& origin, const Vec3& direction, double inverse_length2,
               RevolutionPath& path) {
  const double beside2 = kEnclosure2 - glm::dot(origin, origin);
  if (!(beside2 > 0)) return false;
  path.unit = std::sqrt(inverse_length2);
  const double half_chord = std::sqrt(beside2);
  double first = -half_chord, last = half_chord;  // from the origin, per unit of length
  const Vec3 along = direction * path.unit;
  path.run = std::hypot(along.x, along.y);
  path.rise = along.z;
  if (std::abs(path.rise) <= kTrace) path.rise = 0;
  if (path.run <= kTrace) path.run = 0;
  // The solid's height, and a little more.
  constexpr double kEnd = 1 + 1e-9;
  if (path.rise != 0) {
    const double enter = (-path.upwards() * kEnd - origin.z) / path.rise,
                 leave = (path.upwards() * kEnd - origin.z) / path.rise;
    first = std::max(first, enter);
    last = std::min(last, leave);
  } else if (std::abs(origin.z) > 1) {
    return false;
  }
  if (!(first < last)) return false;
  double base = 0;
  path.starts_nearest = false;
  if (path.run > 0) {
    const double nearest = -(origin.x * along.x + origin.y * along.y) / (path.run * path.run);
    base = std::clamp(nearest, first, last);
    path.starts_nearest = base == nearest;
  }
  const Vec3 start = origin + base * along;
  const Vec2 ahead = path.run > 0 ? Vec2{along.x, along.y} / path.run : Vec2{1, 0};
  path.start = start.x * ahead.x + start.y * ahead.y;
  path.offset = std::abs(start.x * ahead.y - start.y * ahead.x);
  path.height = start.z;
  path.first = first - base;
  path.last = last - base;
  path.base = base * path.unit;
  return path.offset <= 1;
}

}  // namespace csgcore
