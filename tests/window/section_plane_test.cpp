// Tests scenes that are cut open: what is left of them, and that the cut is exact.
#include "section_plane.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "csgcore/polyhedron.hpp"
#include "csgcore/solid.hpp"
#include "csgcore/tracer.hpp"
#include "frontend/render.hpp"
#include "support/models.hpp"

namespace window {
namespace {

using csgcore::Box;
using csgcore::CsgTree;
using csgcore::Scene;
using csgcore::Solid;
using csgcore::Vec3;

CsgTree tree_of(uint32_t index) {
  csgcore::CsgTreeBuilder builder;
  builder.primitive(index);
  return builder.finish();
}

/// A random solid, a `%` ball and a `#` ball.
Scene scene_with_all_parts(uint32_t seed) {
  Scene scene = test_support::random_tree(24, seed);
  const auto add = [&scene](double radius, const Vec3& at) {
    scene.primitives.push_back(csgcore::make_sphere(radius, {csgcore::Mat3(1.0), at}));
    return tree_of(static_cast<uint32_t>(scene.primitives.size() - 1));
  };
  scene.layers.push_back({csgcore::Layer::Kind::kBackground, true, add(6, {3, 1, -2})});
  scene.layers.push_back({csgcore::Layer::Kind::kHighlight, true, add(5, {-4, 2, 1})});
  return scene;
}

const Box kBounds{Vec3(-20), Vec3(20)};

bool is_kept(const SectionPlane& plane, const Vec3& point) {
  const double beyond = point[plane.axis] - plane.position;
  return plane.is_flipped ? beyond > 0 : beyond < 0;
}

TEST(SectionPlane, CutsOffWhatLiesOnOneSideOfAllParts) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> coordinate(-12, 12);
  const Scene scene = scene_with_all_parts(3);
  const auto all = csgcore::canonical_primitives(scene);
  std::size_t kept = 0, cut = 0;
  for (uint8_t axis = 0; axis < 3; ++axis) {
    for (const bool is_flipped : {false, true}) {
      const SectionPlane plane{true, axis, is_flipped, 1.5};
      const Scene opened = cut_open(scene, plane, kBounds);
      const auto primitives = csgcore::canonical_primitives(opened);
      std::vector<std::pair<CsgTree, CsgTree>> trees = {{scene.model, opened.model}};
      for (std::size_t i = 0; i < scene.layers.size(); ++i) {
        trees.emplace_back(scene.layers[i].solid, opened.layers.at(i).solid);
      }
      for (const auto& [tree, opened_tree] : trees) {
        const Solid whole(all, tree), half(primitives, opened_tree);
        for (int i = 0; i < 1000; ++i) {
          const Vec3 point{coordinate(random), coordinate(random), coordinate(random)};
          const bool was_in = whole.contains(point);
          EXPECT_EQ(half.contains(point), was_in && is_kept(plane, point));
          (is_kept(plane, point) ? kept : cut) += was_in;
        }
      }
    }
  }
  EXPECT_GT(kept, 100u);
  EXPECT_GT(cut, 100u);
}

/// The cut is exact up to the roundings of the ray.
TEST(SectionPlane, TheCutLiesInThePlane) {
  Scene scene = test_support::scene_of(csgcore::Op::kUnion, {csgcore::make_sphere(10)});
  for (const double position : {0.1, -7.3, 1.0 / 3, 9.99}) {
    const SectionPlane plane{true, 2, false, position};
    const Scene opened = cut_open(scene, plane, {Vec3(-10), Vec3(10)});
    const Solid solid(csgcore::canonical_primitives(opened), opened.model);
    csgcore::View view;
    view.projection = csgcore::Projection::kOrthographic;
    view.eye = {0, 0, 50};
    view.half_height = 1e-3;
    view.width_px = view.height_px = 3;
    csgcore::Hits hits;
    csgcore::TraceStats stats;
    csgcore::trace(solid, view, {}, hits, stats);
    for (std::size_t i = 0; i < 9; ++i) {
      ASSERT_EQ(hits.primitive[i], 1u);
      EXPECT_NEAR(hits.position[i].z, position, 1e-14);
      EXPECT_LE(glm::length(hits.normal[i] - Vec3(0, 0, 1)), 1e-15);
    }
  }
}

/// The picture equals that of a design with a block subtracted.
TEST(SectionPlane, ItsPictureIsThatOfADifference) {
  const Scene scene = test_support::cylinder_minus_spheres(100);
  csgcore::View view;
  view.eye = {0, -60, 20};
  view.forward = glm::normalize(Vec3(0, 60, -20));
  view.right = {1, 0, 0};
  view.up = glm::cross(view.right, view.forward);
  view.half_height = 0.3;
  view.width_px = 160;
  view.height_px = 120;
  for (const bool is_flipped : {false, true}) {
    const SectionPlane plane{true, 0, is_flipped, 2.5};
    Scene cut = scene;
    cut.primitives.push_back(csgcore::make_polyhedron(csgcore::Polyhedron::box(
        is_flipped ? Box{{-100, -90, -80}, {2.5, 70, 60}} : Box{{2.5, -90, -80}, {100, 70, 60}})));
    cut.model = csgcore::subtract(scene.model, static_cast<uint32_t>(scene.primitives.size()));
    frontend::RenderSettings settings;
    settings.renderer = frontend::RendererKind::kCpu;
    frontend::RenderStats stats;
    const auto picture = [&](const Scene& drawn) {
      return frontend::render(drawn, view, settings, stats).rgb;
    };
    const auto opened = picture(cut_open(scene, plane, {Vec3(-20), Vec3(20)}));
    EXPECT_EQ(opened, picture(cut));
    EXPECT_NE(opened, picture(scene));
  }
}

TEST(SectionPlane, HasAnIdOfItsOwn) {
  const Scene scene = scene_with_all_parts(3);
  const Scene opened = cut_open(scene, {true, 0, false, 0}, kBounds);
  ASSERT_EQ(opened.primitives.size(), scene.primitives.size() + 1);
  EXPECT_EQ(opened.primitives.back().id, kSectionId);
}

bool is_unchanged(const Scene& scene, const Scene& opened) {
  return opened.primitives.size() == scene.primitives.size() &&
         opened.model.tokens().size() == scene.model.tokens().size() &&
         std::equal(opened.layers.begin(), opened.layers.end(), scene.layers.begin(),
                    scene.layers.end(), [](const csgcore::Layer& a, const csgcore::Layer& b) {
                      return a.solid.tokens().size() == b.solid.tokens().size();
                    });
}

TEST(SectionPlane, WhereNothingIsItCutsNothing) {
  const Scene scene = scene_with_all_parts(3);
  EXPECT_TRUE(is_unchanged(scene, cut_open(scene, {true, 0, false, 0}, Box{})));
  EXPECT_FALSE(is_unchanged(scene, cut_open(scene, {true, 0, false, 0}, kBounds)));
}

TEST(SectionPlane, BesideTheSceneItCutsAllOrNothing) {
  const Scene scene = test_support::scene_of(csgcore::Op::kUnion, {csgcore::make_sphere(10)});
  for (const double position : {-1e6, 1e6}) {
    for (const bool is_flipped : {false, true}) {
      const SectionPlane plane{true, 1, is_flipped, position};
      const Scene opened = cut_open(scene, plane, {Vec3(-10), Vec3(10)});
      const Solid solid(csgcore::canonical_primitives(opened), opened.model);
      EXPECT_EQ(solid.contains(Vec3(1, 2, 3)), is_kept(plane, {1, 2, 3}));
    }
  }
}

}  // namespace
}  // namespace window
