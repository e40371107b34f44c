// Tests the operands that are left out of a solid's outer groups: nobody outside can see them, and
// a view that can does see them.
#include "solid/hidden_operands.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <numeric>

#include "checks.hpp"
#include "csgcore/polyhedron.hpp"
#include "csgcore/subdivision.hpp"
#include "made.hpp"
#include "solid/operand_groups.hpp"
#include "support/full_run.hpp"
#include "trace_scenes.hpp"
#include "whole_list.hpp"

namespace csgcore {
namespace {

using checks::moved;
using checks::uniform;

/// Half a side of the block that hides things.
constexpr double kHalf = 10;

Primitive make_block(const Vec3& half, const Affine& placed = {}) {
  return make_polyhedron(Polyhedron::box({-half, half}), placed);
}

/// A scene whose primitives are numbered as they are added.
class Designer {
 public:
  void open(Op op) { builder_.open(op); }
  void close() { builder_.close(); }
  void add(const Primitive& primitive) {
    again(static_cast<uint32_t>(scene_.primitives.size()));
    scene_.primitives.push_back(primitive);
  }
  /// Adds one more operand of a primitive that the tree has already.
  void again(uint32_t primitive) { builder_.primitive(primitive); }
  Scene finish() {
    scene_.model = builder_.finish();
    return std::move(scene_);
  }

