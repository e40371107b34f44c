// Tests scenes that are cut open: what is left of them, and that the cut is exact.
#include "section_plane.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <random>
#include <vector>

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
  const double beyond = glm::dot(point, plane.normal) - plane.position;
  return plane.is_flipped ? beyond > 0 : beyond < 0;
}

const Vec3 kNormals[] = {{1, 0, 0},
                         {0, 1, 0},
                         {0, 0, -1},
                         glm::normalize(Vec3(1, -2, 0.5)),
                         glm::normalize(Vec3(0, 1, 1))};

TEST(SectionPlane, CutsOffWhatLiesOnOneSideOfAllParts) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> coordinate(-12, 12);
  const Scene scene = scene_with_all_parts(3);
  const auto all = csgcore::canonical_primitives(scene);
  std::size_t kept = 0, cut = 0;
  for (const Vec3& normal : kNormals) {
    for (const bool is_flipped : {false, true}) {
      const SectionPlane plane{true, normal, is_flipped, 1.5};
      const Scene opened = cut_open(scene, plane, kBounds).scene;
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
    const SectionPlane plane{true, {0, 0, 1}, false, position};
    const Scene opened = cut_open(scene, plane, {Vec3(-10), Vec3(10)}).scene;
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

/// Returns a picture of the cut from the side that is cut off, with its measured channels.
csgcore::Image picture_of(const Scene& scene, const SectionPlane& plane) {
  csgcore::View view;
  view.projection = csgcore::Projection::kOrthographic;
  view.forward = -plane.cut_off();
  const csgcore::Mat3 frame = frame_with(view.forward);
  view.right = frame[0];
  view.up = -frame[1];
  view.eye = -100.0 * view.forward;
  view.half_height = 12;
  view.width_px = view.height_px = 120;
  frontend::RenderSettings settings;
  settings.renderer = frontend::RendererKind::kCpu;
  settings.measured_channels = true;
  frontend::RenderStats stats;
  return frontend::render(scene, view, settings, stats);
}

/// The picture equals that of a design with a block subtracted, but for the colour of the cut.
TEST(SectionPlane, ItsPictureIsThatOfADifference) {
  const Scene scene = test_support::cylinder_minus_spheres(100);
  for (const bool is_flipped : {false, true}) {
    const SectionPlane plane{true, {1, 0, 0}, is_flipped, 2.5};
    Scene cut = scene;
    cut.primitives.push_back(csgcore::make_polyhedron(csgcore::Polyhedron::box(
        is_flipped ? Box{{-100, -90, -80}, {2.5, 70, 60}} : Box{{2.5, -90, -80}, {100, 70, 60}})));
    cut.primitives.back().id = kFirstSectionFace;
    cut.model = csgcore::subtract(scene.model, static_cast<uint32_t>(scene.primitives.size()));
    const csgcore::Image opened = picture_of(cut_open(scene, plane, kBounds).scene, plane);
    const csgcore::Image wanted = picture_of(cut, plane);
    EXPECT_EQ(opened.z, wanted.z);
    size_t faces = 0;
    for (size_t i = 0; i < opened.rgb.size(); ++i) {
      EXPECT_EQ(is_section_face(opened.id[i]), is_section_face(wanted.id[i]));
      if (is_section_face(opened.id[i])) {
        ++faces;
      } else {
        EXPECT_EQ(opened.rgb[i], wanted.rgb[i]);
      }
    }
    EXPECT_GT(faces, 1000u);
    EXPECT_NE(opened.z, picture_of(scene, plane).z);
  }
}

/// Each face belongs to the part, and has the colour, of the primitive that the plane cuts there.
TEST(SectionPlane, FacesAreThoseOfTheirParts) {
  constexpr uint32_t kParts = 5;
  size_t faces = 0, seen = 0, undecided = 0;
  for (uint32_t seed = 0; seed < 20; ++seed) {
    Scene scene = test_support::random_tree(24, seed);
    std::vector<uint32_t> parts;
    std::mt19937 random(seed);
    for (uint32_t i = 0; i < scene.primitives.size(); ++i) {
      scene.primitives[i].id = i;
      parts.push_back(random() % kParts);
      if (random() % 3 > 0) {
        scene.primitives[i].color =
            csgcore::Color{0.25f * static_cast<float>(random() % 4), 0, 0, 1};
      }
    }
    const auto all = csgcore::canonical_primitives(scene);
    const SectionPlane plane{true, kNormals[seed % 5], seed % 2 == 0, 0.7};
    const CutScene cut = cut_open(scene, plane, kBounds, parts);
    faces += cut.parts.size();
    const csgcore::Image image = picture_of(cut.scene, plane);
    for (size_t i = 0; i < image.rgb.size(); ++i) {
      if (!is_section_face(image.id[i])) continue;
      const Vec3 point = Vec3(image.position[i]) - 1e-4 * plane.cut_off();
      const auto around = primitive_around(scene.model, [&](uint32_t primitive) {
        return csgcore::contains((*all)[primitive], point);
      });
      const uint32_t face = image.id[i] - kFirstSectionFace;
      if (!around) {
        ++undecided;  // a wall that is thinner than the step
        continue;
      }
      ++seen;
      EXPECT_EQ(cut.parts.at(face), parts[*around]) << "seed " << seed << ", pixel " << i;
      EXPECT_EQ(cut.scene.primitives[scene.primitives.size() + face].color,
                scene.primitives[*around].color);
    }
  }
  EXPECT_GT(faces, 60u);
  EXPECT_GT(seen, 10000u);
  EXPECT_LT(undecided, seen / 1000);
}

TEST(SectionPlane, AFaceHasThePartsColorAndNotThatOfACut) {
  const SectionPlane plane{true, {0, 0, 1}, false, 0};
  const Scene scene = test_support::scene_of(csgcore::Op::kUnion, {csgcore::make_sphere(10)});
  const csgcore::Image image = picture_of(cut_open(scene, plane, kBounds).scene, plane);
  const size_t middle = image.rgb.size() / 2 + 60;
  ASSERT_TRUE(is_section_face(image.id[middle]));
  EXPECT_GT(image.rgb[middle][0], 150)
      << "the scheme's front colour is a yellow, the other a green";
}

/// Parts that are whole, or gone, and parts that look the same in a row need no face of their own.
TEST(SectionPlane, HasNoMoreFacesThanAreNeeded) {
  const auto ball = [](double x, uint32_t id) {
    csgcore::Primitive sphere = csgcore::make_sphere(1, {csgcore::Mat3(1.0), Vec3(x, 0, 0)});
    sphere.id = id;
    return sphere;
  };
  const Scene scene = test_support::scene_of(csgcore::Op::kUnion,
                                             {ball(-5, 0), ball(0, 1), ball(0.5, 2), ball(5, 3)});
  const auto faces = [&](const SectionPlane& plane, std::vector<uint32_t> parts) {
    return cut_open(scene, plane, kBounds, parts).parts;
  };
  const SectionPlane across{true, {1, 0, 0}, false, 0}, along{true, {0, 1, 0}, false, 0};
  using Parts = std::vector<uint32_t>;
  EXPECT_EQ(faces(across, {0, 1, 1, 2}), Parts({1}));
  EXPECT_EQ(faces(across, {0, 1, 2, 3}), Parts({1, 2}));
  EXPECT_EQ(faces(along, {0, 1, 1, 2}), Parts({0, 1, 2}));
  EXPECT_EQ(faces(along, {}), Parts({0}));
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
  EXPECT_TRUE(is_unchanged(scene, cut_open(scene, {true, {1, 0, 0}, false, 0}, Box{}).scene));
  EXPECT_FALSE(is_unchanged(scene, cut_open(scene, {true, {1, 0, 0}, false, 0}, kBounds).scene));
}

TEST(SectionPlane, BesideTheSceneItCutsAllOrNothing) {
  const Scene scene = test_support::scene_of(csgcore::Op::kUnion, {csgcore::make_sphere(10)});
  for (const double position : {-1e6, 1e6}) {
    for (const bool is_flipped : {false, true}) {
      const SectionPlane plane{true, {0, 1, 0}, is_flipped, position};
      const Scene opened = cut_open(scene, plane, {Vec3(-10), Vec3(10)}).scene;
      const Solid solid(csgcore::canonical_primitives(opened), opened.model);
      EXPECT_EQ(solid.contains(Vec3(1, 2, 3)), is_kept(plane, {1, 2, 3}));
    }
  }
}

}  // namespace
}  // namespace window
