#include "cut_mesh.hpp"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "oracle/nef_solid.hpp"

namespace measure {
namespace {

using csgcore::Affine;
using csgcore::Op;
using csgcore::Scene;
using csgcore::Vec3;

constexpr int kFragments = 12;

Affine at(const Vec3& place) {
  Affine map;
  map.translation = place;
  return map;
}

/// A cylinder minus balls that overlap each other, its wall and a cap, and minus one inside all
/// others.
Scene cut_cylinder(Op op = Op::kDifference) {
  Scene scene;
  scene.primitives = {csgcore::make_frustum(-2, 2, 1.5, 1.5),
                      csgcore::make_sphere(0.7, at({1.51, 0.02, 0.03})),
                      csgcore::make_sphere(0.6, at({1.23, 0.54, 0.32})),
                      csgcore::make_sphere(0.8, at({0.31, -0.23, 2.07})),
                      csgcore::make_sphere(0.2, at({1.41, 0.12, 0.05})),
                      csgcore::make_frustum(-1, 1, 0.2, 0.4, at({-0.6, 0.7, 1.83}))};
  csgcore::CsgTreeBuilder builder;
  builder.open(op);
  for (uint32_t i = 0; i < scene.primitives.size(); ++i) builder.primitive(i);
  builder.close();
  scene.model = builder.finish();
  return scene;
}

TEST(CutMesh, EnclosesTheSolid) {
  const Scene scene = cut_cylinder();
  const oracle::NefBuild exact = oracle::NefSolid::build(scene, kFragments);
  ASSERT_EQ(exact.status, oracle::NefStatus::kBuilt) << exact.reason;
  double volume = 0, area = 0;
  Vec3 balance(0.0);
  for (const CutTriangle& triangle : cut_mesh(scene, kFragments)) {
    const auto& [a, b, c] = triangle.corners;
    const Vec3 across = glm::cross(b - a, c - a);
    volume += glm::dot(a, across) / 6;
    area += glm::length(across) / 2;
    balance += across;
    EXPECT_NE(triangle.primitive, 4u) << "it lies within another that is cut away";
  }
  EXPECT_NEAR(volume, exact.solid->volume().get_d(), 1e-9);
  EXPECT_NEAR(area, exact.solid->area(), 1e-9);
  EXPECT_LT(glm::length(balance), 1e-9);  // closed
}

TEST(CutMesh, RefusesWhatItCannotCut) {
  EXPECT_THROW(cut_mesh(cut_cylinder(Op::kUnion), kFragments), std::invalid_argument);
}

}  // namespace
}  // namespace measure
