// Tests lines and points against the Nef oracle's solids: closed forms, degenerate lines, and
// random trees against an evaluation in rationals that knows only half-spaces.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "evaluate_tree.hpp"
#include "full_run.hpp"
#include "nef_scenes.hpp"

namespace oracle {
namespace {

using csgcore::Op;
using csgcore::Ray;
using csgcore::Vec3;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Returns "in 1, out 2" with the exact parameters; "on" means that the line runs in the boundary,
/// and "~" precedes a crossing that is not simple.
std::string text_of(const NefSolid& solid, const Ray& line) {
  std::string text;
  for (const Crossing& crossing : solid.crossings(line)) {
    if (!text.empty()) text += ", ";
    if (!crossing.is_simple) text += "~";
    constexpr const char* kPlaces[] = {"out ", "on ", "in "};
    text += kPlaces[static_cast<int>(crossing.after)];
    text += solid.exact_parameter(line, crossing).get_str();
  }
  return text;
}

TEST(NefLines, OfABox) {
  const auto solid = build(scene_of(Op::kUnion, {box(Vec3(0), Vec3(4, 2, 6))}));
  const Vec3 z(0, 0, 1);
  EXPECT_EQ(text_of(*solid, {Vec3(1, 1, -3), z}), "in 3, out 9");
  EXPECT_EQ(text_of(*solid, {Vec3(1, 1, -3), -3.0 * z}), "in -3, out -1");
  EXPECT_EQ(text_of(*solid, {Vec3(1, 0.5, 0), Vec3(0.5, 0.25, 2)}), "in 0, out 3");
  // The line is in the diagonal plane of the lid's two triangles.
  EXPECT_EQ(text_of(*solid, {Vec3(2, 1, -1), z}), "in 1, out 7");
  EXPECT_EQ(text_of(*solid, {Vec3(5, 1, 0), z}), "");
  EXPECT_EQ(text_of(*solid, {Vec3(1, 1, -3), Vec3(0, 0, 3)}), "in 1, out 3");
  // The crossing is exactly at a third.
  EXPECT_EQ(text_of(*solid, {Vec3(1, 1, -1), Vec3(0, 0.125, 3)}), "in 1/3, out 7/3");
}

TEST(NefLines, ThroughEdgesAndVerticesAndInFaces) {
  const auto solid = build(scene_of(Op::kUnion, {box(Vec3(0), Vec3(4))}));
  const Vec3 z(0, 0, 1);
  EXPECT_EQ(text_of(*solid, {Vec3(0, 1, 2), Vec3(1, 0, 0)}), "in 0, out 4");
  EXPECT_EQ(text_of(*solid, {Vec3(-1, 1, -1), Vec3(1, 0, 1)}), "~in 1, ~out 5");  // two edges
  EXPECT_EQ(text_of(*solid, {Vec3(-1), Vec3(1)}), "~in 1, ~out 5");               // two vertices
  EXPECT_EQ(text_of(*solid, {Vec3(-1, 1, 1), Vec3(1, 0, -1)}), "");               // touches an edge
  EXPECT_EQ(text_of(*solid, {Vec3(1, 0, -1), z}), "~on 1, ~out 5");               // in a face
  EXPECT_EQ(text_of(*solid, {Vec3(0, 0, -1), z}), "~on 1, ~out 5");               // in an edge
  // Lines in a face's plane and beside it; then from a face into the solid.
  EXPECT_EQ(text_of(*solid, {Vec3(5, 0, -1), z}), "");
  const auto step =
      build(scene_of(Op::kUnion, {box(Vec3(0), Vec3(4)), box(Vec3(0, 0, 4), Vec3(8))}));
  EXPECT_EQ(text_of(*step, {Vec3(4, 2, -1), z}), "~on 1, ~in 5, ~out 9");
}

TEST(NefLines, OfSolidsThatTouch) {
  // Two boxes share an edge; four share a vertex.
  const auto edge =
      build(scene_of(Op::kUnion, {box(Vec3(0), Vec3(1)), box(Vec3(1, 1, 0), Vec3(2, 2, 1))}));
  EXPECT_EQ(text_of(*edge, {Vec3(-0.5, -0.5, 0.5), Vec3(1, 1, 0)}), "~in 1/2, ~out 5/2");
  EXPECT_EQ(text_of(*edge, {Vec3(0, 2, 0.5), Vec3(1, -1, 0)}), "");
  EXPECT_EQ(edge->locate(Vec3(1, 1, 0.5)), Place::kBoundary);
  const auto vertex = build(scene_of(Op::kUnion, {box(Vec3(0), Vec3(1)), box(Vec3(1), Vec3(2))}));
  EXPECT_EQ(text_of(*vertex, {Vec3(0), Vec3(1)}), "~in 0, ~out 2");
  // A pyramid stands on its apex.
  const auto apex =
      build(scene_of(Op::kUnion, {box(Vec3(-4, -4, -1), Vec3(4, 4, 0)), frustum(0, 2, 0, 1, 4)}));
  EXPECT_EQ(text_of(*apex, {Vec3(0, 0, -3), Vec3(0, 0, 1)}), "in 2, out 5");
  EXPECT_EQ(apex->volume(), 64 + Rational(4, 3));
}

// The place of a point is found along a line. The first line that is tried here touches a vertex.
TEST(NefLines, LocatePastAVertex) {
  std::minstd_rand random;
  Vec3 first;
  for (int axis = 0; axis < 3; ++axis) first[axis] = 0.25 + static_cast<double>(random()) * 0x1p-31;
  for (int octant = 1; octant < 7; ++octant) {  // all but those that the line runs into or out of
    csgcore::Box corner;
    corner.merge(first);
    Vec3 far;
    for (int axis = 0; axis < 3; ++axis) far[axis] = octant >> axis & 1 ? 2 : -2;
    corner.merge(far);
    const auto solid = build(scene_of(Op::kUnion, {box(corner.min, corner.max)}));
    const Vec3 before = first - Vec3(0.5 * first);
    EXPECT_EQ(solid->locate(before), Place::kOutside) << octant;
    EXPECT_EQ(solid->locate(first), Place::kBoundary) << octant;
  }
}

TEST(NefLines, OfACavity) {
  const NefScene hollow = [] {
    csgcore::CsgTreeBuilder builder;
    builder.open(Op::kDifference);
    builder.primitive(0);
    builder.primitive(1);
    builder.close();
    builder.primitive(2);  // inside, touching nothing
    return NefScene{builder.finish(),
                    {box(Vec3(0), Vec3(10)), box(Vec3(1), Vec3(9)), box(Vec3(4), Vec3(5))}};
  }();
  const auto shell = build(hollow);
  EXPECT_EQ(text_of(*shell, {Vec3(4.5, 4.75, -1), Vec3(0, 0, 1)}),
            "in 1, out 2, in 5, out 6, in 10, out 11");
  EXPECT_EQ(shell->volume(), 1000 - 512 + 1);
  EXPECT_EQ(shell->area(), 600 + 384 + 6);
  EXPECT_EQ(shell->locate(Vec3(2)), Place::kOutside);
  EXPECT_EQ(shell->locate(Vec3(4.5)), Place::kInside);
  EXPECT_EQ(shell->locate(Vec3(0.5)), Place::kInside);
  EXPECT_EQ(shell->locate(Vec3(1)), Place::kBoundary);
}

TEST(NefLines, FirstHit) {
  const auto solid = build(
      scene_of(Op::kDifference, {box(Vec3(0), Vec3(4)), box(Vec3(-1, -1, 1), Vec3(5, 5, 2))}));
  const Ray ray{Vec3(1, 1.5, 0.5), Vec3(0, 0, 1)};  // from inside
  const auto hit = [&](double from) -> double {
    const std::optional<Crossing> crossing = solid->first_hit(ray, from);
    return crossing ? solid->exact_parameter(ray, *crossing).get_d() : kInfinity;
  };
  EXPECT_EQ(hit(-kInfinity), -0.5);
  EXPECT_EQ(hit(-0.5), 0.5);
  EXPECT_EQ(hit(0), 0.5);
  EXPECT_EQ(hit(std::nextafter(0.5, 0)), 0.5);
  EXPECT_EQ(hit(0.5), 1.5);
  EXPECT_EQ(hit(3.5), kInfinity);
  const std::optional<Crossing> leaving = solid->first_hit(ray, 0);
  ASSERT_TRUE(leaving);
  EXPECT_EQ(leaving->after, Place::kOutside);
  EXPECT_EQ(solid->planes()[leaving->plane].unit_normal, Vec3(0, 0, 1));
}

TEST(NefLines, BoundsEncloseTheParameter) {
  const auto solid = build(scene_of(Op::kUnion, {sphere(3, 11)}));
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int i = 0; i < 100; ++i) {
    const Ray ray{Vec3(uniform(random), uniform(random), 100),
                  Vec3(0.001 * uniform(random), 0.001 * uniform(random), -1.0 / 3)};
    for (const Crossing& crossing : solid->crossings(ray)) {
      const Rational s = solid->exact_parameter(ray, crossing);
      EXPECT_LE(Rational(crossing.s_lower), s);
      EXPECT_GE(Rational(crossing.s_upper), s);
      EXPECT_LE(crossing.s_upper - crossing.s_lower, 1e-13 * crossing.s_upper);
      // Only the exact parameter tells on which side of a double within its bounds the crossing is.
      for (double from = crossing.s_lower; from <= crossing.s_upper;
           from = std::nextafter(from, kInfinity)) {
        const std::optional<Crossing> hit = solid->first_hit(ray, from);
        EXPECT_EQ(hit && hit->s_lower == crossing.s_lower, s > from);
      }
    }
  }
}

using RationalVector = std::array<Rational, 3>;

Rational dot(const RationalVector& a, const RationalVector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

RationalVector exact(const Vec3& v) { return {v.x, v.y, v.z}; }

/// Returns M⁻¹·v by Cramer's rule.
RationalVector solve(const csgcore::Mat3& m, const RationalVector& v) {
  const auto determinant = [](const RationalVector& a, const RationalVector& b,
                              const RationalVector& c) -> Rational {
    return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
           a[2] * (b[0] * c[1] - b[1] * c[0]);
  };
  const RationalVector x = exact(m[0]), y = exact(m[1]), z = exact(m[2]);
  const Rational whole = determinant(x, y, z);
  return {determinant(v, y, z) / whole, determinant(x, v, z) / whole, determinant(x, y, v) / whole};
}

/// The part of a line in a polyhedron: enter < s < leave, empty if enter ≥ leave; or it runs in the
/// boundary.
struct Segment {
  Rational enter, leave;
  bool is_in_face = false;
};

Segment segment_of(const FacetedSolid& polyhedron, const Ray& line) {
  RationalVector origin = exact(line.origin);
  for (int i = 0; i < 3; ++i) origin[i] -= polyhedron.local_to_world.translation[i];
  origin = solve(polyhedron.local_to_world.linear, origin);
  const RationalVector direction = solve(polyhedron.local_to_world.linear, exact(line.direction));
  Segment segment{-1000000, 1000000};
  for (const csgcore::HalfSpace& half_space : polyhedron.half_spaces) {
    const RationalVector normal = exact(half_space.normal);
    const Rational room = Rational(half_space.offset) - dot(normal, origin);
    const Rational ascent = dot(normal, direction);
    if (ascent == 0) {
      if (room < 0) return {0, 0};
      segment.is_in_face = segment.is_in_face || room == 0;
    } else {
      const Rational s = room / ascent;
      if (ascent < 0 && s > segment.enter) segment.enter = s;
      if (ascent > 0 && s < segment.leave) segment.leave = s;
    }
  }
  return segment;
}

/// Checks the parts of the line between the crossings of all polyhedra.
void expect_agrees(const NefScene& scene, const NefSolid& solid, const Ray& line,
                   const std::string& name) {
  std::vector<Segment> segments;
  std::vector<Rational> ends;
  for (const FacetedSolid& polyhedron : scene.polyhedra) {
    segments.push_back(segment_of(polyhedron, line));
    if (segments.back().enter >= segments.back().leave) continue;
    ends.push_back(segments.back().enter);
    ends.push_back(segments.back().leave);
  }
  std::sort(ends.begin(), ends.end());
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());

  const std::vector<Crossing> crossings = solid.crossings(line);
  std::vector<Rational> parameters;
  for (const Crossing& crossing : crossings) {
    parameters.push_back(solid.exact_parameter(line, crossing));
    EXPECT_TRUE(std::binary_search(ends.begin(), ends.end(), parameters.back())) << name;
  }
  EXPECT_TRUE(std::is_sorted(parameters.begin(), parameters.end())) << name;
  for (size_t i = 0; i + 1 < ends.size(); ++i) {
    const Rational middle = (ends[i] + ends[i + 1]) / 2;
    const auto covers = [&](uint32_t p) {
      return segments[p].enter < middle && middle < segments[p].leave;
    };
    bool is_in_face = false;
    for (uint32_t p = 0; p < segments.size(); ++p) {
      is_in_face = is_in_face || (covers(p) && segments[p].is_in_face);
    }
    if (is_in_face) continue;  // the line does not tell what the solid is there
    const auto after = std::upper_bound(parameters.begin(), parameters.end(), middle);
    const Place place = after == parameters.begin()
                            ? Place::kOutside
                            : crossings[size_t(after - parameters.begin()) - 1].after;
    EXPECT_EQ(place, test_support::evaluate_tree(scene.tree.tokens(), covers) ? Place::kInside
                                                                              : Place::kOutside)
        << name << " at " << middle.get_d();
  }
}

TEST(NefLines, OfRandomTrees) {
  const uint32_t trees = test_support::full_run() ? 1000 : 25;
  const int lines = 100;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-3, 3);
  size_t hits = 0;
  for (uint32_t seed = 1; seed <= trees; ++seed) {
    const NefScene scene = random_scene(1 + seed % 12, seed).scene;
    const auto solid = build(scene);
    for (int i = 0; i < lines; ++i) {
      Ray line;
      for (int axis = 0; axis < 3; ++axis) {
        line.origin[axis] = uniform(random);
        line.direction[axis] = uniform(random);
      }
      // Half the lines run along an axis or a diagonal through points that shapes share.
      if (i % 2 == 0) {
        for (int axis = 0; axis < 3; ++axis) {
          line.origin[axis] = std::round(line.origin[axis]);
          line.direction[axis] = std::round(line.direction[axis] / 3);
        }
        if (line.direction == Vec3(0)) line.direction.z = 1;
      }
      expect_agrees(scene, *solid, line, "tree " + std::to_string(seed));
      hits += solid->crossings(line).size();
      if (HasFailure()) return;
    }
  }
  EXPECT_GT(hits, trees * lines / 4);  // otherwise the trees are empty
}

}  // namespace
}  // namespace oracle