 private:
  Scene scene_;
  CsgTreeBuilder builder_;
};

constexpr int kSide = 6;
constexpr size_t kLattice = kSide * kSide * kSide;

/// Balls inside the block. Those of a row along x overlap; rows do not.
void add_lattice(Designer& design) {
  for (int i = 0; i < static_cast<int>(kLattice); ++i) {
    const Vec3 place(i % kSide, i / kSide % kSide, i / kSide / kSide);
    design.add(make_sphere(0.9, moved(Vec3(1.6, 2.5, 2.5) * (place - 0.5 * (kSide - 1)))));
  }
}

void expect_the_whole_picture(const Solid& solid, const View& view, Boundary boundary) {
  TraceOptions options;
  options.boundary = boundary;
  EXPECT_TRUE(checks::same_bits(checks::trace_by_tiles(solid, view, options),
                                checks::WholeList(solid, view, boundary).picture()));
}

void expect_the_whole_picture(const Solid& solid) {
  for (const auto& [name, view] : checks::trace_views(solid.bounds(), 48, 36)) {
    SCOPED_TRACE(name);
    expect_the_whole_picture(solid, view, Boundary::kFirst);
    expect_the_whole_picture(solid, view, Boundary::kBehind);
  }
}

Solid solid_of(const Scene& scene) { return Solid(canonical_primitives(scene), scene.model); }

Solid block_and_lattice(Op op) {
  Designer design;
  design.open(op);
  design.add(make_block(Vec3(kHalf)));
  add_lattice(design);
  design.close();
  return solid_of(design.finish());
}

const HiddenOperands& hidden_in(const Solid& solid) { return solid.outer_groups().hidden(); }

TEST(HiddenOperands, VoidsInASolid) {
  const Solid solid = block_and_lattice(Op::kDifference);
  EXPECT_EQ(hidden_in(solid).inside.size(), kLattice);
  EXPECT_EQ(solid.outer_groups().list().count(), 1u);
  expect_the_whole_picture(solid);
}

TEST(HiddenOperands, PartsInASolid) {
  const Solid solid = block_and_lattice(Op::kUnion);
  EXPECT_EQ(solid.inner().size(), kLattice);  // before hidden operands are sought
  EXPECT_EQ(solid.outer_groups().list().count(), 1u);
  expect_the_whole_picture(solid);
}

/// If anything of a row is seen, all of it may be.
TEST(HiddenOperands, ATunnelOpensARow) {
  for (const bool reaches : {false, true}) {
    Designer design;
    design.open(Op::kDifference);
    design.add(make_block(Vec3(kHalf)));
    add_lattice(design);
    // A tunnel from the side to the first ball of the middle row, or not quite to it.
    const double end = reaches ? 0.8 : 1.0;
    const Vec3 first = Vec3(-1.6, 0.5, 0.5) * Vec3(2.5, 2.5, 2.5) - Vec3(end, 0, 0);
    const double length = first.x + kHalf + 1;
    design.add(make_block({0.5 * length, 0.3, 0.3}, moved(first - Vec3(0.5 * length, 0, 0))));
    design.close();
    const Solid solid = solid_of(design.finish());
    EXPECT_EQ(hidden_in(solid).inside.size(), reaches ? kLattice - kSide : kLattice);
    expect_the_whole_picture(solid);
  }
}

TEST(HiddenOperands, AThinWallHidesNothing) {
  Designer design;
  design.open(Op::kDifference);
  design.add(make_block(Vec3(kHalf)));
  for (const double wall : {1e-7, 1e-3}) {
    for (uint32_t i = 0; i < 100; ++i) {
      const double x = 1.8 * (i % 10) - 8.1, y = 1.8 * (i / 10) - 8.1;
      const double z = (kHalf - 0.5 - wall * kHalf) * (wall < 1e-5 ? 1 : -1);
      design.add(make_sphere(0.5, moved({x, y, z})));
    }
  }
  design.close();
  const Solid solid = solid_of(design.finish());
  std::vector<uint32_t> thick(100);
  std::iota(thick.begin(), thick.end(), 101u);
  EXPECT_EQ(hidden_in(solid).inside, thick);
  expect_the_whole_picture(solid);
}

/// Nothing is left of the parts, however little they are inside what takes them away.
TEST(HiddenOperands, WhatIsWhollyTakenAway) {
  Designer design;
  design.open(Op::kUnion);
  design.add(make_block(Vec3(1), moved({20, 0, 0})));
  design.open(Op::kDifference);
  design.open(Op::kUnion);
  std::mt19937 random(1);
  for (int i = 0; i < 300; ++i) {
    const double distance = (kHalf - 1.001) * (i % 3 ? uniform(random, 0, 1) : 1.0);
    const Vec3 place = distance * checks::random_direction(random);
    if (i % 2) {
      design.add(make_sphere(1, moved(place)));
    } else {
      design.add(make_frustum(-0.7, 0.7, 0.7, 0.7 * (i % 4 / 2), moved(place)));
    }
  }
  design.close();
  design.add(make_sphere(kHalf));
  design.close();
  design.close();
  const Solid solid = solid_of(design.finish());
  EXPECT_EQ(hidden_in(solid).cancelled.size(), 300u);
  EXPECT_EQ(solid.outer_groups().list().count(), 1u);
  expect_the_whole_picture(solid);
}

/// A crowd of voids, each of which overlaps hundreds, and some of which are open to the outside.
/// Finding that all of them are seen would take longer than many pictures, so that the search is
/// given up.
TEST(HiddenOperands, ConnectedCrowdsAreGivenUp) {
  Designer design;
  design.open(Op::kDifference);
  design.add(make_block({kHalf, kHalf, 4 * kHalf}));
  std::mt19937 random(1);
  for (int i = 0; i < 2000; ++i) {
    const double room = i < 20 ? kHalf : kHalf - 2.1;
    const Vec3 place = checks::random_point(random, {Vec3(-room), Vec3(room)});
    design.add(make_sphere(2, moved(place)));
  }
  for (int i = 0; i < 2000; ++i) {
    const Vec3 place(i % 10 - 4.5, i / 10 % 10 - 4.5, kHalf + 4 + i / 100);
    design.add(make_sphere(0.3, moved(place)));
  }
  design.close();
  EXPECT_EQ(hidden_in(solid_of(design.finish())).count(), 0u);
}

/// Holes from side to side, between rows of voids.
TEST(HiddenOperands, LongHolesHideWhatTheyDoNotReach) {
  Designer design;
  design.open(Op::kDifference);
  design.add(make_block(Vec3(kHalf)));
  add_lattice(design);
  const Mat3 along_x{{0, 0, -1}, {0, 1, 0}, {1, 0, 0}};
  for (int i = 0; i < kSide - 1; ++i) {
    const Vec3 place(0, 2.5 * (i - 0.5 * (kSide - 2)), 1.25);
    design.add(make_frustum(-2 * kHalf, 2 * kHalf, 0.1, 0.1, {along_x, place}));
  }
  design.close();
  const Solid solid = solid_of(design.finish());
  EXPECT_EQ(hidden_in(solid).inside.size(), kLattice);
  expect_the_whole_picture(solid);
}

/// A wall so large that its coordinates tell little of where it ends.
TEST(HiddenOperands, HugeWallsHideWhatIsCertain) {
  std::mt19937 random(1);
  for (const double huge : {1e9, 1e12}) {
    Designer design;
    design.open(Op::kIntersection);
    design.open(Op::kDifference);
    const Vec3 up = glm::normalize(Vec3(1, 2, 3));
    const Vec3 side = glm::normalize(glm::cross(up, Vec3(1, 0, 0)));
    const Affine placed{Mat3{side, glm::cross(up, side), up}, -huge * up};
    design.add(make_block(Vec3(huge), placed));
    for (const double deepest : {0.3, 5.0}) {
      for (int i = 0; i < 300; ++i) {
        const double depth = deepest - uniform(random, 1e-4, 1e-3);  // the first ones reach out
        const Vec3 place = checks::random_point(random, {Vec3(-kHalf), Vec3(kHalf)});
        design.add(make_sphere(0.3, moved(place - (glm::dot(place, up) + depth) * up)));
      }
    }
    design.close();
    design.add(make_block(Vec3(2 * kHalf)));
    design.close();
    const Solid solid = solid_of(design.finish());
    const std::vector<uint32_t>& inside = hidden_in(solid).inside;
    ASSERT_GT(inside.size(), 200u);
    EXPECT_GT(inside.front(), 300u);
  }
}

/// Nested operations of a few operands, and one of many.
TEST(HiddenOperands, LongListsAreLeftAsTheyAre) {
  Designer design;
  design.open(Op::kUnion);
  const auto add_nested = [&](uint32_t depth) {
    for (uint32_t i = 0; i < depth; ++i) {
      design.open(Op::kIntersection);
      design.add(make_sphere(1, moved({0, 30, 0})));
      design.open(Op::kUnion);
      design.add(make_sphere(0.5, moved({0, 30.7, 0})));
    }
    for (uint32_t i = 0; i < 2 * depth; ++i) design.close();
  };
  add_nested(2000);
  design.open(Op::kDifference);
  design.add(make_block(Vec3(kHalf)));
  add_lattice(design);
  design.close();
  design.close();
  const Solid solid = solid_of(design.finish());
  EXPECT_GT(solid.groups().list().count(), 1024u);
  EXPECT_EQ(hidden_in(solid).count(), 0u);
}

TEST(HiddenOperands, WhatStandsTwiceStays) {
  Designer design;
  design.open(Op::kUnion);
  design.open(Op::kDifference);
  design.add(make_block(Vec3(kHalf)));
  add_lattice(design);
  design.close();
  design.open(Op::kIntersection);
  design.add(make_block(Vec3(kHalf), moved({-1.4 * kHalf, 0, 0})));
  design.again(1);
  design.close();
  design.close();
  const Solid solid = solid_of(design.finish());
  const std::vector<uint32_t>& inside = hidden_in(solid).inside;
  EXPECT_EQ(std::count(inside.begin(), inside.end(), 1u), 0);
  // Its row stays, too: an operand that is kept is assumed to be seen.
  EXPECT_EQ(inside.size(), kLattice - kSide);
  expect_the_whole_picture(solid);
}

TEST(HiddenOperands, AreSeenByAnEyeAmongThem) {
  const Solid solid = block_and_lattice(Op::kDifference);
  View view = checks::trace_views(solid.bounds(), 64, 48)[0].view;
  view.half_height = 1;
  // The eye is in a void; in the solid, where the ray ends as the solid does; or in the wall about
  // the voids.
  for (const Vec3& eye : {Vec3(0.8, 1.25, 1.25), Vec3(0.0), Vec3(0, 0, 9.9)}) {
    view.eye = eye;
    expect_the_whole_picture(solid, view, Boundary::kFirst);
    const Hits hits = checks::trace_by_tiles(solid, view);
    EXPECT_TRUE(std::ranges::any_of(
        hits.primitive, [](uint32_t primitive) { return primitive > 0 && primitive < kLattice; }));
  }
}

/// Walls are removed or added, so that earlier judgements do not hold.
TEST(HiddenOperands, AreJudgedAgainAfterEdits) {
  const auto design_with = [](const Vec3& body, const Vec3& tunnel) {
    Designer design;
    design.open(Op::kDifference);
    design.add(make_block(Vec3(kHalf), moved(body)));
    add_lattice(design);
    design.add(make_block({kHalf, 0.3, 0.3}, moved(tunnel)));
    design.close();
    return design.finish();
  };
  const Vec3 beside(0, 0, 9);
  const Scene scenes[] = {design_with({}, beside), design_with({}, {0, 1.25, 1.25}),
                          design_with({4, 0, 0}, {0, 1.25, 1.25}), design_with({4, 0, 0}, beside),
                          design_with({}, beside)};
  const size_t hidden[] = {kLattice, kLattice - kSide};
  checks::Made made(scenes[0]);
  EXPECT_EQ(hidden_in(made.solid).inside.size(), hidden[0]);
  for (size_t i = 1; i < std::size(scenes); ++i) {
    SCOPED_TRACE(i);
    const SceneEdit edit = compare(scenes[i - 1], scenes[i]);
    checks::Made next(scenes[i], made, edit);
    if (i < std::size(hidden)) {
      EXPECT_EQ(hidden_in(next.solid).inside.size(), hidden[i]);
    }
    expect_the_whole_picture(next.solid);
    made = std::move(next);
  }
}

/// Blocks with voids in them and parts on them, tunnels, and cuts through all of it.
Scene random_design(uint32_t seed) {
  std::mt19937 random(seed);
  const auto turned = [&](const Vec3& place) {
    const Vec3 x = checks::random_direction(random);
    const Vec3 y = glm::normalize(glm::cross(x, checks::random_direction(random)));
    return Affine{Mat3{x, y, glm::cross(x, y)}, place};
  };
  const auto part = [&](double smallest, double largest, const Vec3& place) {
    const double size = uniform(random, smallest, largest);
    switch (random() % 3) {
      case 0:
        return make_sphere(size, turned(place));
      case 1:
        return make_frustum(-0.7 * size, 0.7 * size, 0.7 * size, 0.35 * size * (random() % 3),
                            turned(place));
    }
    return make_block(Vec3(0.5 * size), turned(place));
  };
  Designer design;
  design.open(Op::kUnion);
  const int bodies = 1 + static_cast<int>(random() % 3);
  for (int body = 0; body < bodies; ++body) {
    const Vec3 center = checks::random_point(random, {Vec3(-5.0), Vec3(5.0)});
    const double room = uniform(random, 0.5, 1.02);
    const auto add_parts = [&](uint32_t most, double largest) {
      const uint32_t count = random() % most;
      for (uint32_t i = 0; i < count; ++i) {
        const Vec3 place = center + checks::random_point(random, {Vec3(-5 * room), Vec3(5 * room)});
        design.add(part(0.05, largest, place));
      }
    };
    design.open(Op::kDifference);
    design.open(Op::kUnion);
    switch (random() % 3) {
      case 0:
        design.add(make_sphere(7, turned(center)));
        break;
      case 1:
        design.add(make_frustum(-5, 5, 7, 6, turned(center)));
        break;
      case 2:
        design.add(make_block(Vec3(5.5), moved(center)));
    }
    add_parts(300, 0.6);
    design.close();
    add_parts(300, 0.6);
    add_parts(4, 4);
    if (random() % 3 == 0) design.again(random() % 20);
    design.close();
  }
  design.close();
  Scene scene = design.finish();
  if (random() % 3 == 0) {
    scene.primitives.push_back(
        make_block({100, 100, 100}, moved(Vec3(0, 0, uniform(random, 95, 105)))));
    scene.model = subtract(scene.model, static_cast<uint32_t>(scene.primitives.size()) - 1);
  }
  return scene;
}

/// Most of these designs hide enough.
TEST(HiddenOperands, RandomDesignsShowTheSame) {
  const uint32_t designs = test_support::full_run() ? 5000 : 40;
  uint32_t with_hidden = 0;
  for (uint32_t seed = 1; seed <= designs && !testing::Test::HasFailure(); ++seed) {
    SCOPED_TRACE(seed);
    const Solid solid = solid_of(random_design(seed));
    with_hidden += hidden_in(solid).count() > 0;
    expect_the_whole_picture(solid);
  }
  EXPECT_GT(with_hidden, designs / 4);
}

}  // namespace
}  // namespace csgcore
