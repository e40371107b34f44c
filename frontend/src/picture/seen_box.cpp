#include "picture/seen_box.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>

namespace frontend {
namespace {

using csgcore::Box;
using csgcore::Image;
using csgcore::Vec3;
using csgcore::View;

constexpr uint32_t kOverview_px = 512;  // a side of the first picture
constexpr uint32_t kCloseUp_px = 32;    // a side of the pictures around the farthest pixel
constexpr double kCloseUpReach = 1.5;   // half their side, in pixels of the picture before: the
                                        // neighbours are included
constexpr int kCloseUps = 3;            // each enlarges by 32 / 3

/// Returns a view of the solid from outside along an axis. The point nearest to the eye is the
/// farthest one in that direction.
View outside_view(const Box& around, int axis, double sign) {
  View view;
  view.projection = csgcore::Projection::kOrthographic;
  view.forward = view.right = view.up = Vec3(0.0);
  view.forward[axis] = -sign;
  view.right[(axis + 1) % 3] = sign;
  view.up[(axis + 2) % 3] = 1;
  const Vec3 half = 0.5 * around.size();
  // The reach has some room, and is not 0 for a flat box.
  const double reach = 1.01 * std::max({half.x, half.y, half.z});
  view.eye = around.center() - reach * view.forward;
  view.half_height = reach;
  view.width_px = view.height_px = kOverview_px;
  return view;
}

/// Returns the pixel with the hit nearest to the eye.
std::optional<std::size_t> nearest_pixel(const Image& image) {
  const auto nearest = std::min_element(image.z.begin(), image.z.end());
  if (nearest == image.z.end() || !std::isfinite(*nearest)) return std::nullopt;
  return static_cast<std::size_t>(nearest - image.z.begin());
}

/// Returns the solid's farthest coordinate in that direction.
std::optional<double> farthest(const Box& around, int axis, double sign, const DrawView& draw) {
  View view = outside_view(around, axis, sign);
  std::optional<double> result;
  for (int look = 0; look <= kCloseUps; ++look) {
    const Image image = draw(view);
    const std::optional<std::size_t> pixel = nearest_pixel(image);
    if (!pixel) break;
    const double found = view.eye[axis] - sign * image.z[*pixel];
    result = !result || sign * found > sign * *result ? found : *result;
    const double x = static_cast<double>(*pixel % view.width_px);
    const double y = static_cast<double>(*pixel / view.width_px);
    view.eye = csgcore::pixel_ray(view, x, y).origin;
    view.half_height *= 2 * kCloseUpReach / view.height_px;
    view.width_px = view.height_px = kCloseUp_px;
  }
  return result;
}

}  // namespace

Box seen_box(const Box& around, const DrawView& draw) {
  Box box;
  if (around.empty()) return box;
  Vec3 least, most;
  for (int axis = 0; axis < 3; ++axis) {
    const std::optional<double> low = farthest(around, axis, -1, draw);
    const std::optional<double> high = farthest(around, axis, 1, draw);
    if (!low || !high) return box;
    least[axis] = *low;
    most[axis] = *high;
  }
  box.merge(least);
  box.merge(most);
  return box;
}

}  // namespace frontend
