// Tests OpenSCAD's own meshes against the Nef oracle's solids of the same trees.
#include <gtest/gtest.h>

#include <cmath>

#include "full_run.hpp"
#include "nef_scenes.hpp"
#include "openscad_mesh.hpp"

namespace oracle {
namespace {

/// The error of OpenSCAD's vertices: it snaps them to a grid of 2⁻²⁰, and writes six digits of
/// coordinates below 10.
constexpr double kVertexError = 0x1p-20 + 5e-6;

TEST(NefSolid, HasOpenSCADsVolume) {
  if (!test_support::openscad_installed()) GTEST_SKIP() << "openscad is not installed";
  const uint32_t trees = test_support::full_run() ? 200 : 12;
  int solids = 0;
  for (uint32_t seed = 1; seed <= trees; ++seed) {
    const RandomScene random = random_scene(1 + seed % 5, seed);
    const double expected = volume_of(test_support::openscad_mesh(random.scad));
    const auto solid = build(random.scene);
    EXPECT_NEAR(solid->volume().get_d(), expected, kVertexError * solid->area()) << random.scad;
    solids += expected > 0;
  }
  EXPECT_GT(solids, trees / 2);
}

}  // namespace
}  // namespace oracle
