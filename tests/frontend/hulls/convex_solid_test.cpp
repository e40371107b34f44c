// The hulls of points, balls and discs, and their sums, against support functions.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <iostream>
#include <random>

#include "hulls/generator.hpp"
#include "hulls/hull_support.hpp"
#include "hulls/orthonormal.hpp"
#include "support/full_run.hpp"

namespace frontend {
namespace {

using csgcore::Affine;
using csgcore::Mat3;
using csgcore::Vec3;
using test_support::full_run;

/// What is outside, or missing, as a share of the size.
constexpr double kTolerance = 1e-12;

class Random {
 public:
  explicit Random(uint32_t seed) : engine_(seed) {}

  double number(double from, double to) {
    return std::uniform_real_distribution<double>(from, to)(engine_);
  }
  int whole(int from, int to) { return std::uniform_int_distribution<int>(from, to)(engine_); }
  bool coin() { return whole(0, 1) == 1; }
  Vec3 point(double size) {
    return {number(-size, size), number(-size, size), number(-size, size)};
  }
  Vec3 direction() {
    std::normal_distribution<double> normal;
    while (true) {
      const Vec3 v(normal(engine_), normal(engine_), normal(engine_));
      if (glm::length(v) > 0.1) return glm::normalize(v);
    }
  }
  Vec3 grid_point(int size) {
    return Vec3(whole(-size, size), whole(-size, size), whole(-size, size));
  }

