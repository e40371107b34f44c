#include "csgcore/view.hpp"

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>

namespace csgcore {

Ray pixel_ray(const View& view, double x_px, double y_px) {
  const double height = view.height_px;
  const double u = (2 * (x_px + 0.5) - view.width_px) / height * view.half_height;
  const double v = (height - 2 * (y_px + 0.5)) / height * view.half_height;
  const Vec3 lateral = u * view.right + v * view.up;
  if (view.projection == Projection::kOrthographic) return {view.eye + lateral, view.forward};
  return {view.eye, view.forward + lateral};
}

double projected_size_px(const View& view, const Box& box) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  double min_u = kInfinity, max_u = -kInfinity, min_v = kInfinity, max_v = -kInfinity;
  int behind = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 point{(corner & 1) ? box.max.x : box.min.x, (corner & 2) ? box.max.y : box.min.y,
                     (corner & 4) ? box.max.z : box.min.z};
    const Vec3 offset = point - view.eye;
    double scale = 1;
    if (view.projection == Projection::kPerspective) {
      const double depth = glm::dot(offset, view.forward);
      if (depth <= 0) {
        ++behind;
        continue;
      }
      scale = 1 / depth;
    }
    const double u = glm::dot(offset, view.right) * scale;
    const double v = glm::dot(offset, view.up) * scale;
    min_u = std::min(min_u, u);
    max_u = std::max(max_u, u);
    min_v = std::min(min_v, v);
    max_v = std::max(max_v, v);
  }
  if (behind == 8) return 0;
  if (behind > 0) return kInfinity;
  return std::max(max_u - min_u, max_v - min_v) * 0.5 * view.height_px / view.half_height;
}

}  // namespace csgcore
