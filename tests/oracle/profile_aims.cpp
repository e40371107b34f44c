#include "profile_aims.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "checks.hpp"
#include "csgcore/profile.hpp"
#include "profile_figures.hpp"

namespace oracle {

using csgcore::Vec2;
using csgcore::Vec3;
using csgcore::checks::PivotRay;
using csgcore::checks::random_direction;
using csgcore::checks::uniform;

const char* name_of(Aim aim) {
  constexpr const char* kNames[kAims] = {"Any",     "AtAVertex",      "Tangent",
                                         "Grazing", "AlongAxis",      "ThroughAxis",
                                         "Level",   "ToAnotherPoint", "FromFarAway"};
  return kNames[static_cast<int>(aim)];
}

AimedRays::AimedRays(const csgcore::Primitive& primitive, const Vec3& pivot, std::mt19937& random)
    : primitive_(primitive),
      pivot_(pivot),
      random_(random),
      size_(std::max(primitive.profile()->half().x, primitive.profile()->half().y)) {}

double AimedRays::power(double low, double high) {
  return std::pow(10, uniform(random_, low, high));
}

double AimedRays::near_miss() { return (random_() % 2 ? 1 : -1) * size_ * power(-17, -3); }

AimedRays::Place AimedRays::revolved(const Vec2& at, const Vec2& tangent) {
  const double angle = random_() % 3 ? uniform(random_, 0, 2 * std::numbers::pi) : 0;
  const double c = std::cos(angle), s = std::sin(angle);
  return {{c * at.x, s * at.x, at.y},
          {c * tangent.x, s * tangent.x, tangent.y},
          {-s, c, 0},
          {c * tangent.y, s * tangent.y, -tangent.x}};
}

AimedRays::Place AimedRays::extruded(const Vec2& at, const Vec2& tangent) {
  const double share = random_() % 3 ? uniform(random_, 0, 1) : static_cast<double>(random_() % 2);
  const auto& [profile, z_min, z_max, bottom, top] = primitive_.as<csgcore::ExtrusionShape>();
  const double growth = top - bottom;
  const double height = z_max - z_min;
  const double scale = bottom + share * growth;
  const Vec3 leading{growth * at.x, growth * at.y, height}, along{tangent.x, tangent.y, 0};
  return {{scale * at.x, scale * at.y, z_min + share * height},
          glm::normalize(leading),
          along,
          glm::normalize(glm::cross(along, leading))};
}

AimedRays::Place AimedRays::next_place(bool is_vertex) {
  const auto loops = primitive_.profile()->loops();
  const csgcore::ProfileLoop& loop = loops[random_() % loops.size()];
  const size_t i = random_() % loop.size();
  const Vec2 start = i == 0 ? loop.back().end : loop[i - 1].end;
  const double share = is_vertex ? static_cast<double>(random_() % 2) : uniform(random_, 0, 1);
  const auto [at, tangent] = csgcore::checks::edge_point(start, loop[i], share);
  // A curve whose control point is at its end has no tangent there.
  const Vec2 along = glm::length(tangent) > 0 ? glm::normalize(tangent) : Vec2(1, 0);
  return primitive_.shape() == csgcore::Shape::kRevolution ? revolved(at, along)
                                                           : extruded(at, along);
}

Vec3 AimedRays::touching(const Place& place) {
  const auto kind = random_() % 4;
  if (kind == 0) return place.up;
  if (kind == 1) return place.around;
  const double lean = kind == 2 ? uniform(random_, -2, 2) : power(-9, 0);
  return random_() % 2 ? place.around + lean * place.up : place.up + lean * place.around;
}

Vec3 AimedRays::nearly_upright() {
  const Vec3 up{0, 0, random_() % 2 ? 1 : -1};
  return random_() % 2 ? up : up + power(-20, -2) * random_direction(random_);
}

Vec3 AimedRays::nearly_level(const Place& place) {
  const Vec3 rise{0, 0, random_() % 2 ? 0 : power(-20, -2)};
  if (random_() % 2) return place.around + rise;
  if (random_() % 2) return Vec3(1, 0, 0) + rise;
  const double angle = uniform(random_, 0, 2 * std::numbers::pi);
  return Vec3(std::cos(angle), std::sin(angle), 0) + rise;
}

PivotRay AimedRays::next(Aim aim) {
  const Place place = next_place(aim == Aim::kAtAVertex);
  Vec3 point = place.point, direction = random_direction(random_);
  double furthest = 3;
  switch (aim) {
    case Aim::kAny:
    case Aim::kAtAVertex:
      break;
    case Aim::kTangent:
      direction = touching(place);
      break;
    case Aim::kGrazing:
      direction = touching(place);
      point += near_miss() * place.normal;
      break;
    case Aim::kAlongAxis:
      direction = nearly_upright();
      if (random_() % 3 == 0) point += power(-17, 0) * size_ * place.normal;
      break;
    case Aim::kThroughAxis:
      direction = Vec3(0, 0, next_place(false).point.z) - point;
      if (random_() % 2) direction += near_miss() * random_direction(random_);
      break;
    case Aim::kLevel:
      direction = nearly_level(place);
      break;
    case Aim::kToAnotherPoint:
      direction = next_place(random_() % 2).point - point;
      break;
    case Aim::kFromFarAway:
      furthest = power(1, 6);
      if (random_() % 2) direction = touching(place);
      break;
  }
  if (!(glm::length(direction) > 0)) direction = {1, 0, 0};
  const csgcore::Affine& map = primitive_.local_to_world;
  const Vec3 along = power(-2, 2) * map.direction(glm::normalize(direction));
  const Vec3 at = map.direction(point) + (map.translation - pivot_);
  if (random_() % 3 == 0 && aim != Aim::kFromFarAway) return {at, along};
  const double size_world = glm::length(map.direction(place.point)) + glm::length(along);
  return {at - uniform(random_, -furthest, furthest) * size_world / glm::length(along) * along,
          along};
}

}  // namespace oracle
