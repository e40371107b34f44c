#include "frontend/render_settings.hpp"

#include <tuple>

namespace frontend {

bool draw_the_same(const RenderSettings& a, const RenderSettings& b) {
  const auto what = [](const RenderSettings& s) {
    return std::tuple(s.scheme.background, s.scheme.front, s.scheme.back, s.scheme.axes,
                      s.from_within, s.shading, s.show, s.technique, s.samples, s.leaf_primitives,
                      s.threshold_px, s.measured_channels);
  };
  return what(a) == what(b);
}

}  // namespace frontend
