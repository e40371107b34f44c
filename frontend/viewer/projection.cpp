#include "projection.hpp"

#include <glm/geometric.hpp>

namespace window {

std::optional<PicturePoint> project(const csgcore::View& view, const csgcore::Vec3& point) {
  const csgcore::Vec3 offset = point - view.eye;
  double scale = view.half_height;
  if (view.projection == csgcore::Projection::kPerspective) {
    const double depth = glm::dot(offset, view.forward);
    if (!(depth > 0)) return std::nullopt;
    scale *= depth;
  }
  const double unit = 0.5 * view.height_px / scale;
  return PicturePoint{0.5 * view.width_px + unit * glm::dot(offset, view.right),
                      0.5 * view.height_px - unit * glm::dot(offset, view.up)};
}

double pixel_size(const csgcore::View& view, const csgcore::Vec3& point) {
  const bool is_perspective = view.projection == csgcore::Projection::kPerspective;
  const double depth = is_perspective ? glm::dot(point - view.eye, view.forward) : 1;
  return 2 * view.half_height * depth / view.height_px;
}

}  // namespace window
