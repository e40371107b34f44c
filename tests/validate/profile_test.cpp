// Tests `scadray validate` on designs with extruded and revolved profiles.
#include "csgcore/profile.hpp"

#include <gtest/gtest.h>

#include <memory>

#include "validation.hpp"

namespace validation {
namespace {

using csgcore::Op;
using csgcore::ProfileEdge;
using csgcore::Scene;
using csgcore::Vec2;

/// An L, whose inner corner is an arc.
std::shared_ptr<const csgcore::Profile> l_profile() {
  ProfileEdge arc;
  arc.kind = ProfileEdge::Kind::kArc;
  arc.end = {2, 2};
  arc.control = {3, 2};
  arc.is_counterclockwise = false;
  const csgcore::ProfileLoop loop = {
      {.end = Vec2(1, 0)}, {.end = Vec2(5, 0)}, {.end = Vec2(5, 1)}, {.end = Vec2(3, 1)}, arc,
      {.end = Vec2(2, 4)}, {.end = Vec2(1, 4)}};
  return std::make_shared<csgcore::Profile>(std::vector<csgcore::ProfileLoop>{loop},
                                            csgcore::FillRule::kEvenOdd);
}

/// The figure revolved, less the figure extruded, which has faces in common with it.
Scene design() {
  Scene scene;
  scene.primitives = {csgcore::make_revolution(l_profile()),
                      csgcore::make_extrusion(l_profile(), 0, 1, 1, 0.5)};
  for (uint32_t i = 0; i < scene.primitives.size(); ++i) scene.primitives[i].id = i;
  csgcore::CsgTreeBuilder builder;
  builder.open(Op::kDifference);
  builder.primitive(0);
  builder.primitive(1);
  builder.close();
  scene.model = builder.finish();
  return scene;
}

Result validated(const std::string& planted_error = {}) {
  Settings settings;
  settings.points = 500;
  settings.rays = 500;
  settings.views = 1;
  settings.renderer = frontend::RendererKind::kCpu;
  settings.planted_error = planted_error;
  return validate(design(), settings, [](const std::string&, double) {});
}

TEST(ValidateProfiles, AgreesWithExactRays) {
  const Result result = validated();
  EXPECT_EQ(result.cgal_s, 0);
  ASSERT_GT(result.checks.size(), 1u);
  for (const CheckResult& check : result.checks) {
    EXPECT_EQ(check.disagreed, 0u)
        << check.group << ", " << check.name << ": " << check.disagreements.front();
    EXPECT_GT(check.agreed, 0u);
  }
}

TEST(ValidateProfiles, FindsAPlantedError) {
  EXPECT_FALSE(validated("move:1:1e-5").agrees());
  EXPECT_FALSE(validated("flip:1").agrees());
}

}  // namespace
}  // namespace validation
