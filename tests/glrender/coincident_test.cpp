// Tests that faces of several primitives are drawn without speckle at any angle: a whole family of
// designs, leaf sizes and views, against the brute-force oracle.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <numbers>

#include "coincident_scenes.hpp"
#include "fixture.hpp"
#include "support/full_run.hpp"

namespace {

using csgcore::Affine;
using csgcore::Mat3;
using csgcore::Projection;
using csgcore::Vec3;
using csgcore::View;
using gl_test::NamedScene;
using gl_test::Speckle;

/// The radius of a sphere around every scene of the family, about its frame's origin.
constexpr double kReach = 12;

/// A view, in the scene's frame, of the plane z = face_z from an angle above it. At a flat angle it
/// is zoomed, so that the face fills the picture.
struct FaceView {
  double above_deg;
  bool zoomed;
};

View view_of(const NamedScene& scene, const Affine& frame, Projection projection,
             const FaceView& from) {
  const double above = from.above_deg * std::numbers::pi / 180;
  const double around = 33 * std::numbers::pi / 180;
  const Vec3 towards_eye{std::cos(above) * std::cos(around), std::cos(above) * std::sin(around),
                         std::sin(above)};
  const double distance = 3 * kReach;
  const double half_height = 0.6 * kReach * (from.zoomed ? std::abs(std::sin(above)) : 1);
  View view;
  view.projection = projection;
  view.forward = frame.linear * -towards_eye;
  view.right = frame.linear * Vec3{-std::sin(around), std::cos(around), 0};
  view.up = glm::cross(view.right, view.forward);
  view.eye = frame.point(Vec3{0, 0, scene.face_z} + distance * towards_eye);
  view.half_height = projection == Projection::kPerspective ? half_height / distance : half_height;
  view.width_px = 160;
  view.height_px = 120;
  return view;
}

/// A turn and a shift as in a file: none of its numbers is exact.
Affine turned() {
  const double tilt = 0.3, turn = 1.7;
  const Mat3 tilted{Vec3{1, 0, 0}, Vec3{0, std::cos(tilt), std::sin(tilt)},
                    Vec3{0, -std::sin(tilt), std::cos(tilt)}};
  const Mat3 turned{Vec3{std::cos(turn), std::sin(turn), 0},
                    Vec3{-std::sin(turn), std::cos(turn), 0}, Vec3{0, 0, 1}};
  return {turned * tilted, {3.1, -2.7, 11.3}};
}

std::vector<FaceView> face_views() {
  std::vector<FaceView> views{{35, false}, {1, true}, {0.1, true}};
  if (test_support::full_run()) {
    views.insert(views.end(), {{90, false}, {-30, false}, {1, false}, {0.1, false}, {0.02, true}});
  }
  return views;
}

Speckle speckle_of(const NamedScene& scene, const Affine& frame, Projection projection) {
  Speckle sum;
  for (const FaceView& from : face_views()) {
    const View view = view_of(scene, frame, projection, from);
    const csgcore::Image oracle = csgcore::reference_render(scene.scene, view);
    for (const uint32_t leaf_primitives : {2u, 8u, 32u}) {
      sum += gl_test::speckle(gl_test::draw(scene.scene, view, gl_test::leaves_of(leaf_primitives)),
                              oracle);
    }
    sum += gl_test::speckle(gl_test::draw(scene.scene, view, gl_test::by_tiles()), oracle);
  }
  return sum;
}

void print(const char* name, const Speckle& speckle) {
  std::printf("%-20s %9llu hits, %5llu wrong, of which %llu speckle\n", name,
              static_cast<unsigned long long>(speckle.hits),
              static_cast<unsigned long long>(speckle.wrong),
              static_cast<unsigned long long>(speckle.speckle));
}

TEST(CoincidentFacesTest, LeaveNoSpeckle) {
  const bool full = test_support::full_run();
  std::printf("%s\n", full ? "every view" : "a sample (SCADRAY_TEST_FULL=1 takes every view)");
  Speckle family;
  const std::vector<NamedScene> upright = gl_test::coincident_scenes({});
  const std::vector<NamedScene> tilted = gl_test::coincident_scenes(turned());
  for (size_t i = 0; i < upright.size(); ++i) {
    Speckle scene;
    if (full || i % 2 == 0) scene += speckle_of(upright[i], {}, Projection::kPerspective);
    if (full || i % 2 == 1) scene += speckle_of(tilted[i], turned(), Projection::kOrthographic);
    if (full) {
      scene += speckle_of(upright[i], {}, Projection::kOrthographic);
      scene += speckle_of(tilted[i], turned(), Projection::kPerspective);
    }
    print(upright[i].name.c_str(), scene);
    EXPECT_LE(scene.speckle * 10000, scene.hits) << upright[i].name;
    family += scene;
  }
  print("all", family);
  EXPECT_GT(family.hits, 500'000u);
  // These are edges within a float's rounding of a pixel's ray.
  EXPECT_LE(family.wrong * 1000, family.hits);
}

}  // namespace
