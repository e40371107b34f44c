// Tests the definition of the picture (NUMERICS.md, "The definition"), ray by ray, on cases small
// enough to be solved by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "checks.hpp"
#include "csgcore/tracer.hpp"
#include "trace_scenes.hpp"
#include "whole_list.hpp"

namespace csgcore {
namespace {

using checks::moved;
using checks::tree_of;

/// One pixel's ray: from 100 above the x-y plane, through (x, y) down along −z, or leaning.
struct Look {
  double x = 0, y = 0;
  Vec3 direction{0, 0, -1};
  Projection projection = Projection::kOrthographic;
  double height = 100;
  Boundary boundary = Boundary::kFirst;
};

struct Seen {
  uint32_t primitive;
  Vec3 position, normal;
};

/// Traces the ray by tiles and by cells, which must agree.
Seen look_at(std::vector<Primitive> primitives, const std::string& tree, const Look& look) {
  Scene scene;
  scene.primitives = std::move(primitives);
  scene.model = tree_of(tree);
  const Solid solid(canonical_primitives(scene), scene.model);
  View view = checks::view_of(solid.bounds(), look.direction, 0);
  const double distance = look.height / -look.direction.z;
  view.eye = Vec3{look.x, look.y, 0} - distance * look.direction;
  view.projection = look.projection;
  view.width_px = view.height_px = 1;
  TraceOptions options;
  options.boundary = look.boundary;
  const Hits hits = checks::trace_by_tiles(solid, view, options);
  const Subdivision subdivision(solid, SubdivisionOptions{});
  EXPECT_TRUE(checks::same_bits(checks::trace_by_cells(subdivision, view, options), hits));
  return {hits.primitive[0], hits.position[0], hits.normal[0]};
}

constexpr uint32_t kMiss = Hits::kMiss;
const Vec3 kUp{0, 0, 1};
const Vec3 kDown{0, 0, -1};

Primitive slab(double bottom, double top, double radius = 5) {
  return make_frustum(bottom, top, radius, radius);
}

/// Checks that the primitive is seen, at that height.
testing::AssertionResult shows(const Seen& seen, uint32_t primitive, double z, const Vec3& normal) {
  constexpr double kRounding = 1e-13;
  if (seen.primitive == primitive && std::abs(seen.position.z - z) < kRounding &&
      glm::length(seen.normal - normal) < kRounding) {
    return testing::AssertionSuccess();
  }
  return testing::AssertionFailure() << "primitive " << seen.primitive << " at " << seen.position.z
                                     << ", its normal's z " << seen.normal.z;
}

// --- Coincident faces ---

TEST(Definition, OfCoincidentFacesTheLastInFileOrderIsShown) {
  EXPECT_TRUE(shows(look_at({slab(0, 1), slab(0, 1)}, "(+ 1 0)", {}), 1u, 1, kUp));
  EXPECT_TRUE(shows(look_at({slab(-1, 1), slab(0, 1), slab(-2, 1)}, "(+ 2 1 0)", {}), 2u, 1, kUp));
  EXPECT_TRUE(shows(look_at({slab(-1, 1), slab(0, 1)}, "(* 1 0)", {}), 1u, 1, kUp));
  // A subtracted primitive that only touches what is left.
  EXPECT_TRUE(shows(look_at({slab(0, 1), slab(1, 2)}, "(- 0 1)", {}), 1u, 1, kUp));
}

TEST(Definition, AFlushHoleIsOpen) {
  const std::vector<Primitive> plate{slab(0, 1), slab(0, 1, 2)};
  EXPECT_EQ(look_at(plate, "(- 0 1)", {}).primitive, kMiss);
  EXPECT_TRUE(shows(look_at(plate, "(- 0 1)", {3, 0}), 0u, 1, kUp));
  // The ray leaves the subtracted primitive at its lower face, where another face is flush.
  EXPECT_TRUE(
      shows(look_at({slab(0, 1), slab(0, 1, 2), slab(-3, -2)}, "(+ (- 0 1) 2)", {}), 2u, -2, kUp));
}

TEST(Definition, AFlushPocketShowsItsFloor) {
  EXPECT_TRUE(shows(look_at({slab(0, 1), slab(0.5, 1, 2)}, "(- 0 1)", {}), 1u, 0.5, kUp));
}

TEST(Definition, AFaceSharedByAUnionLeavesNoSkin) {
  Look behind;
  behind.boundary = Boundary::kBehind;
  EXPECT_TRUE(shows(look_at({slab(0, 1), slab(1, 2)}, "(+ 0 1)", {}), 1u, 2, kUp));
  EXPECT_TRUE(shows(look_at({slab(0, 1), slab(1, 2)}, "(+ 0 1)", behind), 0u, 0, kDown));
}

/// A cut face, and the part that fills the cut up to it: each of them alone would be seen there.
TEST(Definition, ACutFaceThatMeetsAnotherPartIsThatOfTheLast) {
  EXPECT_TRUE(
      shows(look_at({slab(0, 2), slab(1, 3), slab(-1, 1)}, "(+ (- 0 1) 2)", {}), 2u, 1, kUp));
  EXPECT_TRUE(
      shows(look_at({slab(0, 2), slab(-1, 1), slab(1, 3)}, "(+ (- 0 2) 1)", {}), 2u, 1, kUp));
}

TEST(Definition, OfFacesThatTurnNoOperationNoneIsShown) {
  const std::vector<Primitive> four(4, slab(0, 1));
  EXPECT_TRUE(shows(look_at(four, "(+ (* 0 1) (* 2 3))", {}), 3u, 1, kUp));
  EXPECT_TRUE(shows(look_at(four, "(+ (* 1 3) (* 0 2))", {}), 3u, 1, kUp));
  // 3 and 2 are cut away at once.
  EXPECT_TRUE(shows(look_at(four, "(+ (* 0 1) (- 3 2))", {}), 1u, 1, kUp));
  EXPECT_TRUE(shows(look_at(four, "(* 0 (+ 1 (- 3 2)))", {}), 1u, 1, kUp));
  // 3 is cut away by a primitive that the ray is inside of already.
  const std::vector<Primitive> in_cut{slab(0, 1), slab(0, 2), slab(-3, 1), slab(-2, 1)};
  EXPECT_TRUE(shows(look_at(in_cut, "(+ (- 3 1) 0)", {}), 0u, 1, kUp));
  EXPECT_TRUE(shows(look_at(in_cut, "(+ (- 3 1) (* 0 2))", {}), 2u, 1, kUp));
  // 3 alone would suffice, but the ray is inside the other operand already.
  const std::vector<Primitive> in_other{slab(0, 1), slab(0, 2), slab(-3, 1), slab(-2, 1)};
  EXPECT_TRUE(shows(look_at(in_other, "(* 0 (+ 1 3))", {}), 0u, 1, kUp));
}

/// Where one operand ends as another one starts, the operation holds before and behind.
TEST(Definition, AnOperationThatIsHandedOverHasNotTurned) {
  const std::vector<Primitive> stacked{slab(0, 1), slab(1, 2), slab(0, 1, 4)};
  EXPECT_TRUE(shows(look_at(stacked, "(* 0 (+ 1 2))", {}), 0u, 1, kUp));
  EXPECT_TRUE(shows(look_at(stacked, "(* (+ 1 2) 0)", {}), 0u, 1, kUp));
  // 1 is cut away all along, and its cut ends where it ends.
  Look look;
  look.projection = Projection::kPerspective;
  look.height = 0.5;
  const std::vector<Primitive> cut_away{slab(0, 1), slab(0, 1, 4), slab(0, 2, 3)};
  EXPECT_TRUE(shows(look_at(cut_away, "(+ 0 (- 1 2))", look), 0u, 0, kDown));
}

TEST(Definition, APrimitiveThatIsAddedAndSubtractedFacesOutBothWays) {
  const std::vector<Primitive> parts{slab(0, 2), slab(1, 3)};
  const std::string either_or = "(+ (- 0 1) (- 1 0))";
  Look behind;
  behind.boundary = Boundary::kBehind;
  EXPECT_TRUE(shows(look_at(parts, either_or, {}), 1u, 3, kUp));
  EXPECT_TRUE(shows(look_at(parts, either_or, behind), 0u, 2, kDown));
  // Two coincident primitives, neither of which decides alone.
  const std::vector<Primitive> twins{slab(0, 1), slab(0, 1), slab(-3, -2)};
  EXPECT_TRUE(shows(look_at(twins, "(+ 0 1 (- 2 0 1))", {}), 1u, 1, kUp));
  EXPECT_TRUE(shows(look_at(twins, "(+ (- 2 0 1) 0 1)", {}), 1u, 1, kUp));
}

// --- The thinnest piece ---

/// For the tests below: two small balls make the scene's box 20 wide each way.
const Primitive kCorners[] = {make_sphere(1, moved({-9, -9, -9})),
                              make_sphere(1, moved({9, 9, 9}))};
const double kThinnest = 1e-9 * 20 * std::sqrt(3.0);

/// Looks at a wall that is `times` tolerances thick, with something behind it.
Seen look_at_wall(double times, const Look& look) {
  return look_at({kCorners[0], kCorners[1], slab(0, times * kThinnest), slab(-4, -3)},
                 "(+ 0 1 2 3)", look);
}

TEST(Definition, AWallThinnerThanTheToleranceDoesNotExist) {
  for (const double angle : {0.0, 0.5, 1.0, 1.4}) {
    SCOPED_TRACE(angle);
    // The ray goes through a point of the wall, at an angle; thickness does not depend on the
    // angle.
    const Look look{0, 0, {std::sin(angle), 0, -std::cos(angle)}};
    EXPECT_EQ(look_at_wall(1.01, look).primitive, 2u);
    EXPECT_NE(look_at_wall(0.99, look).primitive, 2u);
  }
  EXPECT_TRUE(shows(look_at_wall(0.5, {}), 3u, -3, kUp));
  EXPECT_TRUE(shows(look_at_wall(2, {}), 2u, 2 * kThinnest, kUp));
}

/// Two slabs with a gap between them, seen from above: where the upper one ends.
TEST(Definition, AGapNarrowerThanTheToleranceDoesNotExist) {
  Look behind;
  behind.boundary = Boundary::kBehind;
  const auto look_at_gap = [&](double times) {
    return look_at({kCorners[0], kCorners[1], slab(-2, 0), slab(times * kThinnest, 3)},
                   "(+ 0 1 2 3)", behind);
  };
  EXPECT_TRUE(shows(look_at_gap(0.99), 2u, -2, kDown));
  EXPECT_TRUE(shows(look_at_gap(1.01), 3u, 1.01 * kThinnest, kDown));
}

/// A cut whose wall is too thin to exist leaves the face behind it.
TEST(Definition, OfACoincidenceWhatHasChangedIsShown) {
  EXPECT_TRUE(shows(
      look_at({kCorners[0], kCorners[1], slab(0, 0.5 * kThinnest), slab(-3, 0)}, "(+ 0 1 2 3)", {}),
      3u, 0, kUp));
}

// --- The eye ---

TEST(Definition, AnEyeInAFaceSeesFromTheToleranceOn) {
  const std::vector<Primitive> parts{kCorners[0], kCorners[1], slab(0, 3)};
  Look look;
  look.projection = Projection::kPerspective;
  for (const double above : {-0.9, 0.0, 0.9}) {
    SCOPED_TRACE(above);
    look.height = 3 + above * kThinnest;
    look.direction = kDown;
    EXPECT_TRUE(shows(look_at(parts, "(+ 0 1 2)", look), 2u, 0, kDown));  // from inside
  }
  look.height = 3 + 1.1 * kThinnest;
  EXPECT_TRUE(shows(look_at(parts, "(+ 0 1 2)", look), 2u, 3, kUp));
}

TEST(Definition, APerspectiveViewDoesNotSeeWhatIsBehindTheEye) {
  const std::vector<Primitive> parts{kCorners[0], kCorners[1], slab(0, 3), slab(5, 6)};
  Look look;
  look.projection = Projection::kPerspective;
  look.height = 4;
  EXPECT_TRUE(shows(look_at(parts, "(+ 0 1 2 3)", look), 2u, 3, kUp));
  look.projection = Projection::kOrthographic;
  EXPECT_TRUE(shows(look_at(parts, "(+ 0 1 2 3)", look), 3u, 6, kUp));
}

TEST(Definition, AnEyeInsideSeesTheInnerSide) {
  const std::vector<Primitive> parts{slab(0, 9), slab(2, 3, 2)};
  Look look;
  look.projection = Projection::kPerspective;
  look.height = 5;
  EXPECT_TRUE(shows(look_at(parts, "(- 0 1)", look), 1u, 3, kDown));
  look.boundary = Boundary::kBehind;
  EXPECT_TRUE(shows(look_at(parts, "(- 0 1)", look), 1u, 2, kUp));
}

}  // namespace
}  // namespace csgcore
