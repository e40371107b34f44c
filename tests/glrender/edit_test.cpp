// Tests a renderer that follows edits: it draws the picture of one that was made anew, with few
// bytes uploaded.
#include <gtest/gtest.h>

#include <memory>
#include <utility>

#include "csgcore/polyhedron.hpp"
#include "fixture.hpp"
#include "support/models.hpp"
#include "support/test_meshes.hpp"

namespace {

using csgcore::Image;
using csgcore::Primitive;
using csgcore::Projection;
using csgcore::Scene;
using csgcore::SceneEdit;
using csgcore::Solid;
using csgcore::Subdivision;
using csgcore::Vec3;
using glrender::FrameStats;
using glrender::Renderer;
using glrender::Technique;

struct Made {
  explicit Made(const Scene& anew)
      : scene(anew),
        primitives(csgcore::canonical_primitives(scene)),
        solid(primitives, scene.model) {}
  Made(const Scene& later, const Made& earlier, const SceneEdit& edit)
      : scene(later),
        primitives(csgcore::canonical_primitives(scene, *earlier.primitives, edit)),
        solid(primitives, scene.model, earlier.solid, edit, edit.model) {}
  Scene scene;
  std::shared_ptr<const csgcore::CanonicalPrimitives> primitives;
  Solid solid;
};

/// Plays the window, whose renderer follows the scene.
class Followed {
 public:
  Followed(const Scene& scene, Technique technique)
      : made_(std::make_unique<Made>(scene)),
        subdivision_(made_->solid, {}),
        renderer_(gl_test::context(), made_->solid) {
    settings_.technique = technique;
    if (technique == Technique::kCells) renderer_.load(subdivision_);
    settings_.measured_channels = true;
    view_ = gl_test::view_from(scene, Projection::kPerspective, 25, 35);
  }

  Image draw() { return renderer_.draw(view_, settings_, stats_); }

  /// Returns the bytes that are uploaded, without those of cells. Fails unless the picture equals
  /// that of a renderer made anew.
  uint64_t follow(const Scene& scene) {
    uint64_t before = renderer_.uploaded_bytes();
    const SceneEdit edit = csgcore::compare(made_->scene, scene);
    auto later = std::make_unique<Made>(scene, *made_, edit);
    renderer_.update(later->solid, edit);
    if (settings_.technique == Technique::kCells) {
      subdivision_ = Subdivision(later->solid, {});
      const uint64_t updated = renderer_.uploaded_bytes();
      renderer_.load(subdivision_);
      before += renderer_.uploaded_bytes() - updated;
    }
    made_ = std::move(later);
    const Image image = draw();
    Renderer anew(gl_test::context(), made_->solid);
    if (settings_.technique == Technique::kCells) anew.load(subdivision_);
    const Image expected = anew.draw(view_, settings_, stats_);
    whole_bytes_ = anew.uploaded_bytes();
    EXPECT_TRUE(image.rgb == expected.rgb);
    EXPECT_TRUE(image.id == expected.id);
    EXPECT_TRUE(image.z == expected.z);
    EXPECT_TRUE(image.normal == expected.normal);
    return renderer_.uploaded_bytes() - before;
  }

  uint64_t whole_bytes() const { return whole_bytes_; }