 private:
  std::mt19937 engine_;
};

Generator at(const Vec3& center) {
  Generator generator;
  generator.center = center;
  return generator;
}

Generator ball(const Vec3& center, double radius) {
  Generator generator = at(center);
  generator.ball = Mat3(radius);
  return generator;
}

Generator disc(const Vec3& center, const Vec3& normal, double radius, double ball_radius = 0) {
  Generator generator = ball(center, ball_radius);
  const Axes axes = axes_along(normal);
  generator.disc_a = radius * axes.x;
  generator.disc_b = radius * axes.y;
  return generator;
}

Generators with_grid_points(Random& random, Generators generators) {
  for (int i = random.whole(0, 6); i > 0; --i) generators.push_back(at(random.grid_point(4)));
  return generators;
}

Generators random_points(Random& random) {
  Generators result;
  const bool is_grid = random.coin();
  for (int i = random.whole(4, 40); i > 0; --i) {
    result.push_back(at(is_grid ? random.grid_point(2) : random.point(3)));
  }
  return result;
}

Generators random_balls(Random& random) {
  Generators result;
  const bool is_grid = random.coin();
  const bool is_equal = random.coin();
  for (int i = random.whole(1, 12); i > 0; --i) {
    const Vec3 center = is_grid ? random.grid_point(2) : random.point(3);
    const double radius = is_equal ? 0.5 : is_grid ? 0.5 * random.whole(1, 4) : random.number(0, 2);
    result.push_back(ball(center, radius));
  }
  return with_grid_points(random, result);
}

/// Of one axis, which may be the z axis.
Generators random_discs(Random& random) {
  Generators result;
  const bool is_grid = random.coin();
  const bool is_equal = random.coin();
  const Vec3 normal = random.coin() ? Vec3(0, 0, 1) : random.direction();
  for (int i = random.whole(1, 6); i > 0; --i) {
    const Vec3 center = is_grid ? random.grid_point(2) : random.point(3);
    const double height = is_grid ? random.whole(1, 3) : random.number(0.1, 3);
    const double radius = is_equal ? 0.5 : is_grid ? 0.5 * random.whole(0, 4) : random.number(0, 2);
    result.push_back(disc(center, normal, radius));
    result.push_back(disc(center + height * normal, normal, is_equal ? 0.5 : random.number(0, 2)));
  }
  return with_grid_points(random, result);
}

/// A body of revolution, with rounded rims.
Generators random_coaxial(Random& random) {
  Generators result;
  const Vec3 normal = random.coin() ? Vec3(0, 0, 1) : random.direction();
  const Vec3 center = random.point(2);
  for (int i = random.whole(1, 4); i > 0; --i) {
    const double radius = random.coin() ? random.number(0.1, 2) : 0;
    result.push_back(disc(center + random.number(-3, 3) * normal, normal, radius,
                          random.coin() ? random.number(0.1, 1) : 0));
  }
  result.push_back(disc(center, normal, 1));
  result.push_back(disc(center + normal, normal, 1));
  return result;
}

Affine random_matrix(Random& random) {
  while (true) {
    const Affine map{Mat3(random.point(1), random.point(1), random.point(1)), random.point(2)};
    if (std::abs(map.determinant()) > 0.1) return map;
  }
}

Generators sum(const Generators& a, const Generators& b) {
  const auto result = minkowski_sum(a, b);
  EXPECT_TRUE(result && !result->is_faceted);
  return result ? result->generators : Generators{};
}

/// A point of the hull, often near its surface.
Vec3 random_point_of(const Generators& generators, Random& random) {
  const Vec3 direction = random.direction();
  const bool is_near_surface = random.coin();
  Vec3 sum(0.0);
  double weights = 0;
  for (int i = 0; i < 4; ++i) {
    const Vec3 along = is_near_surface ? direction + 0.2 * random.direction() : random.direction();
    const Generator* best = nullptr;
    double most = 0;
    for (const Generator& generator : generators) {
      const double reach = glm::dot(along, hull_test::furthest(generator, along));
      if (best != nullptr && reach <= most) continue;
      best = &generator;
      most = reach;
    }
    const double weight = random.number(0, 1);
    sum += weight * hull_test::furthest(*best, along);
    weights += weight;
  }
  return sum / weights;
}

struct Worst {
  double outside = 0, missing = 0;  // of support functions, as shares of the size
  int gaps = 0;                     // points of the hull in no piece
};

Worst compare(const Generators& generators, const ConvexSolid& solid, int directions,
              Random& random) {
  Worst worst;
  const double size = hull_test::size_of(generators);
  for (int i = 0; i < directions; ++i) {
    const Vec3 u = random.direction();
    const double wanted = hull_test::support(generators, u);
    const double got = hull_test::support(solid.pieces, u);
    worst.outside = std::max(worst.outside, (got - wanted) / size);
    worst.missing = std::max(worst.missing, (wanted - got) / size);
    const Vec3 point = random_point_of(generators, random);
    const bool is_held =
        std::any_of(solid.pieces.begin(), solid.pieces.end(), [&](const csgcore::Primitive& piece) {
          return hull_test::contains(piece, point, kTolerance * size);
        });
    worst.gaps += !is_held;
  }
  return worst;
}

struct Family {
  const char* name;
  std::function<Generators(Random&)> make;
};

const std::vector<Family>& families() {
  static const std::vector<Family> all{
      {"points", random_points},
      {"balls and points", random_balls},
      {"parallel discs and points", random_discs},
      {"coaxial discs and balls", random_coaxial},
      {"ellipsoids of one shape",
       [](Random& random) {
         Generators result = random_balls(random);
         map_all(random_matrix(random), result);
         return result;
       }},
      {"affine discs",
       [](Random& random) {
         Generators result = random_discs(random);
         map_all(random_matrix(random), result);
         return result;
       }},
      {"points plus a ball",
       [](Random& random) { return sum(random_points(random), {ball(random.point(1), 0.5)}); }},
      {"points plus a cylinder",
       [](Random& random) {
         return sum(random_points(random), {disc(Vec3(0.0), Vec3(0, 0, 1), 0.5),
                                            disc(Vec3(0, 0, 1), Vec3(0, 0, 1), 0.25)});
       }},
      {"points plus points",
       [](Random& random) { return sum(random_points(random), random_points(random)); }},
      {"balls plus balls",
       [](Random& random) {
         return sum(random_balls(random), {ball(random.point(1), 0.5), ball(random.point(1), 0.2)});
       }},
      {"a prism of upright discs plus a ball",
       [](Random& random) {
         Generators prism;
         for (int i = random.whole(1, 6); i > 0; --i) {
           const Vec3 center = random.coin() ? random.grid_point(2) : random.point(2);
           const double radius = random.coin() ? 0.5 : random.number(0, 1);
           for (const double z : {0, 2}) {
             prism.push_back(disc(Vec3(center.x, center.y, z), Vec3(0, 0, 1), radius));
           }
         }
         prism.push_back(disc(Vec3(0.0), Vec3(0, 0, 1), 1));
         prism.push_back(disc(Vec3(0, 0, 2), Vec3(0, 0, 1), 1));
         return sum(prism, {ball(Vec3(0.0), 0.25)});
       }},
  };
  return all;
}

TEST(ConvexSolid, IsTheHullByItsSupportFunction) {
  const int sets = full_run() ? 60 : 12;
  const int directions = full_run() ? 2000 : 300;
  std::cout << families().size() * static_cast<size_t>(sets) << " sets, " << directions
            << " directions each\n";
  for (const Family& family : families()) {
    Worst worst;
    size_t pieces = 0;
    for (int i = 0; i < sets; ++i) {
      Random random(static_cast<uint32_t>(i));
      const Generators generators = family.make(random);
      const ConvexSolid solid = convex_solid(generators);
      EXPECT_FALSE(solid.is_faceted) << family.name << ", seed " << i;
      ASSERT_FALSE(solid.pieces.empty()) << family.name << ", seed " << i;
      pieces += solid.pieces.size();
      const Worst here = compare(generators, solid, directions, random);
      EXPECT_LE(here.outside, kTolerance) << family.name << ", seed " << i;
      EXPECT_LE(here.missing, kTolerance) << family.name << ", seed " << i;
      EXPECT_EQ(here.gaps, 0) << family.name << ", seed " << i;
      worst.outside = std::max(worst.outside, here.outside);
      worst.missing = std::max(worst.missing, here.missing);
    }
    std::cout << family.name << ": outside " << worst.outside << ", missing " << worst.missing
              << ", pieces " << pieces / static_cast<size_t>(sets) << '\n';
  }
}

/// The facets lie within the hull, and are fine.
void expect_fine_facets(const Generators& generators, double sagitta) {
  const ConvexSolid solid = convex_solid(generators);
  EXPECT_TRUE(solid.is_faceted);
  Random random(1);
  const Worst worst = compare(generators, solid, 500, random);
  EXPECT_LE(worst.outside, kTolerance);
  EXPECT_LE(worst.missing, sagitta);
  EXPECT_GT(worst.missing, 0);
}

TEST(ConvexSolid, HasFineFacetsWhereNoFormIsExact) {
  const Vec3 up(0, 0, 1), along(1, 0, 0);
  expect_fine_facets({disc(Vec3(0.0), up, 2), disc(Vec3(0, 0, 1), up, 2), ball(Vec3(6, 0, 0), 1)},
                     1e-4);
  expect_fine_facets({disc(Vec3(0.0), up, 2), disc(Vec3(0, 0, 1), up, 2),
                      disc(Vec3(6, 0, 0), along, 1), disc(Vec3(7, 0, 0), along, 1)},
                     1e-4);
  Generator ellipsoid = ball(Vec3(5, 0, 0), 1);
  ellipsoid.ball[0].x = 3;
  expect_fine_facets({ellipsoid, ball(Vec3(0.0), 2)}, 1e-3);
  const auto sum = minkowski_sum({ellipsoid}, {disc(Vec3(0.0), up, 1), at(Vec3(0, 0, 3))});
  ASSERT_TRUE(sum);
  EXPECT_TRUE(sum->is_faceted);
}

TEST(ConvexSolid, HasNoMoreTangentPiecesThanThereAreTangents) {
  // Eight equal balls at the corners of a box: the box's three slabs, its edges and its corners.
  Generators corners;
  for (int i = 0; i < 8; ++i) corners.push_back(ball(Vec3(i & 1, i & 2, i & 4), 0.5));
  EXPECT_EQ(convex_solid(corners).pieces.size(), 1u + 12u + 8u);
  // A ball within another, and one within the hull of others, have no part in it.
  EXPECT_EQ(convex_solid({ball(Vec3(0.0), 2), ball(Vec3(1, 0, 0), 0.5)}).pieces.size(), 1u);
  EXPECT_EQ(convex_solid({ball(Vec3(0.0), 2), ball(Vec3(9, 0, 0), 2), ball(Vec3(5, 0, 0), 1)})
                .pieces.size(),
            3u);
}

TEST(ConvexSolid, OfManyRoundBodiesIsThatOfTheOuterOnes) {
  Random random(1);
  Generators many;
  for (int i = 0; i < 3000; ++i) many.push_back(ball(random.point(10), random.number(0.1, 1)));
  for (int i = 0; i < 3000; ++i) {
    many.push_back(disc(random.point(1), Vec3(0, 0, 1), random.number(0.1, 1)));
  }
  const Generators balls(many.begin(), many.begin() + 3000);
  const Generators discs(many.begin() + 3000, many.end());
  for (const Generators& generators : {balls, discs}) {
    const ConvexSolid solid = convex_solid(generators);
    EXPECT_FALSE(solid.is_faceted);
    EXPECT_LT(solid.pieces.size(), 2000u);
    const double size = hull_test::size_of(generators);
    for (int i = 0; i < 200; ++i) {
      const Vec3 u = random.direction();
      EXPECT_NEAR(hull_test::support(solid.pieces, u), hull_test::support(generators, u),
                  kTolerance * size);
    }
  }
}

TEST(ConvexSolid, HasFacetsWhereTheSearchForItsPiecesWouldTakeLong) {
  // Discs of a cone, which all touch its side: each pair has to be compared with all others.
  Generators cone;
  for (int i = 0; i < 1000; ++i) {
    cone.push_back(disc(Vec3(i * 0.1, 0, 0.5 * (i % 2)), Vec3(0, 0, 1), 1 + i * 0.001));
  }
  const ConvexSolid solid = convex_solid(cone);
  EXPECT_TRUE(solid.is_faceted);
  EXPECT_EQ(solid.pieces.size(), 1u);
  const double size = hull_test::size_of(cone);
  EXPECT_NEAR(hull_test::support(solid.pieces, Vec3(1, 0, 0)),
              hull_test::support(cone, Vec3(1, 0, 0)), 1e-3 * size);
}

}  // namespace
}  // namespace frontend
