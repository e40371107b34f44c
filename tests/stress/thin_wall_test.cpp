// Tests that a wall of 1e-6 of the model's size, given in one frame or built in memory, is drawn
// whole.
#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "cases.hpp"
#include "cpu_methods.hpp"
#include "frontend/importer.hpp"
#include "frontend/parser.hpp"

namespace {

using csgcore::Hits;
using csgcore::Solid;
using stress::ball;
using stress::Part;
using stress::rod;
using stress::Scene;

constexpr double kWall = 1e-6;  // of models that are about 1 across

Scene imported(const std::string& csg) {
  return frontend::import_design(frontend::parse(csg, "wall.csg")).scene;
}

/// Expects that every pixel of `thin` shows what `filled`, the same solid without its cavity,
/// shows.
void expect_whole(const Scene& thin, const Scene& filled, const stress::Method& method) {
  SCOPED_TRACE(method.name);
  const Solid thin_solid(csgcore::canonical_primitives(thin), thin.model);
  const Solid filled_solid(csgcore::canonical_primitives(filled), filled.model);
  const stress::Drawer draw_thin = method.prepare(thin, thin_solid);
  const stress::Drawer draw_filled = method.prepare(filled, filled_solid);
  for (const stress::Camera& camera : stress::default_cameras(filled, {320, 240})) {
    SCOPED_TRACE(camera.name);
    const Hits wall = draw_thin(camera.view), whole = draw_filled(camera.view);
    uint64_t hits = 0;
    for (size_t i = 0; i < whole.primitive.size(); ++i) {
      ASSERT_EQ(wall.primitive[i], whole.primitive[i]) << i;
      ASSERT_LE(glm::length(wall.position[i] - whole.position[i]), 1e-15) << i;
      hits += whole.primitive[i] != Hits::kMiss;
    }
    EXPECT_GT(hits, 2000u);
  }
}

class ThinWallTest : public testing::TestWithParam<const char*> {
 protected:
  void expect_whole(const Scene& thin, const Scene& filled) const {
    ::expect_whole(thin, filled, stress::cpu_method(GetParam()));
  }
};

TEST_P(ThinWallTest, InMemory) {
  expect_whole((ball(0.5) - ball(0.5 - kWall)).scene(), ball(0.5).scene());
  const Part cup = rod(0, 0.7, 0.35), inside = rod(kWall, 0.7 - kWall, 0.35 - kWall);
  expect_whole((cup - inside).scene(), cup.scene());
  const stress::Affine askew{stress::turned(20, 30, 40), {1, 2, 3}};
  expect_whole((cup - inside).under(askew).scene(), cup.under(askew).scene());
  // A plate is all wall: its whole disc is drawn.
  const Part plate = rod(0, kWall, 0.5), disc = rod(-0.1, kWall, 0.5);
  const stress::View above = stress::default_cameras(plate.scene(), {320, 240})[1].view;
  const auto hits = [&](const Part& part) {
    const Scene scene = part.scene();
    const Solid solid(csgcore::canonical_primitives(scene), scene.model);
    return stress::cpu_method(GetParam()).prepare(scene, solid)(above).primitive;
  };
  EXPECT_EQ(hits(plate), hits(disc));
}

TEST_P(ThinWallTest, InOneFrameOfAFile) {
  const std::string frame =
      "multmatrix([[0.813798, -0.44097, 0.378522, 1], [0.469846, 0.882564, 0.0180283, 2], "
      "[-0.34202, 0.163176, 0.925417, 3], [0, 0, 0, 1]]) ";
  const std::string filled = "cylinder($fn = 0, h = 0.7, r1 = 0.35, r2 = 0.35, center = false);";
  // 0.699998 and 0.349999 differ from 0.7 and 0.35 in any frame.
  const std::string inside =
      "multmatrix([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 1e-06], [0, 0, 0, 1]]) "
      "cylinder($fn = 0, h = 0.699998, r1 = 0.349999, r2 = 0.349999, center = false);";
  expect_whole(imported(frame + "{ difference() {" + filled + inside + "} }"),
               imported(frame + "{" + filled + "}"));
}

INSTANTIATE_TEST_SUITE_P(, ThinWallTest, testing::Values("tiles", "K=2", "K=8", "K=64"),
                         [](const auto& instance) {
                           std::string name = instance.param;
                           std::erase(name, '=');
                           return name;
                         });

}  // namespace
