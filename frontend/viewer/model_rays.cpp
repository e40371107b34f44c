#include "model_rays.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

namespace window {
namespace {

using csgcore::Hits;
using csgcore::Projection;
using csgcore::Vec3;
using csgcore::View;

/// Makes a view of `side_px` × `side_px` pixels whose middle is a ray of another view, and whose
/// pixels are as large.
View view_around(const View& view, const PicturePoint& place, uint32_t side_px) {
  const csgcore::Ray ray = ray_through(view, place);
  View result = view;
  result.width_px = result.height_px = side_px;
  result.half_height = view.half_height * side_px / view.height_px;
  if (view.projection == Projection::kOrthographic) {
    result.eye = ray.origin;
  } else {
    result.forward = ray.direction;
    result.right = glm::normalize(glm::cross(result.forward, view.up));
    result.up = glm::cross(result.right, result.forward);
  }
  return result;
}

/// Makes a view whose middle ray begins at a point.
View view_along(const Vec3& from, const Vec3& direction, const Vec3& up) {
  View view;
  view.eye = from;
  view.forward = direction;
  view.up = up;
  view.right = glm::cross(direction, up);
  view.width_px = view.height_px = 1;
  return view;
}

}  // namespace

ModelRays::ModelRays(Look look, std::span<const csgcore::Primitive> primitives)
    : look_(std::move(look)), primitives_(primitives) {}

RayHit ModelRays::hit_of(const Hits& hits, std::size_t pixel) const {
  RayHit hit{hits.position[pixel], hits.normal[pixel], hits.primitive[pixel], {}};
  hit.surface = surface_at(primitives_[hit.primitive], hit.position, hit.normal);
  return hit;
}

void ModelRays::add_hits(const View& view, std::vector<RayHit>& result) const {
  const Hits hits = look_(view);
  for (std::size_t pixel = 0; pixel < hits.primitive.size(); ++pixel) {
    if (hits.primitive[pixel] != Hits::kMiss) result.push_back(hit_of(hits, pixel));
  }
}

std::optional<RayHit> ModelRays::along(const Vec3& from, const Vec3& direction,
                                       double reach) const {
  const Hits hits = look_(view_along(from, direction, direction_across(direction, 0)));
  if (hits.primitive[0] == Hits::kMiss || hits.s[0] > reach) return std::nullopt;
  return hit_of(hits, 0);
}

std::vector<RayHit> ModelRays::across(const Vec3& from, const Vec3& normal) const {
  constexpr int kViews = 4;  // a quarter turn each, nearly
  constexpr uint32_t kRaysOfView = 8;
  std::vector<RayHit> result;
  for (int i = 0; i < kViews; ++i) {
    View view = view_along(from, direction_across(normal, 2 * M_PI * i / kViews), normal);
    view.width_px = kRaysOfView;
    view.half_height = 1.0 / kRaysOfView;
    add_hits(view, result);
  }
  return result;
}

std::optional<RayHit> ModelRays::seen_at(const View& view, const PicturePoint& place) const {
  const Hits hits = look_(view_around(view, place, 1));
  if (hits.primitive[0] == Hits::kMiss) return std::nullopt;
  return hit_of(hits, 0);
}

std::vector<RayHit> ModelRays::seen_around(const View& view, const PicturePoint& place,
                                           uint32_t side_px) const {
  std::vector<RayHit> result;
  add_hits(view_around(view, place, side_px), result);
  return result;
}

bool ModelRays::shows(const View& view, const Vec3& point) const {
  const std::optional<PicturePoint> place = project(view, point);
  if (!place) return false;
  const std::optional<RayHit> hit = seen_at(view, *place);
  // At the rim of a face the ray may just pass it.
  return !hit || glm::dot(hit->position - point, view.forward) > -pixel_size(view, point);
}

csgcore::Ray ray_through(const View& view, const PicturePoint& place) {
  csgcore::Ray ray = csgcore::pixel_ray(view, place.x_px - 0.5, place.y_px - 0.5);
  ray.direction = glm::normalize(ray.direction);
  return ray;
}

Vec3 direction_across(const Vec3& axis, double angle_rad) {
  const Vec3 helper = std::abs(axis.x) < 0.5 ? Vec3(1, 0, 0) : Vec3(0, 1, 0);
  const Vec3 u = glm::normalize(glm::cross(axis, helper));
  return std::cos(angle_rad) * u + std::sin(angle_rad) * glm::cross(axis, u);
}

}  // namespace window
