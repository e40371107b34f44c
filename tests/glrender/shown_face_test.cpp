// Tests which of several coincident faces is shown: the last in file order of those that make the
// solid start there (csgcore/NUMERICS.md §1).
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <iterator>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "agreement.hpp"
#include "csgcore/polyhedron.hpp"
#include "fixture.hpp"
#include "support/models.hpp"

namespace {

using csgcore::CsgTreeBuilder;
using csgcore::Image;
using csgcore::make_polyhedron;
using csgcore::Op;
using csgcore::Polyhedron;
using csgcore::Primitive;
using csgcore::Projection;
using csgcore::Scene;
using csgcore::Vec3;
using csgcore::View;
using gl_test::LoadedScene;
using gl_test::Way;

/// A part of a design: an operation, or a rod about the z axis.
struct Part {
  std::vector<Part> operands;
  Op op = Op::kUnion;
  Primitive primitive{};
};

Part rod(double from, double to, double radius) {
  return {{}, Op::kUnion, csgcore::make_frustum(from, to, radius, radius)};
}
Part any(std::vector<Part> operands) { return {std::move(operands), Op::kUnion}; }
Part all(std::vector<Part> operands) { return {std::move(operands), Op::kIntersection}; }
Part less(std::vector<Part> operands) { return {std::move(operands), Op::kDifference}; }

/// Adds the part, and numbers its primitives in file order.
void add(const Part& part, Scene& scene, CsgTreeBuilder& tree) {
  if (part.operands.empty()) {
    const auto index = static_cast<uint32_t>(scene.primitives.size());
    scene.primitives.push_back(part.primitive);
    scene.primitives.back().id = index;
    tree.primitive(index);
    return;
  }
  tree.open(part.op);
  for (const Part& operand : part.operands) add(operand, scene, tree);
  tree.close();
}

Scene scene_of(const Part& part) {
  Scene scene;
  CsgTreeBuilder tree;
  add(part, scene, tree);
  scene.model = tree.finish();
  return scene;
}

/// A design with a face at z = 2, and the primitive that it shows within `radius` of the z axis.
struct SharedFace {
  const char* name;
  Part part;
  uint32_t shown;
  double radius = 2.9;
};

const Part kWide = rod(0, 2, 5), kNarrow = rod(0, 2, 3), kLid = rod(1, 2, 3), kLow = rod(0, 1, 3),
           kHigh = rod(0, 4, 3), kAbove = rod(2, 4, 3), kPin = rod(0, 2, 1);

/// Designs seen from above, where the solid starts at the face.
std::vector<SharedFace> tops() {
  return {
      {"union", any({kWide, kNarrow}), 1},
      {"union, the other way round", any({kNarrow, kWide}), 1},
      {"union of three", any({kWide, kNarrow, kLid}), 2},
      {"union, the last of which is lower", any({kWide, kNarrow, kLow}), 1},
      {"intersection", all({kWide, kNarrow}), 1},
      {"intersection of three", all({kWide, kNarrow, kLid}), 2},
      {"intersection, the last of which goes on", all({kWide, kNarrow, kHigh}), 1},
      {"cut that only touches", less({kWide, kAbove}), 1},
      {"cut that only touches, beyond it", less({kWide, rod(2, 4, 9)}), 1, 4.9},
      {"two cuts that only touch", less({kWide, kAbove, kAbove}), 2},
      {"inlay", any({less({kWide, kLid}), kLid}), 2},
      {"inlay before its hole", any({kLid, less({kWide, kLid})}), 0},
      {"two inlays", any({less({kWide, kLid}), kLid, kNarrow}), 3},
      {"in common with a union", all({kWide, any({kNarrow, kLid})}), 2},
      {"in common with a union, the first of which starts", all({kWide, any({kNarrow, kLow})}), 1},
      {"in common with a union that goes on", all({kWide, any({kNarrow, kHigh})}), 0},
      {"union with what is in common, before", any({all({kWide, kNarrow}), kLid}), 2},
      {"union with what is in common, behind", any({kLid, all({kWide, kNarrow})}), 2},
      {"union of differences", any({less({kWide, kAbove}), less({kNarrow, kLid})}), 1},
      {"hole with a core, which changes nothing there", less({kWide, less({kLid, kPin})}), 0, 0.9},
      {"hole with a core, in a plate with a pocket",
       less({any({kWide, less({kHigh, kAbove})}), less({kLid, kPin})}), 2, 0.9},
      {"core that hands over to another",
       any({less({kWide, less({kLid, kPin})}), less({kPin, kAbove})}), 4, 0.9},
  };
}

/// Designs seen from inside, where the solid ends at the face.
std::vector<SharedFace> ceilings() {
  return {
      {"union", any({kWide, kNarrow}), 1},
      {"union, the last of which is lower", any({kWide, kNarrow, kLow}), 1},
      {"intersection", all({kWide, kNarrow}), 1},
      {"intersection, the last of which goes on", all({kNarrow, kHigh}), 0},
      {"cut that starts there", less({kWide, kAbove}), 1},
      {"cut that starts there, of what goes on", less({rod(0, 4, 5), kAbove, kAbove}), 2},
      {"in common with a union", all({kWide, any({kNarrow, kPin})}), 2, 0.9},
      {"in common with a union that goes on", all({kWide, any({kNarrow, kHigh})}), 0},
  };
}

class ShownFaceTest : public testing::TestWithParam<Way> {
 protected:
  static void expect_shown(const SharedFace& face, const View& view) {
    SCOPED_TRACE(face.name);
    const Image image = gl_test::draw(scene_of(face.part), view, GetParam());
    uint64_t seen = 0, of_another = 0;
    for (size_t i = 0; i < image.z.size(); ++i) {
      const glm::vec3& p = image.position[i];
      if (std::isinf(image.z[i]) || std::abs(p.z - 2) > 1e-4) continue;
      if (std::hypot(p.x, p.y) > face.radius) continue;
      ++seen;
      of_another += image.id[i] != face.shown;
    }
    EXPECT_GT(seen, 30u);
    EXPECT_EQ(of_another, 0u);
  }
};

INSTANTIATE_TEST_SUITE_P(, ShownFaceTest,
                         testing::Values(Way(gl_test::leaves_of(1)), Way(gl_test::leaves_of(2)),
                                         Way(gl_test::leaves_of(8)), gl_test::by_tiles()),
                         gl_test::test_name);

TEST_P(ShownFaceTest, IsTheLastThatStartsTheSolid) {
  for (const Projection projection : {Projection::kPerspective, Projection::kOrthographic}) {
    for (const SharedFace& face : tops()) {
      View view = gl_test::view_from(scene_of(face.part), projection, 25, 35);
      view.width_px = 120;
      view.height_px = 90;
      expect_shown(face, view);
    }
  }
}

TEST_P(ShownFaceTest, IsTheLastThatEndsTheSolidAroundTheEye) {
  for (const SharedFace& face : ceilings()) {
    View view;
    view.eye = {0.1, 0.2, 0.6};
    view.forward = {0, 0, 1};
    view.right = {1, 0, 0};
    view.up = {0, -1, 0};
    view.half_height = 0.5;
    view.width_px = 80;
    view.height_px = 60;
    expect_shown(face, view);
  }
}

/// Returns a random operation on rods of which most have an end at z = 2.
Part random_part(std::mt19937_64& random, int depth) {
  const auto below = [&](uint64_t end) { return random() % end; };
  if (depth == 0 || below(4) == 0) {
    const Part rods[] = {kWide, kNarrow, kLid, kHigh, kAbove, kPin, kLow, rod(2, 5, 5)};
    return rods[below(std::size(rods))];
  }
  std::vector<Part> operands;
  for (uint64_t i = 0, count = 2 + below(2); i < count; ++i) {
    operands.push_back(random_part(random, depth - 1));
  }
  const Op op = std::array{Op::kUnion, Op::kIntersection, Op::kDifference}[below(3)];
  return {std::move(operands), op};
}

Part moved(Part part, const Vec3& by) {
  std::vector<Part*> left{&part};
  while (!left.empty()) {
    Part& next = *left.back();
    left.pop_back();
    next.primitive.local_to_world.translation += by;
    for (Part& operand : next.operands) left.push_back(&operand);
  }
  return part;
}

TEST_P(ShownFaceTest, IsTheTracersInRandomDesigns) {
  constexpr int kSide = 14;  // designs in a row
  std::mt19937_64 random(38);
  Part all_of = any({});
  for (int i = 0; i < kSide * kSide; ++i) {
    all_of.operands.push_back(
        moved(random_part(random, 4), Vec3(12 * (i % kSide), 12 * (i / kSide), 0)));
  }
  const Scene scene = scene_of(all_of);
  LoadedScene loaded(scene, GetParam());
  View view = gl_test::view_from(scene, Projection::kOrthographic, 25, 60);
  view.width_px = view.height_px = 280;
  const Image gl = loaded.draw(view), cpu = gl_test::draw_by_cpu(loaded, view);
  uint64_t seen = 0;
  for (size_t i = 0; i < cpu.z.size(); ++i) {
    const glm::vec3& p = cpu.position[i];
    if (std::isinf(cpu.z[i]) || std::abs(p.z - 2) > 1e-4) continue;
    // Rods have radii of 1, 3 and 5, next to which either side is right.
    const double radius = std::hypot(std::remainder(p.x, 12), std::remainder(p.y, 12));
    if (std::abs(std::remainder(radius, 2)) > 0.9) continue;
    ++seen;
    ASSERT_EQ(gl.id[i], cpu.id[i]) << p.x << " " << p.y;
  }
  EXPECT_GT(seen, 1000u);
}

/// A list longer than a shader keeps: the last face that starts there is shown, without speckle.
TEST(LongListTest, ShowsTheLastFaceOfAll) {
  Part part = any({less({rod(0, 3, 5), rod(1, 3, 3)})});
  for (int i = 0; i < 140; ++i) part.operands.push_back(rod(0.005 * i, 3, 3));
  const Scene scene = scene_of(part);
  const View view = gl_test::view_from(scene, Projection::kPerspective, 25, 35);
  const Image image = gl_test::draw(scene, view, gl_test::leaves_of(32));
  uint64_t seen = 0;
  for (size_t i = 0; i < image.z.size(); ++i) {
    const glm::vec3& p = image.position[i];
    if (std::isinf(image.z[i]) || std::abs(p.z - 3) > 1e-4 || std::hypot(p.x, p.y) > 2.9) continue;
    ++seen;
    ASSERT_EQ(image.id[i], 141u) << i;
  }
  EXPECT_GT(seen, 500u);
}

TEST_P(ShownFaceTest, OfTwoEqualCubesIsTheSecondsColor) {
  Scene scene;
  for (const csgcore::Color& color : {csgcore::Color{1, 0, 0, 1}, csgcore::Color{0, 0, 1, 1}}) {
    scene.primitives.push_back(make_polyhedron(Polyhedron::box({Vec3(0), Vec3(10)})));
    scene.primitives.back().color = color;
  }
  for (const Op op : {Op::kUnion, Op::kIntersection}) {
    CsgTreeBuilder tree;
    tree.open(op);
    tree.primitive(0);
    tree.primitive(1);
    tree.close();
    scene.model = tree.finish();
    const Image image = gl_test::draw(
        scene, gl_test::view_from(scene, Projection::kPerspective, 25, 35), GetParam());
    uint64_t hits = 0;
    for (size_t i = 0; i < image.z.size(); ++i) {
      if (std::isinf(image.z[i])) continue;
      ++hits;
      ASSERT_EQ(image.rgb[i][0], 0) << i;
      ASSERT_GT(image.rgb[i][2], 0) << i;
    }
    EXPECT_GT(hits, 10'000u);
  }
}

}  // namespace