 private:
  std::unique_ptr<Made> made_;
  Subdivision subdivision_;
  Renderer renderer_;
  glrender::FrameSettings settings_;
  csgcore::View view_;
  FrameStats stats_;
  uint64_t whole_bytes_ = 0;
};

class GlEdit : public testing::TestWithParam<Technique> {};

INSTANTIATE_TEST_SUITE_P(, GlEdit, testing::Values(Technique::kCells, Technique::kTiles),
                         [](const auto& instance) {
                           return instance.param == Technique::kCells ? "Cells" : "Tiles";
                         });

TEST_P(GlEdit, MovedPrimitivesAreUploadedAlone) {
  Scene scene = test_support::cylinder_minus_spheres(500);
  Followed followed(scene, GetParam());
  const Image before = followed.draw();
  uint64_t bytes = 0, whole_bytes = 0;
  for (uint32_t save = 0; save < 10; ++save) {
    scene.primitives[1 + 37 * save % 500].local_to_world.translation += Vec3(0.3, -0.2, 0.4);
    bytes += followed.follow(scene);
    whole_bytes += followed.whole_bytes();
  }
  EXPECT_GT(bytes, 0u);
  EXPECT_LT(bytes, whole_bytes / 20) << whole_bytes;
  EXPECT_FALSE(before.id == followed.draw().id);
}

TEST_P(GlEdit, ColorsAreUploadedAlone) {
  Scene scene = test_support::cylinder_minus_spheres(500);
  Followed followed(scene, GetParam());
  const Image before = followed.draw();
  scene.primitives[0].color = csgcore::Color{1, 0, 0, 1};
  EXPECT_EQ(followed.follow(scene), 16u);
  EXPECT_FALSE(before.rgb == followed.draw().rgb);
  EXPECT_EQ(followed.follow(scene), 0u);
}

TEST_P(GlEdit, PrimitivesBecomePolyhedraAndBack) {
  Scene scene = test_support::cylinder_minus_spheres(300);
  Followed followed(scene, GetParam());
  followed.draw();
  for (int save = 0; save < 4; ++save) {
    const Primitive was = scene.primitives[5 + save % 3];
    Primitive& primitive = scene.primitives[5 + save % 3];
    primitive = csgcore::make_polyhedron(csgcore::Polyhedron::box({Vec3(-1.0 - save), Vec3(1.0)}),
                                         was.local_to_world);
    primitive.id = was.id;
    primitive.color = csgcore::Color{0, 0.2f * static_cast<float>(save), 1, 1};
    const uint64_t bytes = followed.follow(scene);
    EXPECT_LT(bytes, followed.whole_bytes() / 2);
  }
  scene.primitives[5] = csgcore::make_sphere(1, scene.primitives[5].local_to_world);
  scene.primitives[5].id = 5;
  followed.follow(scene);
}

TEST_P(GlEdit, PrimitivesBecomeMeshesAndBack) {
  Scene scene = test_support::cylinder_minus_spheres(300);
  Followed followed(scene, GetParam());
  followed.draw();
  const auto replace = [&](uint32_t index, Primitive primitive) {
    primitive.id = index;
    scene.primitives[index] = std::move(primitive);
    return followed.follow(scene);
  };
  const csgcore::Affine place = scene.primitives[5].local_to_world;
  const auto torus = test_support::torus_parts(2, 1, 32, 16).mesh();
  const uint64_t triangles_bytes = torus->triangles().size() * 3 * 16;
  EXPECT_GT(replace(5, csgcore::make_mesh(torus, place)), triangles_bytes);
  // Neither a mesh that has moved nor another primitive with it is uploaded again.
  csgcore::Affine moved = place;
  moved.translation.z += 0.5;
  EXPECT_LT(replace(5, csgcore::make_mesh(torus, moved)), triangles_bytes);
  const auto equal = test_support::torus_parts(2, 1, 32, 16).mesh();
  EXPECT_LT(replace(9, csgcore::make_mesh(equal, scene.primitives[9].local_to_world)),
            triangles_bytes);
  // Another mesh is added to those that are there.
  const auto prism = test_support::l_prism_parts(2, 1, 1).mesh();
  EXPECT_LT(replace(7, csgcore::make_mesh(prism, place)), triangles_bytes);
  replace(5, csgcore::make_sphere(1, place));
  replace(9, csgcore::make_sphere(1, scene.primitives[9].local_to_world));
  replace(7, csgcore::make_sphere(1, scene.primitives[7].local_to_world));
}

TEST_P(GlEdit, InsertedAndRemovedPrimitivesAreDrawn) {
  Scene scene = test_support::cylinder_minus_spheres(100);
  Followed followed(scene, GetParam());
  followed.draw();
  const auto number = [&] {
    csgcore::CsgTreeBuilder builder;
    builder.open(csgcore::Op::kDifference);
    for (uint32_t i = 0; i < scene.primitives.size(); ++i) {
      scene.primitives[i].id = i;
      builder.primitive(i);
    }
    builder.close();
    scene.model = builder.finish();
  };
  Primitive hole = scene.primitives[40];
  hole.local_to_world.translation.z += 1;
  scene.primitives.insert(scene.primitives.begin() + 20, hole);
  number();
  followed.follow(scene);
  scene.primitives.erase(scene.primitives.begin() + 60);
  number();
  followed.follow(scene);
}

}  // namespace
