// Tests classification by points: a claim must hold at every point, and what the points show to be
// decided should be claimed.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>

#include "checks.hpp"
#include "support/full_run.hpp"
#include "support/reference_primitive.hpp"

namespace csgcore {
namespace {

using test_support::Variant;

/// A cell whose size is a share of the primitive's, near its surface.
Box random_cell(std::mt19937& random, const CanonicalPrimitive& primitive) {
  const Box& bounds = primitive.bounds;
  const Vec3 center = checks::random_point(
      random, {bounds.min - 0.2 * bounds.size(), bounds.max + 0.2 * bounds.size()});
  const double share = std::exp(checks::uniform(random, std::log(0.01), std::log(1.0)));
  const Vec3 half = share * bounds.size() * checks::random_point(random, {Vec3(0.1), Vec3(0.5)});
  return {center - half, center + half};
}

std::vector<Vec3> surface_points(const Primitive& primitive, int count) {
  std::mt19937 random(1);
  std::vector<Vec3> points;
  for (int i = 0; i < count; ++i) points.push_back(checks::surface_point(primitive, random));
  return points;
}

bool is_in(const Box& box, const Vec3& p) {
  return p.x >= box.min.x && p.x <= box.max.x && p.y >= box.min.y && p.y <= box.max.y &&
         p.z >= box.min.z && p.z <= box.max.z;
}

/// What a grid of the cell's points, and points of the primitive's surface, show. A cell without
/// any surface is entirely inside the primitive or outside.
struct Sampled {
  bool meets = false;   // some point is in both
  bool leaves = false;  // some point of the cell is not in the primitive
};

bool is_convex(const Primitive& primitive) { return csgcore::is_convex(primitive.shape()); }

Sampled sample(const Primitive& primitive, const std::vector<Vec3>& points, const Box& cell) {
  const int grid = is_convex(primitive) ? 12 : 5;
  Sampled result;
  for (int i = 0; i <= grid; ++i) {
    for (int j = 0; j <= grid; ++j) {
      for (int k = 0; k <= grid; ++k) {
        const Vec3 p = glm::mix(cell.min, cell.max, Vec3(i, j, k) / double(grid));
        (checks::holds(primitive, p) ? result.meets : result.leaves) = true;
      }
    }
  }
  for (size_t i = 0; i < points.size() && !result.meets; ++i) {
    result.meets = is_in(cell, points[i]);
  }
  return result;
}

struct Tally {
  int outside = 0, inside = 0, crossing = 0;
  int missed_outside = 0;  // said to cross, although no sample shows that they meet
  int missed_inside = 0;
};

void classify_cells(std::mt19937& random, const Primitive& primitive, int cells, Tally& tally) {
  const CanonicalPrimitive canonical = canonicalize(primitive);
  const std::vector<Vec3> points = surface_points(primitive, is_convex(primitive) ? 10000 : 1000);
  for (int i = 0; i < cells; ++i) {
    const Box cell = random_cell(random, canonical);
    const Sampled sampled = sample(primitive, points, cell);
    switch (classify(canonical, cell)) {
      case Classification::kOutside:
        ++tally.outside;
        ASSERT_FALSE(sampled.meets);
        break;
      case Classification::kInside:
        ++tally.inside;
        ASSERT_FALSE(sampled.leaves);
        break;
      case Classification::kCrosses:
        ++tally.crossing;
        tally.missed_outside += !sampled.meets;
        tally.missed_inside += !sampled.leaves;
        break;
    }
  }
}

void expect_tight(const Tally& tally) {
  // Some of these do meet, between the sampled points.
  EXPECT_LT(tally.missed_outside, 0.01 * (tally.outside + tally.missed_outside));
  EXPECT_EQ(tally.missed_inside, 0);  // exact: the corners decide
  EXPECT_GT(tally.outside, tally.crossing / 20);
  EXPECT_GT(tally.inside, tally.crossing / 50);
  testing::Test::RecordProperty(
      "missed_per_mille", 1000 * tally.missed_outside / (tally.outside + tally.missed_outside));
}

Affine similarity(std::mt19937& random) {
  const Vec3 z = checks::random_direction(random);
  const Vec3 x = glm::normalize(glm::cross(z, checks::random_direction(random)));
  const double scale = checks::uniform(random, 0.1, 10);
  return {Mat3{x * scale, glm::cross(z, x) * scale, z * scale}, 10.0 * x};
}

Affine axis_aligned(std::mt19937& random) {
  Affine map;
  for (int axis = 0; axis < 3; ++axis) {
    map.linear[axis][axis] = (random() % 2 ? 1 : -1) * checks::uniform(random, 0.2, 3);
  }
  return map;
}

Affine affine(std::mt19937& random) {
  Affine map = similarity(random);
  const Affine shear = axis_aligned(random);
  map.linear = map.linear * shear.linear * similarity(random).linear;
  return map;
}

struct NamedMap {
  const char* name;
  Affine (*make)(std::mt19937&);
};
constexpr NamedMap kMaps[] = {
    {"Similarity", similarity}, {"AxisAligned", axis_aligned}, {"Affine", affine}};

/// Primitives of moderate proportions, so that a grid of points finds their parts.
constexpr test_support::SizeRange kSizes{.low = 0.5, .high = 2, .most_fragments = 24};

/// How tight answers are is a share of all rounds: less tell nothing of it.
bool is_told_tightly(const Primitive& primitive) {
  return !test_support::does_less() &&
         test_support::test_kind_of(primitive.shape()).is_told_tightly();
}

class ClassificationOf : public testing::TestWithParam<std::tuple<Variant, NamedMap>> {
 protected:
  Primitive make(std::mt19937& random) const {
    test_support::Sizes sizes(random, kSizes);
    Primitive primitive = std::get<Variant>(GetParam()).make(sizes);
    primitive.local_to_world = std::get<NamedMap>(GetParam()).make(random);
    return primitive;
  }
  /// Answers about solids that are not convex are by brute force: fewer of them are asked for.
  int rounds(int of_convex) const {
    std::mt19937 random(1);
    const int all = is_convex(make(random)) ? of_convex : of_convex / 6;
    return test_support::does_less() ? std::max(all / 3, 1) : all;
  }
};

TEST_P(ClassificationOf, IsNeverWrongAndTight) {
  std::mt19937 random(5);
  Tally tally;
  const int count = rounds(24), cells = rounds(250);
  for (int i = 0; i < count; ++i) {
    const Primitive primitive = make(random);
    ASSERT_TRUE(is_valid(primitive));
    ASSERT_NO_FATAL_FAILURE(classify_cells(random, primitive, cells, tally));
  }
  if (is_told_tightly(make(random))) expect_tight(tally);
}

TEST_P(ClassificationOf, ReachIsNeverTooShort) {
  std::mt19937 random(6);
  const int count = rounds(50);
  for (int i = 0; i < count; ++i) {
    const Primitive primitive = make(random);
    const CanonicalPrimitive canonical = canonicalize(primitive);
    double furthest = 0;
    for (const Vec3& point : surface_points(primitive, 2000)) {
      furthest = std::max(furthest, glm::length(point - canonical.center));
    }
    ASSERT_LE(furthest, reach(canonical) * (1 + 1e-12));
    if (std::get<NamedMap>(GetParam()).make != affine && is_told_tightly(primitive)) {
      ASSERT_GT(furthest, 0.5 * reach(canonical));
    }
  }
}

TEST_P(ClassificationOf, FurthestPointsAreFurthest) {
  std::mt19937 random(9);
  const int count = rounds(50);
  for (int i = 0; i < count; ++i) {
    const Primitive primitive = make(random);
    const CanonicalPrimitive canonical = canonicalize(primitive);
    const std::vector<Vec3> points = surface_points(primitive, 1000);
    const double size = canonical.bounds.diagonal();
    for (int k = 0; k < 20; ++k) {
      const Vec3 direction = checks::random_direction(random);
      const double found = glm::dot(furthest_point(canonical, direction), direction);
      double sampled = -std::numeric_limits<double>::infinity();
      for (const Vec3& point : points) sampled = std::max(sampled, glm::dot(point, direction));
      ASSERT_LE(sampled, found + 1e-13 * size);
      // The points also test the test kind's own answer, from below.
      const double furthest = reference::furthest(primitive, {Vec3(0.0), direction});
      ASSERT_LE(sampled, furthest + 1e-13 * size);
      if (!is_told_tightly(primitive)) continue;
      ASSERT_NEAR(found, furthest, 1e-13 * size);
      ASSERT_LE(found, sampled + 0.1 * size);
    }
  }
}

/// Where a ball leaves the primitive first: the directions out of each side at its centre, in world
/// space, and the distance of the nearest side.
struct WaysOut {
  std::vector<Vec3> directions;
  double nearest = std::numeric_limits<double>::infinity();

