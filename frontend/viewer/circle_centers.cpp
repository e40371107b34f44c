#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "snap.hpp"

namespace window {
namespace {

using csgcore::Vec3;
using csgcore::View;
using Kind = Surface::Kind;

/// Rays run beside a wall by this share of its radius, which thinner rings than that would hide.
constexpr double kBeside = 1e-3;
/// The places around a circle at which it is looked for: parts of it may be cut off.
constexpr int kPlaces = 8;
/// Two heights are the same if they differ by less than this share of the radius: rays on both
/// sides of the wall then meet one face, which no circle is in.
constexpr double kSameHeight = 1e-6;
/// Centres that are seen this near to each other are behind each other.
constexpr double kBehind_px = 1;

/// The distance of a place from a line between two places.
double segment_distance_px(const PicturePoint& place, const PicturePoint& a,
                           const PicturePoint& b) {
  const double x = b.x_px - a.x_px, y = b.y_px - a.y_px, length2 = x * x + y * y;
  const double along = (place.x_px - a.x_px) * x + (place.y_px - a.y_px) * y;
  const double share = length2 > 0 ? std::clamp(along / length2, 0.0, 1.0) : 0;
  return std::hypot(a.x_px + share * x - place.x_px, a.y_px + share * y - place.y_px);
}

class CenterSearch {
 public:
  CenterSearch(const ModelRays& rays, const View& view, const PicturePoint& click, double reach_px)
      : rays_(rays), view_(view), click_(click), reach_px_(reach_px) {}

  std::optional<RayHit> find() {
    for (uint32_t i = 0; i < rays_.primitives().size(); ++i) {
      for (const RoundWall& wall : round_walls(rays_.primitives()[i])) {
        if (is_near(wall)) look_at(wall, i);
      }
    }
    return best_;
  }

 private:
  bool is_near(const RoundWall& wall) const {
    const auto a = project(view_, wall.centers[0]), b = project(view_, wall.centers[1]);
    return a && b && segment_distance_px(click_, *a, *b) <= reach_px_;
  }

  /// Follows the wall on both of its sides, from both of its ends.
  void look_at(const RoundWall& wall, uint32_t primitive) {
    const Vec3 axis = glm::normalize(wall.centers[1] - wall.centers[0]);
    const double most = std::max(wall.radii[0], wall.radii[1]);
    if (!(most > 0)) return;
    for (int place = 0; place < kPlaces; ++place) {
      const Vec3 outwards = direction_across(axis, 2 * M_PI * place / kPlaces);
      for (const bool is_upwards : {false, true}) {
        const auto inner = first_face(wall, axis, outwards, -kBeside * most, is_upwards);
        const auto outer = first_face(wall, axis, outwards, kBeside * most, is_upwards);
        if (inner && outer && std::abs(*inner - *outer) <= kSameHeight * most) continue;
        for (const auto& height : {inner, outer}) {
          if (height) offer(wall, *height, outwards, primitive);
        }
      }
    }
  }

  /// Returns how high above the wall's first end a ray beside the wall meets a face across the
  /// axis.
  std::optional<double> first_face(const RoundWall& wall, const Vec3& axis, const Vec3& outwards,
                                   double beside, bool is_upwards) const {
    const double lower = wall.radii[0] + beside, upper = wall.radii[1] + beside;
    if (lower <= 0 && upper <= 0) return std::nullopt;
    const Vec3 low = wall.centers[0] + std::max(lower, 0.0) * outwards;
    const Vec3 high = wall.centers[1] + std::max(upper, 0.0) * outwards;
    const Vec3 way = glm::normalize(is_upwards ? high - low : low - high);
    // It begins before the wall, whose own end may be the face.
    const double before = std::abs(beside);
    const Vec3 from = (is_upwards ? low : high) - before * way;
    const auto hit = rays_.along(from, way, glm::distance(low, high) + 2 * before);
    if (!hit || hit->surface.kind != Kind::kPlane) return std::nullopt;
    if (glm::length(glm::cross(hit->normal, axis)) > kSameHeight) return std::nullopt;
    return glm::dot(hit->position - wall.centers[0], axis);
  }

  /// Takes the centre of the circle at a height if its point on that side is seen.
  void offer(const RoundWall& wall, double height, const Vec3& outwards, uint32_t primitive) {
    const Vec3 way = wall.centers[1] - wall.centers[0];
    const double share = height / glm::length(way);
    const double radius = wall.radii[0] + share * (wall.radii[1] - wall.radii[0]);
    const Vec3 center = wall.centers[0] + share * way;
    const auto seen = project(view_, center);
    if (!seen || !(radius > 0)) return;
    const double distance = std::hypot(seen->x_px - click_.x_px, seen->y_px - click_.y_px);
    if (distance > reach_px_ || (best_ && !is_better(center, distance))) return;
    if (!rays_.shows(view_, center + radius * outwards)) return;
    const Vec3 axis = glm::normalize(way);
    best_ = RayHit{center, axis, primitive, {Kind::kCircle, center, axis, radius}};
    best_px_ = distance;
  }

  bool is_better(const Vec3& center, double distance) const {
    if (std::abs(distance - best_px_) > kBehind_px) return distance < best_px_;
    return glm::dot(center - best_->position, view_.forward) < 0;
  }

  const ModelRays& rays_;
  const View& view_;
  const PicturePoint click_;
  const double reach_px_;
  std::optional<RayHit> best_;
  double best_px_ = 0;
};

}  // namespace

std::optional<RayHit> center_of_circle(const ModelRays& rays, const View& view,
                                       const PicturePoint& click, double reach_px) {
  return CenterSearch(rays, view, click, reach_px).find();
}

}  // namespace window
