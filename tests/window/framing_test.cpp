// Tests the camera that shows all of something: nothing of it is outside of the part, and it fills
// the part.
#include "framing.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <random>
#include <vector>

#include "frontend/importer.hpp"
#include "frontend/parser.hpp"
#include "panels/layout.hpp"
#include "projection.hpp"

namespace window {
namespace {

using csgcore::Box;
using csgcore::Mat3;
using csgcore::Projection;
using csgcore::Vec3;

constexpr Size kSize{640, 480};
constexpr double kAspect = 640.0 / 480;
constexpr Projection kProjections[] = {Projection::kPerspective, Projection::kOrthographic};

/// A camera whose numbers are different on all axes.
Navigation tilted(Projection projection) {
  return {frontend::Camera{{1, -2, 3}, {40, 10, 70}, 90}, projection};
}

/// The rectangle that points take, in shares of the picture.
struct Taken {
  double left = 1e9, right = -1e9, top = 1e9, bottom = -1e9;
};
Taken taken_by(const std::vector<Vec3>& points, const Navigation& navigation) {
  Taken taken;
  for (const Vec3& point : points) {
    const auto place = project(navigation.view(kSize), point);
    if (!place) return {-1e9, 1e9, -1e9, 1e9};
    taken.left = std::min(taken.left, place->x_px / kSize.width_px);
    taken.right = std::max(taken.right, place->x_px / kSize.width_px);
    taken.top = std::min(taken.top, place->y_px / kSize.height_px);
    taken.bottom = std::max(taken.bottom, place->y_px / kSize.height_px);
  }
  return taken;
}

TEST(Framing, FillsThePartOfThePicture) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> share(0, 1), place(-50, 50);
  for (int i = 0; i < 200; ++i) {
    const Projection projection = kProjections[i % 2];
    const Vec3 far(place(random), place(random), place(random)), size(1, 10 * share(random), 30);
    std::vector<Vec3> points;
    for (int k = 0; k < 20; ++k) {
      points.push_back(100.0 * far + Vec3(place(random), place(random), place(random)) * size);
    }
    const double left = 0.4 * share(random), top = 0.4 * share(random);
    const PicturePart part{left, top, left + 0.6 * share(random) + 0.01, top + 0.5, kAspect};
    const auto box = [&](const Mat3& to_frame) {
      Box result;
      for (const Vec3& point : points) result.merge(to_frame * point);
      return result;
    };
    const Navigation found = framed(tilted(projection), box(Mat3(1.0)), box, part);
    EXPECT_EQ(found.camera().rotation_deg, tilted(projection).camera().rotation_deg);
    const Taken taken = taken_by(points, found);
    constexpr double kRounding = 1e-9;
    const double room[] = {taken.left - part.left, part.right - taken.right, taken.top - part.top,
                           part.bottom - taken.bottom};
    for (const double side : room) EXPECT_GE(side, -kRounding);
    // It touches two sides that are opposite to each other, and has the same room at the others:
    // the same in the space, which in perspective is not quite the same in the picture.
    EXPECT_LE(std::min(std::max(room[0], room[1]), std::max(room[2], room[3])), kRounding);
    EXPECT_NEAR(room[0], room[1], projection == Projection::kPerspective ? 0.2 : kRounding);
    EXPECT_NEAR(room[2], room[3], projection == Projection::kPerspective ? 0.2 : kRounding);
  }
}

TEST(Framing, ShowsNothingOfNothing) {
  for (const Projection projection : kProjections) {
    const auto nothing = [](const Mat3&) { return Box(); };
    EXPECT_EQ(framed(tilted(projection), {}, nothing, {}), tilted(projection));
  }
}

csgcore::Scene scene_of(const std::string& text) {
  return frontend::import_design(frontend::parse(text, "")).scene;
}

void expect_box(const Box& box, const Vec3& min, const Vec3& max, double error = 1e-9) {
  EXPECT_LE(glm::length(box.min - min), error) << box.min.x << ' ' << box.min.y << ' ' << box.min.z;
  EXPECT_LE(glm::length(box.max - max), error) << box.max.x << ' ' << box.max.y << ' ' << box.max.z;
}

/// What is cut away does not count, what is thin does, as do the parts that are shown beside.
TEST(SeenBox, IsThatOfWhatIsLeft) {
  const auto expect_seen = [](const std::string& text, const Vec3& min, const Vec3& max) {
    SCOPED_TRACE(text);
    expect_box(seen_box(scene_of(text)), min, max);
  };
  expect_seen("difference() { cube(size = [10, 10, 10]); cube(size = [11, 11, 6]); }", {0, 0, 6},
              {10, 10, 10});
  expect_seen("intersection() { cube(size = [99, 99, 99]); cube(size = [50, 1e-4, 1e-4]); }",
              Vec3(0), {50, 1e-4, 1e-4});
  expect_seen("cube(size = [1, 1, 1]);\n%cube(size = [2, 3, 4]);\n", Vec3(0), {2, 3, 4});
  expect_seen("difference() { cube(size = [1, 1, 1]); #cube(size = [2, .5, .5]); }", Vec3(0),
              {2, 1, 1});
  expect_seen("sphere($fn = 0, $fa = 12, $fs = 2, r = 7);", Vec3(-7), Vec3(7));
  EXPECT_TRUE(seen_box(scene_of("")).empty());
}

TEST(SeenBox, FollowsTheFrame) {
  const csgcore::Scene scene =
      scene_of("difference() { cube(size = [10, 10, 10]); cube(size = [10, 10, 6]); }");
  const Mat3 to_frame(Vec3(0, 1, 0), Vec3(0, 0, 2), Vec3(1, 0, 1));
  expect_box(seen_box(scene, seen_box(scene), to_frame), {6, 0, 6}, {10, 10, 30}, 1e-6);
  // The image of a ball is far within that of its box.
  const csgcore::Scene ball = scene_of("sphere($fn = 0, $fa = 12, $fs = 2, r = 7);");
  const double half = std::sqrt(0.5);
  const Mat3 turned(Vec3(half, half, 0), Vec3(-half, half, 0), Vec3(0, 0, 1));
  expect_box(seen_box(ball, seen_box(ball), turned), Vec3(-7), Vec3(7));
}

TEST(FreePart, IsTheLargestBesideThePanels) {
  const LabelBox display{0, 0, 100, 100}, room{0, 10, 100, 80};
  const auto expect_part = [](const PicturePart& part, double left, double top, double right,
                              double bottom) {
    const double margin_x = 0.03 * (right - left), margin_y = 0.03 * (bottom - top);
    EXPECT_NEAR(part.left, left + margin_x, 1e-6);
    EXPECT_NEAR(part.top, top + margin_y, 1e-6);
    EXPECT_NEAR(part.right, right - margin_x, 1e-6);
    EXPECT_NEAR(part.bottom, bottom - margin_y, 1e-6);
  };
  expect_part(free_part(display, room, {}), 0, 0.1, 1, 0.9);
  const LabelBox strip{0, 10, 20, 80}, corner{60, 10, 40, 10}, large{10, 0, 80, 95}, none{};
  expect_part(free_part(display, room, std::vector{strip, corner, none}), 0.2, 0.2, 1, 0.9);
  expect_part(free_part(display, room, std::vector{large}), 0, 0.1, 1, 0.9);
  expect_part(free_part(display, {0, 10, 100, 5}, {}), 0, 0, 1, 1);
}

}  // namespace
}  // namespace window
