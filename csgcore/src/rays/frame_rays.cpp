#include "rays/frame_rays.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "csgcore/tolerance.hpp"

namespace csgcore {
namespace {

/// The product of a number of 26 bits with either half of a double's 53 bits is exact.
double rounded_to_26_bits(double x) {
  if (x == 0 || !std::isfinite(x)) return 0;
  const int exponent = std::ilogb(x);
  return std::ldexp(std::round(std::ldexp(x, 25 - exponent)), exponent - 25);
}

}  // namespace

FrameRays frame_rays(const View& view, const Box& solid_bounds) {
  FrameRays frame;
  frame.view = view;
  const Vec3 middle = solid_bounds.empty() ? view.eye : solid_bounds.center();
  frame.base_s = rounded_to_26_bits(glm::dot(middle - view.eye, view.forward));
  frame.pivot = view.eye + frame.base_s * view.forward;
  frame.first_t = view.projection == Projection::kPerspective
                      ? thickness_tolerance(solid_bounds) - frame.base_s
                      : -std::numeric_limits<double>::max();
  for (uint32_t x = 0; x < view.width_px + FrameRays::kBeyond_px; ++x)
    frame.u_of_column.push_back(frame.u(x));
  for (uint32_t y = 0; y < view.height_px + FrameRays::kBeyond_px; ++y)
    frame.v_of_row.push_back(frame.v(y));
  return frame;
}

}  // namespace csgcore
