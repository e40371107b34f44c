// Tests every kind of primitive by OpenGL against the CPU tracer: alone, cut by its own kind, and
// beside it.
#include <gtest/gtest.h>

#include <random>
#include <string>

#include "agreement.hpp"
#include "support/kinds/test_kind.hpp"
#include "support/models.hpp"

namespace {

using csgcore::Op;
using csgcore::Primitive;
using csgcore::Projection;
using csgcore::Scene;
using csgcore::View;
using gl_test::LoadedScene;
using test_support::Variant;

/// Faces whose normals are closer count as one; no variant has such faces.
constexpr gl_test::EdgeLimits kEdges{.face_distance = 0.05};
/// A sheared mesh is as far off as GL's own tolerance: its faces are anywhere in its unit ball,
/// where float has no more digits.
constexpr gl_test::EdgeLimits kMeshEdges{.face_distance = 0.05, .surface_error = 0x1p-21};

class KindsTest : public testing::TestWithParam<std::tuple<Variant, gl_test::Way>> {
 protected:
  Primitive make(std::mt19937& random) const {
    test_support::Sizes sizes(random, {.low = 0.5, .high = 2, .most_fragments = 12});
    Primitive primitive = std::get<Variant>(GetParam()).make(sizes);
    primitive.local_to_world = test_support::random_affine(random);
    primitive.local_to_world.translation *= 0.15;  // so that they overlap
    return primitive;
  }
};

INSTANTIATE_TEST_SUITE_P(
    , KindsTest,
    testing::Combine(testing::ValuesIn(test_support::all_variants()),
                     testing::Values(gl_test::Way(gl_test::leaves_of(8)), gl_test::by_tiles())),
    [](const auto& instance) {
      const bool tiles = std::get<1>(instance.param).technique == glrender::Technique::kTiles;
      return std::get<0>(instance.param).name + std::string(tiles ? "Tiles" : "Cells");
    });

TEST_P(KindsTest, AreDrawnAsByTheCpu) {
  std::mt19937 random(1);
  const Primitive body = make(random), other = make(random);
  for (const Scene& scene : {test_support::scene_of(Op::kUnion, {body}),
                             test_support::scene_of(Op::kDifference, {body, other}),
                             test_support::scene_of(Op::kUnion, {body, other})}) {
    for (const Projection projection : {Projection::kPerspective, Projection::kOrthographic}) {
      LoadedScene loaded(scene, std::get<1>(GetParam()));
      const View view = gl_test::view_from(scene, projection, 25, 35);
      const csgcore::Image gl = loaded.draw(view), cpu = gl_test::draw_by_cpu(loaded, view);
      const double size = csgcore::reference_box(scene).diagonal();
      const bool is_mesh = body.shape() == csgcore::Shape::kMesh;
      gl_test::expect_agreement(gl, cpu, view, size, is_mesh ? kMeshEdges : kEdges,
                                std::get<Variant>(GetParam()).name);
    }
  }
}

}  // namespace
