#include "csgcore/view.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "base/constants.hpp"

namespace csgcore {

PixelArea intersection(const PixelArea& a, const PixelArea& b) {
  const uint32_t left = std::max(a.x, b.x), top = std::max(a.y, b.y);
  const uint32_t right = std::min(a.x + a.width, b.x + b.width);
  const uint32_t bottom = std::min(a.y + a.height, b.y + b.height);
  if (left >= right || top >= bottom) return {};
  return {left, top, right - left, bottom - top};
}

Ray pixel_ray(const View& view, double x_px, double y_px) {
  const double height = view.height_px;
  const double u = (2 * (x_px + 0.5) - view.width_px) / height * view.half_height;
  const double v = (height - 2 * (y_px + 0.5)) / height * view.half_height;
  const Vec3 lateral = u * view.right + v * view.up;
  if (view.projection == Projection::kOrthographic) return {view.eye + lateral, view.forward};
  return {view.eye, view.forward + lateral};
}

double projected_size_px(const View& view, const Box& box) {
  constexpr int kCorners = 8;
  // A corner's coordinates along the view's axes are those of the lowest corner plus the edges to
  // the far end of those axes of the box at which it lies. The loops run over all corners without
  // branches, since every cell of a subdivision with a threshold comes here.
  const Vec3 low = box.min - view.eye;
  const Vec3 size = box.size();
  double u[kCorners], v[kCorners], depth[kCorners];
  u[0] = glm::dot(low, view.right);
  v[0] = glm::dot(low, view.up);
  depth[0] = glm::dot(low, view.forward);
  for (int axis = 0; axis < 3; ++axis) {
    const int first = 1 << axis;
    for (int corner = first; corner < 2 * first; ++corner) {
      u[corner] = u[corner - first] + size[axis] * view.right[axis];
      v[corner] = v[corner - first] + size[axis] * view.up[axis];
      depth[corner] = depth[corner - first] + size[axis] * view.forward[axis];
    }
  }
  if (view.projection == Projection::kPerspective) {
    double nearest = depth[0], furthest = depth[0];
    for (int corner = 1; corner < kCorners; ++corner) {
      nearest = std::min(nearest, depth[corner]);
      furthest = std::max(furthest, depth[corner]);
    }
    if (furthest <= 0) return 0;
    if (nearest <= 0) return kInfinity;
    for (int corner = 0; corner < kCorners; ++corner) {
      const double scale = 1 / depth[corner];
      u[corner] *= scale;
      v[corner] *= scale;
    }
  }
  double min_u = u[0], max_u = u[0], min_v = v[0], max_v = v[0];
  for (int corner = 1; corner < kCorners; ++corner) {
    min_u = std::min(min_u, u[corner]);
    max_u = std::max(max_u, u[corner]);
    min_v = std::min(min_v, v[corner]);
    max_v = std::max(max_v, v[corner]);
  }
  return std::max(max_u - min_u, max_v - min_v) * 0.5 * view.height_px / view.half_height;
}

bool projects_below(const View& view, const Box& box, double size_px) {
  // One diagonal of the box mostly shows that the projection is larger.
  const Vec3 low = box.min - view.eye;
  const Vec3 high = box.max - view.eye;
  double low_scale = 1, high_scale = 1;
  if (view.projection == Projection::kPerspective) {
    low_scale = 1 / glm::dot(low, view.forward);
    high_scale = 1 / glm::dot(high, view.forward);
  }
  if (low_scale > 0 && high_scale > 0) {
    const Vec3 across = high * high_scale - low * low_scale;
    const double reach =
        std::max(std::abs(glm::dot(across, view.right)), std::abs(glm::dot(across, view.up)));
    if (reach * 0.5 * view.height_px >= size_px * view.half_height) return false;
  }
  return projected_size_px(view, box) < size_px;
}

}  // namespace csgcore