  WaysOut(const Primitive& primitive, const Vec3& center) {
    const Mat3 world_to_local = glm::inverse(primitive.local_to_world.linear);
    const Vec3 local = world_to_local * (center - primitive.local_to_world.translation);
    for (const test_support::Side& side :
         test_support::test_kind_of(primitive.shape()).sides(primitive, LongVec3(local))) {
      const Vec3 gradient = glm::transpose(world_to_local) * Vec3(side.gradient);
      directions.push_back(glm::normalize(gradient));
      nearest = std::min(nearest, -static_cast<double>(side.outside) / glm::length(gradient));
    }
  }
};

TEST_P(ClassificationOf, HoldsBallsThatLieInside) {
  std::mt19937 random(7);
  int held = 0;
  const int count = rounds(50);
  for (int i = 0; i < count; ++i) {
    const Primitive primitive = make(random);
    const CanonicalPrimitive canonical = canonicalize(primitive);
    const Vec3 size = canonical.bounds.size();
    const double smallest = std::min({size.x, size.y, size.z});
    for (int k = 0; k < 100; ++k) {
      const Vec3 center = checks::random_point(random, canonical.bounds);
      const WaysOut ways_out(primitive, center);
      double radius = smallest * checks::uniform(random, 0.001, 0.3);
      // Half of the balls are just inside, or just not.
      if (k % 2 == 0 && ways_out.nearest > 0) {
        radius = ways_out.nearest * checks::uniform(random, 0.8, 1.05);
      }
      if (!holds_ball(canonical, center, radius)) continue;
      ++held;
      for (const Vec3& direction : ways_out.directions) {
        ASSERT_TRUE(checks::holds(primitive, center + radius * direction));
      }
      for (int on_ball = 0; on_ball < 100; ++on_ball) {
        ASSERT_TRUE(checks::holds(primitive, center + radius * checks::random_direction(random)));
      }
    }
  }
  EXPECT_TRUE(held > 50 || !is_told_tightly(make(random))) << held;
}

INSTANTIATE_TEST_SUITE_P(, ClassificationOf,
                         testing::Combine(testing::ValuesIn(test_support::all_variants()),
                                          testing::ValuesIn(kMaps)),
                         [](const auto& instance) {
                           return std::string(std::get<Variant>(instance.param).name) +
                                  std::get<NamedMap>(instance.param).name;
                         });

TEST(Classification, CellsThatTouch) {
  const CanonicalPrimitive ball = canonicalize(make_sphere(1));
  EXPECT_EQ(classify(ball, {{1 + 1e-9, -1, -1}, {2, 1, 1}}), Classification::kOutside);
  EXPECT_EQ(classify(ball, {{1 - 1e-9, -1, -1}, {2, 1, 1}}), Classification::kCrosses);
  const double corner = 1 / std::sqrt(3.0);
  EXPECT_EQ(classify(ball, {Vec3(-corner * (1 - 1e-9)), Vec3(corner * (1 - 1e-9))}),
            Classification::kInside);
  EXPECT_EQ(classify(ball, {Vec3(-corner * (1 + 1e-9)), Vec3(corner)}), Classification::kCrosses);
  const CanonicalPrimitive cylinder = canonicalize(make_frustum(0, 2, 1, 1));
  EXPECT_EQ(classify(cylinder, {{-1, -1, 2 + 1e-9}, {1, 1, 3}}), Classification::kOutside);
  EXPECT_EQ(classify(cylinder, {{-1, -1, 2 - 1e-9}, {1, 1, 3}}), Classification::kCrosses);
  EXPECT_EQ(classify(cylinder, {{-0.7, -0.7, 1e-9}, {0.7, 0.7, 2 - 1e-9}}),
            Classification::kInside);
  EXPECT_EQ(classify(cylinder, {{-0.7, -0.7, -1e-9}, {0.7, 0.7, 2 - 1e-9}}),
            Classification::kCrosses);
}

TEST(Classification, ApexHasNoSecondNappe) {
  const CanonicalPrimitive cone = canonicalize(make_frustum(0, 1, 1, 0));
  EXPECT_EQ(classify(cone, {{-0.1, -0.1, 1.001}, {0.1, 0.1, 1.2}}), Classification::kOutside);
  EXPECT_EQ(classify(cone, {{-0.1, -0.1, 0.999}, {0.1, 0.1, 1.2}}), Classification::kCrosses);
}

/// Returns how far a point is outside, in units of a side of the local solid, in more than double
/// precision. The map is taken as exact.
Real exact_excess(const Primitive& primitive, const Vec3& point) {
  const Affine& map = primitive.local_to_world;
  const LongVec3 local = glm::inverse(glm::mat<3, 3, Real>(map.linear)) *
                         (LongVec3(point) - LongVec3(map.translation));
  Real excess = -std::numeric_limits<Real>::infinity();
  for (const test_support::Side& side :
       test_support::test_kind_of(primitive.shape()).sides(primitive, local)) {
    excess = std::max(excess, side.outside);
  }
  return excess;
}

/// Tests single points next to the surface, under maps that lose digits: no claim may be due to
/// rounding.
TEST(Classification, RoundingIsAllowedFor) {
  // A polyhedron's vertices, and so its bounds, are those of its half-spaces up to rounding.
  constexpr Real kVertexRounding = 4 * std::numeric_limits<double>::epsilon();
  std::mt19937 random(8);
  int inner = 0, outer = 0;
  for (int round = 0; round < 2000; ++round) {
    Affine map = affine(random);
    for (int axis = 0; axis < 3; ++axis) {
      map.linear[axis] *= std::pow(10.0, checks::uniform(random, -3, 3));
    }
    map.linear[2] += 1e3 * map.linear[0];  // nearly parallel edges
    test_support::Sizes sizes(random, kSizes);
    const Primitive primitive = test_support::random_primitive(sizes, map);
    const CanonicalPrimitive canonical = canonicalize(primitive);
    for (int i = 0; i < 20; ++i) {
      const Vec3 point = checks::surface_point(primitive, random);
      const Real excess = exact_excess(primitive, point);
      const Classification claim = classify(canonical, {point, point});
      inner += excess < -kVertexRounding;
      outer += excess > kVertexRounding;
      if (excess < -kVertexRounding) {
        ASSERT_NE(claim, Classification::kOutside) << excess;
      }
      if (excess > kVertexRounding) {
        ASSERT_NE(claim, Classification::kInside) << excess;
      }
    }
  }
  EXPECT_GT(inner, 5000);
  EXPECT_GT(outer, 5000);
}

/// Far from the origin, far larger than the other axes, far smaller than the cell: claims are never
/// wrong.
TEST(Classification, ExtremeSizes) {
  std::mt19937 random(6);
  for (int round = 0; round < 300; ++round) {
    Affine map = affine(random);
    for (int axis = 0; axis < 3; ++axis) {
      map.linear[axis] *= std::pow(10.0, checks::uniform(random, -5, 5));
    }
    map.translation = 1e12 * checks::random_direction(random);
    test_support::Sizes sizes(random, kSizes);
    const Primitive primitive = test_support::random_primitive(sizes, map);
    if (!is_valid(primitive)) continue;
    const test_support::TestKind& kind = test_support::test_kind_of(primitive.shape());
    const CanonicalPrimitive canonical = canonicalize(primitive);
    for (int i = 0; i < 20; ++i) {
      // A point of the solid, as exact as coordinates of 1e12 allow, and a cell around it.
      const Vec3 surface = kind.surface_point(primitive, random);
      const double share = 0.99 * checks::uniform(random, 0, 1);
      const Vec3 point = map.point(glm::mix(kind.core(primitive, surface), surface, share));
      const double size = std::pow(10.0, checks::uniform(random, -2, 8));
      const Box cell{point - size - 1e-3, point + size + 1e-3};
      ASSERT_NE(classify(canonical, cell), Classification::kOutside);
    }
  }
}

}  // namespace
}  // namespace csgcore
