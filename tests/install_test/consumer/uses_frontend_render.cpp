// From text to a picture: the ball has the scheme's background around it.
#include "frontend/importer.hpp"
#include "frontend/parser.hpp"
#include "frontend/render.hpp"

int main() {
  const auto design = frontend::import_design(frontend::parse("sphere(r = 1);", "ball.csg"));
  csgcore::View view;
  view.projection = csgcore::Projection::kOrthographic;
  view.eye = {0, 0, 10};
  view.half_height = 2;
  view.width_px = view.height_px = 32;
  frontend::RenderSettings settings;
  settings.scheme = {"mine", {0, 0, 255}, {255, 255, 0}, {0, 255, 0}, {0, 0, 0}, {255, 0, 0}};
  frontend::RenderStats stats;
  const csgcore::Image image = frontend::render(design.scene, view, settings, stats);
  const std::array<uint8_t, 3> background{0, 0, 255};
  const bool right = image.rgb[0] == background && image.rgb[16 * 32 + 16] != background;
  return right ? 0 : 1;
}
