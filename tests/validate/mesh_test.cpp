// Tests `scadray validate` on designs with triangle meshes.
#include <gtest/gtest.h>

#include "support/test_meshes.hpp"
#include "validation.hpp"

namespace validation {
namespace {

using csgcore::Op;
using csgcore::Scene;
using csgcore::Vec3;
using test_support::MeshParts;

/// A mesh less a sphere, united with a brick that is flush with it.
Scene design_of(const MeshParts& mesh) {
  Scene scene;
  scene.primitives = {csgcore::make_mesh(mesh.mesh()),
                      csgcore::make_sphere(1.5, {csgcore::Mat3(1.0), Vec3(3, 3, 3)}),
                      csgcore::make_mesh(test_support::box_parts({0, 0, -1}, {4, 4, 0}).mesh())};
  for (uint32_t i = 0; i < scene.primitives.size(); ++i) scene.primitives[i].id = i;
  csgcore::CsgTreeBuilder builder;
  builder.open(Op::kUnion);
  builder.open(Op::kDifference);
  builder.primitive(0);
  builder.primitive(1);
  builder.close();
  builder.primitive(2);
  builder.close();
  scene.model = builder.finish();
  return scene;
}

Result validated(const Scene& scene, const std::string& planted_error = {}) {
  Settings settings;
  settings.points = 500;
  settings.rays = 500;
  settings.views = 1;
  settings.renderer = frontend::RendererKind::kCpu;
  settings.planted_error = planted_error;
  return validate(scene, settings, [](const std::string&, double) {});
}

void expect_agreement(const Result& result, bool by_cgal) {
  EXPECT_EQ(result.cgal_s > 0, by_cgal);
  for (const CheckResult& check : result.checks) {
    EXPECT_EQ(check.disagreed, 0u) << check.group << ", " << check.name << ": "
                                   << check.disagreements.front();
    EXPECT_GT(check.compared, 0u);
  }
  EXPECT_GT(result.checks.size(), by_cgal ? 5u : 1u);
}

TEST(ValidateMeshes, AgreesWithCgal) {
  MeshParts parts = test_support::l_prism_parts(4, 2, 4);
  expect_agreement(validated(design_of(parts)), true);
  parts = test_support::box_parts(Vec3(0), Vec3(4));
  parts.add(test_support::box_parts(Vec3(1), Vec3(2, 2, 3)).inside_out());
  expect_agreement(validated(design_of(parts)), true);
}

TEST(ValidateMeshes, AnOpenMeshIsComparedWithExactRaysAlone) {
  MeshParts parts = test_support::box_parts(Vec3(0), Vec3(4));
  parts.triangles.erase(parts.triangles.begin() + 2);
  const Result result = validated(design_of(parts));
  expect_agreement(result, false);
  ASSERT_EQ(result.notes.size(), 1u);
  EXPECT_EQ(result.notes[0],
            "CGAL failed (a mesh is not closed): compared with rays in exact arithmetic only");
}

TEST(ValidateMeshes, FindsAPlantedError) {
  const Scene scene = design_of(test_support::l_prism_parts(4, 2, 4));
  EXPECT_FALSE(validated(scene, "move:0:1e-5").agrees());
  EXPECT_FALSE(validated(scene, "flip:2").agrees());
}

}  // namespace
}  // namespace validation
