// Tests single crossings: their order where doubles cannot tell it, and which of them bound a
// segment.
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>

#include "csgcore/polyhedron.hpp"
#include "exact_primitive.hpp"
#include "near_planes.hpp"
#include "support/kinds/test_kind.hpp"
#include "support/models.hpp"

namespace oracle {
namespace {

using csgcore::make_frustum;
using csgcore::make_sphere;
using csgcore::Mat3;
using csgcore::Polyhedron;
using csgcore::Primitive;
using csgcore::Vec3;

template <class Number>
std::vector<uint32_t> all_planes(const Target<Number>& target) {
  std::vector<uint32_t> planes(target.planes.size());
  std::iota(planes.begin(), planes.end(), 0u);
  return planes;
}

/// A primitive on a ray, which is relative to the world's origin and moved by the parameter 0.
class Met {
 public:
  Met(const Primitive& primitive, const Vec3& origin, const Vec3& direction)
      : target_(make_target(primitive, Vec3(0.0), 1)) {
    NearRay<Exact> ray;
    for (int i = 0; i < 3; ++i) {
      ray.origin[i] = origin[i];
      ray.direction[i] = direction[i];
    }
    local_ = localize(target_, ray, 0);
    ends_ = ends_of(target_, local_, all_planes(target_));
  }

  const std::optional<Ends>& ends() const { return ends_; }
  ExactRoot entry() const { return crossing_of(target_, local_, ends_->begin, true); }
  ExactRoot exit() const { return crossing_of(target_, local_, ends_->end, false); }

