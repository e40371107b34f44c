// A ball is drawn without a display: it fills the middle of the picture, not its corner.
#include "csgcore/scene.hpp"
#include "csgcore/solid.hpp"
#include "csgcore/subdivision.hpp"
#include "glrender/context.hpp"
#include "glrender/renderer.hpp"

int main() {
  csgcore::Scene scene;
  scene.primitives.push_back(csgcore::make_sphere(1));
  csgcore::CsgTreeBuilder builder;
  builder.primitive(0);
  scene.model = builder.finish();
  const csgcore::Solid solid(csgcore::canonical_primitives(scene), scene.model);
  const csgcore::Subdivision subdivision(solid, {});

  csgcore::View view;
  view.projection = csgcore::Projection::kOrthographic;
  view.eye = {0, 0, 10};
  view.half_height = 2;
  view.width_px = view.height_px = 32;
  glrender::FrameSettings settings;
  settings.background = {0, 0, 1};
  glrender::FrameStats stats;

  glrender::HeadlessContext context;
  glrender::Renderer renderer(context, solid);
  renderer.load(subdivision);
  const csgcore::Image image = renderer.draw(view, settings, stats);
  const std::array<uint8_t, 3> background{0, 0, 255};
  const bool right = image.rgb[0] == background && image.rgb[16 * 32 + 16] != background;
  return right ? 0 : 1;
}