 private:
  Target<Exact> target_;
  LocalRay<Exact> local_;
  std::optional<Ends> ends_;
};

const Vec3 kX{1, 0, 0}, kDown{0, 0, -1};

ExactRoot rational(double value) { return quotient(Exact(value), Exact(1)); }

// --- Order ---

/// Convergents p/q of √2 by Pell's numbers, as long as both are doubles: p² − 2q² = ±1, so that p/q
/// is off by 1/(2√2 q²), down to 1e-31.
struct Convergent {
  double p, q;
};
std::vector<Convergent> convergents() {
  std::vector<Convergent> all{{1, 1}};
  while (all.back().p < 0x1p51) {
    const auto [p, q] = all.back();
    all.push_back({p + 2 * q, p + q});
  }
  return all;
}

TEST(ExactOrder, TellsRootsThatAre1e31Apart) {
  bool below = true;  // 1/1 < √2, 3/2 > √2, …
  for (const auto& [p, q] : convergents()) {
    const ExactRoot root{0, q, 2, 1};
    EXPECT_EQ(compare(root, rational(p)), below ? 1 : -1) << p;
    EXPECT_EQ(compare(rational(p), root), below ? -1 : 1) << p;
    EXPECT_EQ(compare({0, -q, 2, 1}, rational(-p)), below ? -1 : 1) << p;
    // Compares √2·q with √(2 + 2⁻¹⁰⁰)·q and with p.
    const Exact more = Exact(2) + Exact(0x1p-100);
    EXPECT_EQ(compare(root, {0, q, more, 1}), -1);
    EXPECT_EQ(compare({p, q, 2, 1}, {p, q, more, 1}), -1);
    EXPECT_EQ(compare({p, -q, 2, 1}, {p, -q, more, 1}), 1);
    below = !below;
  }
  EXPECT_GT(convergents().size(), 40u);
}

TEST(ExactOrder, EqualNumbersOfDifferentRadicands) {
  // 1 + √8 = 1 + 2√2, over different denominators; both are compared with a number that is slightly
  // different.
  const ExactRoot a{1, 1, 8, 1}, b{3, 6, 2, 3}, c{5, 1, 200, 5};
  EXPECT_EQ(compare(a, b), 0);
  EXPECT_EQ(compare(b, c), 0);
  EXPECT_EQ(compare(a, {Exact(1) + Exact(0x1p-200), 1, 8, 1}), -1);
  EXPECT_EQ(compare({Exact(1) + Exact(0x1p-200), 1, 8, 1}, b), 1);
  // The root of a square, and √0.
  EXPECT_EQ(compare({1, 1, 9, 2}, rational(2)), 0);
  EXPECT_EQ(compare({4, 1, 0, 2}, rational(2)), 0);
  EXPECT_EQ(compare({4, -1, 0, 2}, {4, 1, 0, 2}), 0);
  EXPECT_EQ(compare(quotient(Exact(6), Exact(-3)), rational(-2)), 0);
}

TEST(ExactOrder, AWallAndACap1e31Apart) {
  // At half its radius from the axis the ball 1.5q is entered at x = −q√2; a cap is at −p.
  bool below = true;
  for (const auto& [p, q] : convergents()) {
    const Vec3 origin{0, q / 2, 0};
    const Met ball(make_sphere(1.5 * q), origin, kX);
    const Mat3 z_to_x{Vec3{0, 1, 0}, Vec3{0, 0, 1}, Vec3{1, 0, 0}};
    const Met rod(make_frustum(-p, p, 2 * q, 2 * q, {z_to_x, Vec3(0.0)}), origin, kX);
    ASSERT_TRUE(ball.ends() && rod.ends());
    EXPECT_EQ(compare(ball.entry(), rod.entry()), below ? -1 : 1) << p;
    EXPECT_EQ(compare(ball.exit(), rod.exit()), below ? 1 : -1) << p;
    below = !below;
  }
}

TEST(ExactOrder, CapsThatAre2To100Apart) {
  const auto top_at = [](double offset) {
    // The middle's height counts as well: z is 1 + offset, which is not a double.
    const Primitive rod = make_frustum(-1, offset, 2, 2, {Mat3(1.0), {0, 0, 1}});
    return Met(rod, {0.25, 0.5, 7}, {0.1, -0.3, -1}).entry();
  };
  EXPECT_EQ(compare(top_at(0), top_at(0x1p-100)), 1);
  EXPECT_EQ(compare(top_at(-0x1p-100), top_at(0)), 1);
  EXPECT_EQ(compare(top_at(0x1p-100), top_at(0x1p-100)), 0);
}

TEST(ExactOrder, TangentBallsShareACrossing) {
  // By the 3-4-5 triangle, the balls 5 about 0 and 10 about (9, 12, 0) touch in (3, 4, 0), on the
  // ray through both middles, and on no other.
  const Primitive small = make_sphere(5), large = make_sphere(10, {Mat3(1.0), {9, 12, 0}});
  const Vec3 towards{3, 4, 0};
  EXPECT_EQ(
      compare(Met(small, {-6, -8, 0}, towards).exit(), Met(large, {-6, -8, 0}, towards).entry()),
      0);
  const Vec3 origin{-6, -8, 0x1p-200};
  EXPECT_EQ(compare(Met(small, origin, towards).exit(), Met(large, origin, towards).entry()), -1);
}

TEST(ExactOrder, RationalRotationsOfTheSameSolid) {
  // 5 times a rotation by the 3-4-5 triangle about the axis: the cylinder, ball and cone stay the
  // same, with other numbers. The third matrix is off by one in its last digit.
  std::mt19937 random(3);
  std::uniform_real_distribution<double> number(-4, 4);
  const Mat3 turned{Vec3{3, 4, 0}, Vec3{-4, 3, 0}, Vec3{0, 0, 5}};
  Mat3 off = turned;
  off[0][0] = std::nextafter(3.0, 4.0);
  int met = 0, moved = 0;
  for (int i = 0; i < 300; ++i) {
    const Vec3 origin{number(random), number(random), number(random)};
    const Vec3 direction{number(random), number(random), number(random)};
    const auto both = [&](const auto& make) {
      const Met small(make(Mat3(5.0)), origin, direction);
      const Met same(make(turned), origin, direction), other(make(off), origin, direction);
      ASSERT_EQ(small.ends().has_value(), same.ends().has_value());
      if (!small.ends()) return;
      ++met;
      EXPECT_EQ(small.ends()->begin, same.ends()->begin);
      EXPECT_EQ(compare(small.entry(), same.entry()), 0);
      EXPECT_EQ(compare(small.exit(), same.exit()), 0);
      moved += other.ends() && compare(small.exit(), other.exit()) != 0;
    };
    both([](const Mat3& m) { return make_sphere(0.8, {m, {1, 0, 0}}); });
    both([](const Mat3& m) { return make_frustum(-1, 0.5, 0.7, 0.7, {m, {1, 0, 0}}); });
    both([](const Mat3& m) { return make_frustum(-1, 0.5, 0.7, 0, {m, {1, 0, 0}}); });
  }
  EXPECT_GT(met, 300);
  EXPECT_GT(moved, 200);
}

// --- Segments ---

TEST(ExactSegment, TangentsHaveNone) {
  const Primitive ball = make_sphere(5);
  EXPECT_FALSE(Met(ball, {0, 5, 0}, kX).ends());
  EXPECT_TRUE(Met(ball, {0, std::nextafter(5.0, 0.0), 0}, kX).ends());
  EXPECT_FALSE(Met(ball, {3, 4, 0}, {-4, 3, 0}).ends());
  EXPECT_TRUE(Met(ball, {3, 4, 0}, {-4, std::nextafter(3.0, 0.0), 0}).ends());
  const Primitive rod = make_frustum(0, 1, 5, 5);
  EXPECT_FALSE(Met(rod, {3, 4, 0.5}, {-4, 3, 0}).ends());
  // Rays in a cap's plane, and along a generatrix of a cylinder and of a cone, are inside the
  // closed solid.
  EXPECT_TRUE(Met(rod, {-9, 0, 1}, kX).ends());
  EXPECT_FALSE(Met(rod, {-9, 0, std::nextafter(1.0, 2.0)}, kX).ends());
  EXPECT_TRUE(Met(rod, {3, 4, 9}, kDown).ends());
  EXPECT_FALSE(Met(rod, {3, std::nextafter(4.0, 5.0), 9}, kDown).ends());
  const Primitive cone = make_frustum(0, 5, 5, 0);
  EXPECT_TRUE(Met(cone, {3, 4, 0}, {-3, -4, 5}).ends());
  // A ray beside the generatrix, in the plane that touches the cone there.
  EXPECT_FALSE(Met(cone, {3 + 0x1p-49, 4 - 0.75 * 0x1p-49, 0}, {-3, -4, 5}).ends());
}

TEST(ExactSegment, ApexesAndRimsBelongToTheCap) {
  const Primitive cone = make_frustum(0, 5, 5, 0, {Mat3(1.0), {0, 0, 0x1p-80}});
  for (const Vec3 direction : {Vec3(0, 0, -1), Vec3(0.1, 0.3, -1), Vec3(0.125, 0.5, -4)}) {
    const Met met(cone, -direction + Vec3(0, 0, 5), direction);
    // The ray passes 2⁻⁸⁰ below the apex: it misses the cone, unless it is along the axis.
    ASSERT_TRUE(met.ends());
    EXPECT_EQ(met.ends()->begin, direction.x == 0 ? Surface::kTop : Surface::kWall);
    EXPECT_EQ(met.ends()->end, Surface::kBottom);
    const Met through(make_frustum(0, 5, 5, 0), -direction + Vec3(0, 0, 5), direction);
    ASSERT_TRUE(through.ends());
    EXPECT_EQ(through.ends()->begin, Surface::kTop);
    EXPECT_EQ(compare(through.entry(), rational(1)), 0);
  }
  const Met rim(make_frustum(0, 1, 5, 5), {3 + 1, 4, 2}, {-1, 0, -1});
  ASSERT_TRUE(rim.ends());
  EXPECT_EQ(rim.ends()->begin, Surface::kTop);
  // Past the apex there is only the other nappe.
  EXPECT_FALSE(Met(make_frustum(0, 5, 5, 0), {0, 0, 5}, {1, 0, 0.25}).ends());
  EXPECT_FALSE(Met(make_frustum(0, 5, 5, 0), {-1, 0, 6}, {1, 0, 1}).ends());
}

TEST(ExactSegment, IntervalsEncloseWhatIsExact) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> number(-0.4, 0.4);  // inside the unit
  std::vector<Primitive> primitives;
  test_support::Sizes sizes(random, {.low = 1, .high = 4, .most_fragments = 12});
  for (const test_support::Variant& variant : test_support::convex_variants()) {
    for (int i = 0; i < 8; ++i) {
      primitives.push_back(variant.make(sizes));
      primitives.back().local_to_world = test_support::random_affine(random);
    }
  }
  const Vec3 pivot{0.5, 0.25, 0};
  const RoundingUp rounding_up;
  int met = 0, undecided = 0;
  for (const Primitive& primitive : primitives) {
    const Target<Exact> target = make_target(primitive, pivot, 0x1p-4);
    const Target<Interval> enclosed = enclose(target);
    for (int i = 0; i < 50; ++i) {
      NearRay<Exact> ray;
      NearRay<Interval> ray_enclosed;
      for (int axis = 0; axis < 3; ++axis) {
        const double origin = number(random), direction = number(random);
        ray.origin[axis] = origin, ray.direction[axis] = direction;
        ray_enclosed.origin[axis] = origin, ray_enclosed.direction[axis] = direction;
      }
      const double base = base_of(enclosed, ray_enclosed);
      const LocalRay<Exact> local = localize(target, ray, base);
      const LocalRay<Interval> local_enclosed = localize(enclosed, ray_enclosed, base);
      const std::optional<Ends> ends = ends_of(target, local, all_planes(target));
      try {
        const std::optional<Ends> same = ends_of(enclosed, local_enclosed, all_planes(enclosed));
        ASSERT_EQ(same.has_value(), ends.has_value());
        if (!ends) continue;
        ++met;
        ASSERT_EQ(same->begin, ends->begin);
        ASSERT_EQ(same->end, ends->end);
        for (const bool enters : {true, false}) {
          const Surface surface = enters ? ends->begin : ends->end;
          const ExactRoot exact = crossing_of(target, local, surface, enters);
          const Interval loose = crossing_of(enclosed, local_enclosed, surface, enters);
          const Interval tight = enclose_crossing(target, local, enclose(local), surface, enters);
          for (const Interval& interval : {loose, tight}) {
            ASSERT_GE(compare(exact, rational(interval.inf())), 0);
            ASSERT_LE(compare(exact, rational(interval.sup())), 0);
          }
          ASSERT_LE(tight.sup() - tight.inf(), 8 * 0x1p-52 * std::abs(tight.sup()));
        }
      } catch (const Undecided&) {
        ++undecided;
      }
    }
  }
  EXPECT_GT(met, 300);
  EXPECT_LT(undecided, 3);
}

// --- Polyhedra ---

Surface face(uint32_t index) { return Surface(index); }

/// |x|, |y|, |z| ≤ 1: faces +x, −x, +y, −y, +z, −z.
Primitive cube(const csgcore::Affine& map = {}) {
  return csgcore::make_polyhedron(Polyhedron::box({Vec3(-1), Vec3(1)}), map);
}

TEST(ExactPolyhedron, AnEdgeOrAVertexBelongsToTheLowestFace) {
  const Met vertices(cube(), Vec3(-2), Vec3(1));
  ASSERT_TRUE(vertices.ends());
  EXPECT_EQ(vertices.ends()->begin, face(1));
  EXPECT_EQ(vertices.ends()->end, face(0));
  EXPECT_EQ(compare(vertices.entry(), rational(1)), 0);
  EXPECT_EQ(compare(vertices.exit(), rational(3)), 0);
  const Met edges(cube(), {0.25, 2, 2}, {0, -1, -1});
  ASSERT_TRUE(edges.ends());
  EXPECT_EQ(edges.ends()->begin, face(2));
  EXPECT_EQ(edges.ends()->end, face(3));
  // Rays beside the edge, by less than doubles can tell.
  const Met beside(cube({Mat3(1.0), {0, 0, 0x1p-200}}), {0.25, 2, 2}, {0, -1, -1});
  ASSERT_TRUE(beside.ends());
  EXPECT_EQ(beside.ends()->begin, face(2));
  EXPECT_EQ(beside.ends()->end, face(5));
  // Mirrored, and a million times as long.
  const Mat3 long_and_mirrored{Vec3{0, -1e6, 0}, Vec3{-1, 0, 0}, Vec3{0, 0, -1}};
  const Met mapped(cube({long_and_mirrored, Vec3(0.0)}), {-2e-6, -2e6, -2}, {1e-6, 1e6, 1});
  ASSERT_TRUE(mapped.ends());
  EXPECT_EQ(mapped.ends()->begin, face(0));
}

TEST(ExactPolyhedron, WhatTouchesHasNoLength) {
  EXPECT_FALSE(Met(cube(), {0, 2, 0}, {1, -1, 0}).ends());  // an edge
  EXPECT_TRUE(Met(cube(), {0, std::nextafter(2.0, 0.0), 0}, {1, -1, 0}).ends());
  EXPECT_FALSE(Met(cube(), {-1, 3, 1}, {1, -1, 0.5}).ends());  // a vertex
  // Rays in a face, and in an edge, are inside the closed solid.
  EXPECT_TRUE(Met(cube(), {-3, 1, 0}, kX).ends());
  EXPECT_TRUE(Met(cube(), {-3, 1, -1}, kX).ends());
  EXPECT_FALSE(Met(cube(), {-3, std::nextafter(1.0, 2.0), 0}, kX).ends());
  EXPECT_FALSE(Met(cube(), {-3, std::nextafter(1.0, 2.0), -1}, kX).ends());
}

TEST(ExactPolyhedron, AFaceOfItsOwnFrame) {
  // By the 3-4-5 triangle: half of a cube of 10, turned by its matrix, and by its half-spaces'
  // normals. The normals have different lengths, and one half-space goes through the origin.
  const Mat3 turned{Vec3{3, 4, 0}, Vec3{-4, 3, 0}, Vec3{0, 0, 5}};
  std::vector<csgcore::HalfSpace> faces{{{3, 4, 0}, 25},
                                        {{-48, -64, 0}, 16 * 25},
                                        {{-4, 3, 0}, 25},
                                        {{0x4p-30, -0x3p-30, 0}, 0},
                                        {{0, 0, 0x1p100}, 0x5p100},
                                        {{0, 0, -1}, 5}};
  const Primitive in_world = csgcore::make_polyhedron(std::make_shared<Polyhedron>(
      faces, std::vector<Vec3>{Vec3(3, 4, 5), Vec3(-1, 7, -5), Vec3(-7, 1, 5), Vec3(-3, -4, -5)}));
  const Primitive local =
      csgcore::make_polyhedron(Polyhedron::box({Vec3(-1, 0, -1), Vec3(1)}), {turned, Vec3(0.0)});
  std::mt19937 random(9);
  std::uniform_real_distribution<double> number(-6, 6);
  int met = 0;
  for (int i = 0; i < 300; ++i) {
    const Vec3 origin{number(random), number(random), number(random)};
    const Vec3 direction{number(random), number(random), number(random)};
    const Met a(in_world, origin, direction), b(local, origin, direction);
    ASSERT_EQ(a.ends().has_value(), b.ends().has_value());
    if (!a.ends()) continue;
    ++met;
    EXPECT_EQ(a.ends()->begin, b.ends()->begin);
    EXPECT_EQ(a.ends()->end, b.ends()->end);
    EXPECT_EQ(compare(a.entry(), b.entry()), 0);
    EXPECT_EQ(compare(a.exit(), b.exit()), 0);
  }
  EXPECT_GT(met, 100);
}

/// A ray relative to the world's origin, in both arithmetics.
struct BothRays {
  BothRays(const Vec3& origin, const Vec3& direction) {
    for (int i = 0; i < 3; ++i) {
      exact.origin[i] = origin[i], exact.direction[i] = direction[i];
      enclosed.origin[i] = origin[i], enclosed.direction[i] = direction[i];
    }
  }
  NearRay<Exact> exact;
  NearRay<Interval> enclosed;
};

/// A ray through two points of a solid, each the middle of up to four of its vertices (often one,
/// or two neighbours). So it goes through edges and vertices, and along faces, up to rounding.
BothRays special_ray(const Primitive& primitive, std::mt19937& random) {
  const std::vector<Vec3>& vertices = primitive.polyhedron()->vertices();
  const auto point = [&] {
    const size_t count = 1 + random() % 4, first = random() % vertices.size();
    Vec3 sum(0.0);
    for (size_t i = 0; i < count; ++i) sum += vertices[(first + i) % vertices.size()];
    return primitive.local_to_world.point(sum / double(count));
  };
  const Vec3 from = point(), to = point();
  const Vec3 along = from == to ? primitive.local_to_world.linear[random() % 3] : to - from;
  return {from - 2.0 * along, along};
}

TEST(ExactPolyhedron, PlanesThatAreNearAreAllThatBoundARay) {
  std::mt19937 random(11);
  std::vector<std::shared_ptr<const Polyhedron>> solids;
  for (const int fragments : {3, 4, 6, 7, 30}) {
    solids.push_back(Polyhedron::sphere(0.3, fragments));
    solids.push_back(Polyhedron::frustum(-0.2, 0.3, 0.4, 0.1, fragments));
    solids.push_back(Polyhedron::frustum(-0.2, 0.3, 0.3, 0.3, fragments));
  }
  solids.push_back(Polyhedron::box({Vec3(-0.3, -0.4, 0), Vec3(0.5, 0.1, 1e-9)}));
  const RoundingUp rounding_up;
  int met = 0, missed = 0;
  size_t near = 0, all = 0;
  for (const auto& solid : solids) {
    for (int map = 0; map < 4; ++map) {
      const csgcore::Affine place =
          map == 0 ? csgcore::Affine{} : test_support::random_affine(random);
      const Primitive primitive = csgcore::make_polyhedron(solid, place);
      const Target<Exact> target = make_target(primitive, Vec3(0.0), 1);
      const Target<Interval> enclosed = enclose(target);
      for (int i = 0; i < 60; ++i) {
        const BothRays ray = special_ray(primitive, random);
        const double base = base_of(enclosed, ray.enclosed);
        const LocalRay<Exact> local = localize(target, ray.exact, base);
        const std::optional<Ends> ends = ends_of(target, local, all_planes(target));
        NearPlanes planes;
        const bool may_meet = planes.find(enclosed, localize(enclosed, ray.enclosed, base));
        missed += !ends;
        if (!may_meet) {
          ASSERT_FALSE(ends);
          continue;
        }
        const std::optional<Ends> same = ends_of(target, local, planes.planes());
        ASSERT_EQ(same.has_value(), ends.has_value());
        if (!ends) continue;
        ++met;
        ASSERT_EQ(same->begin, ends->begin);
        ASSERT_EQ(same->end, ends->end);
        near += planes.planes().size();
        all += target.planes.size();
      }
    }
  }
  EXPECT_GT(met, 2000);
  EXPECT_GT(missed, 50);
  EXPECT_LT(near, all / 10);
}

}  // namespace
}  // namespace oracle
