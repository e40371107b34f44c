// Tests the answers of the exact ray oracle: hits, eyes, thicknesses, doubts.
#include "oracle/exact_rays.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "csgcore/polyhedron.hpp"
#include "support/reference_test_scenes.hpp"

namespace oracle {
namespace {

using csgcore::Mat3;
using csgcore::Op;
using csgcore::Polyhedron;
using csgcore::Primitive;
using csgcore::Projection;
using csgcore::Ray;
using csgcore::Scene;
using csgcore::Vec3;
using csgcore::reference_test::ball;
using csgcore::reference_test::rod;
using csgcore::reference_test::scene_of;

constexpr Projection kWholeLine = Projection::kOrthographic, kFromEye = Projection::kPerspective;

ExactHit hit_of(const Scene& scene, const Ray& ray, Projection projection = kWholeLine) {
  return ExactRays(ExactScene(scene)).first_hit(ray, projection);
}

Doubt doubt_of(const Scene& scene, const Ray& ray, Projection projection = kWholeLine) {
  return ExactRays(ExactScene(scene)).doubt(ray, projection);
}

double next(double x) { return std::nextafter(x, std::numeric_limits<double>::infinity()); }

const Ray kDown{{0, 0, 10}, {0, 0, -1}};

// --- Hits ---

TEST(ExactRays, HitsWhatIsThere) {
  const Scene scene = scene_of(Op::kDifference, {ball(2), ball(1, {0, 0, 2})});
  const ExactHit cut = hit_of(scene, kDown);
  EXPECT_EQ(cut.primitive, 1u);
  EXPECT_EQ(cut.s.lower, 9);  // a double, so that the interval is a point
  EXPECT_EQ(cut.s.upper, 9);
  EXPECT_EQ(cut.position, Vec3(0, 0, 1));
  EXPECT_EQ(cut.normal, Vec3(0, 0, 1));  // out of the solid: into the cut
  const ExactHit wall = hit_of(scene, {{1.5, 0, 10}, {0, 0, -2}});
  EXPECT_EQ(wall.primitive, 0u);
  EXPECT_NEAR(wall.s.lower, (10 - std::sqrt(1.75)) / 2, 1e-15);
  EXPECT_EQ(wall.s.upper, next(wall.s.lower));
  EXPECT_NEAR(wall.position.z, std::sqrt(1.75), 1e-15);
  EXPECT_NEAR(glm::length(wall.normal - Vec3(0.75, 0, std::sqrt(1.75) / 2)), 0, 1e-15);
  EXPECT_FALSE(hit_of(scene, {{2.5, 0, 10}, {0, 0, -1}}).hit());
  EXPECT_EQ(hit_of(scene, {{2.5, 0, 10}, {0, 0, -1}}).s.lower,
            std::numeric_limits<double>::infinity());
  EXPECT_FALSE(hit_of(Scene{}, kDown).hit());
}

TEST(ExactRays, ParametersAreTightToTheLastPlace) {
  // The ball 1.5q is entered at −q√2, half its radius from the axis. That is within 1/(2√2 q) of −p
  // where p² − 2q² = ±1: next to p, on the side that only 100 digits of mantissa tell.
  double p = 1, q = 1;
  for (int sign = -1; p < 0x1p50; sign = -sign) {  // of p² − 2q²
    const ExactHit hit = hit_of(scene_of(Op::kUnion, {ball(1.5 * q)}), {{0, q / 2, 0}, {1, 0, 0}});
    if (p > 0x1p30) {
      const double least = -p, up = next(-p), down = -next(p);
      EXPECT_EQ(hit.s.lower, sign > 0 ? least : down) << p;
      EXPECT_EQ(hit.s.upper, sign > 0 ? up : least) << p;
    }
    const double sum = p + q;
    p = sum + q;
    q = sum;
  }
}

TEST(ExactRays, FarEyesAndFarModels) {
  // From 2⁴⁰ away, at a model as far from the origin, s and the position are exact.
  const Vec3 far{0x1p40, -0x1p41, 0x1p42};
  const Scene scene = scene_of(Op::kUnion, {ball(0.5, far), rod(0, 1, 0.25, far)});
  const ExactHit hit = hit_of(scene, {far + Vec3(0.125, 0, 0x1p40), {0, 0, -1}}, kFromEye);
  EXPECT_EQ(hit.primitive, 1u);
  EXPECT_EQ(hit.s.lower, 0x1p40 - 1);
  EXPECT_EQ(hit.s.upper, 0x1p40 - 1);
  EXPECT_EQ(hit.position, far + Vec3(0.125, 0, 1));
  const ExactScene prepared(scene);
  EXPECT_GT(prepared.size(), 1.5);
  EXPECT_LT(prepared.size(), 2.5);
}

TEST(ExactRays, LengthsWhoseSquaresNoDoubleHolds) {
  for (const double unit : {1e-150, 1e-60, 1.0, 1e60, 1e100}) {
    const Scene scene =
        scene_of(Op::kDifference, {ball(2 * unit), rod(-unit, 9 * unit, unit, {0, 0, 0})});
    const ExactHit hit = hit_of(scene, {{0.5 * unit, 0, 10 * unit}, {0, 0, -1}});
    EXPECT_EQ(hit.primitive, 1u) << unit;
    EXPECT_NEAR(hit.s.lower / unit, 11, 1e-14);
    EXPECT_EQ(hit.normal, Vec3(0, 0, 1));
    EXPECT_NEAR(hit_of(scene, {{1.5 * unit, 0, 10 * unit}, {0, 0, -1}}).position.z / unit,
                std::sqrt(1.75), 1e-14);
  }
}

Primitive block(const Vec3& min, const Vec3& max, const csgcore::Affine& map = {}) {
  return csgcore::make_polyhedron(Polyhedron::box({min, max}), map);
}

TEST(ExactRays, FacesOfPolyhedra) {
  const Scene scene =
      scene_of(Op::kDifference,
               {block(Vec3(-2), Vec3(2)), block({-1, -1, 0.5}, {1, 1, 2}), rod(-3, 3, 0.25)});
  const ExactHit floor = hit_of(scene, {{0.5, 0.5, 10}, {0, 0, -1}});
  EXPECT_EQ(floor.primitive, 1u);  // flush with the top, which is open
  EXPECT_EQ(floor.s.lower, 9.5);
  EXPECT_EQ(floor.s.upper, 9.5);
  EXPECT_EQ(floor.position, Vec3(0.5, 0.5, 0.5));
  EXPECT_EQ(floor.normal, Vec3(0, 0, 1));
  EXPECT_EQ(hit_of(scene, {{1.5, 0.5, 10}, {0, 0, -1}}).s.lower, 8);
  EXPECT_FALSE(hit_of(scene, {{0.125, 0.125, 10}, {0, 0, -1}}).hit());
  const ExactHit side = hit_of(scene, {{0, 9, -1}, {0, -1, 0}});
  EXPECT_EQ(side.primitive, 0u);
  EXPECT_EQ(side.normal, Vec3(0, 1, 0));
  EXPECT_DOUBLE_EQ(ExactScene(scene).size(), 4 * std::sqrt(3));
  // A hexagonal prism: its corners at 0°, 60°, …; the face between the first two looks at 30°.
  const Scene prism = scene_of(
      Op::kUnion,
      {csgcore::make_polyhedron(Polyhedron::frustum(0, 1, 2, 2, 6), {Mat3(1.0), {0.1, 0.2, 0.3}})});
  const Vec3 outward{std::sqrt(0.75), 0.5, 0};
  const ExactHit face = hit_of(prism, {Vec3(0.1, 0.2, 0.7) + 5.0 * outward, -outward});
  EXPECT_NEAR(face.s.lower, 5 - std::sqrt(3), 2e-15);
  EXPECT_NEAR(glm::length(face.normal - outward), 0, 1e-15);
}

TEST(ExactRays, AnEdgeIsOfTheLowestFace) {
  const Scene scene = scene_of(Op::kUnion, {block(Vec3(-1), Vec3(1))});
  EXPECT_EQ(hit_of(scene, {Vec3(3), Vec3(-1)}).normal, Vec3(1, 0, 0));
  EXPECT_EQ(hit_of(scene, {{0, 3, 3}, {0, -1, -1}}).normal, Vec3(0, 1, 0));
  EXPECT_EQ(hit_of(scene, {{0, -3, -3}, {0, 1, 1}}).normal, Vec3(0, -1, 0));
}

// --- Crossings that are equal ---

TEST(ExactRays, TangentBallsAndEqualCaps) {
  // Through the point where two balls touch, the ray passes from one into the other.
  const Scene tangent = scene_of(Op::kUnion, {ball(5), ball(10, {9, 12, 0})});
  const Ray along{{-6, -8, 0}, {3, 4, 0}};
  EXPECT_EQ(hit_of(tangent, along).s.lower, 1);
  EXPECT_EQ(hit_of(tangent, {{0, 0, 0}, {3, 4, 0}}, kFromEye).s.lower, 5);  // out of the larger
                                                                            // ball
  // A flush hole is open; a shared face leaves no skin.
  const Scene flush = scene_of(Op::kDifference, {rod(0, 2, 5), rod(0, 2, 3)});
  EXPECT_FALSE(hit_of(flush, {{1, 1, 9}, {0, 0, -1}}).hit());
  const Scene stacked = scene_of(Op::kUnion, {rod(0, 1, 5), rod(1, 2, 5)});
  EXPECT_EQ(hit_of(stacked, {{1, 1, 1.5}, {0, 0, -1}}, kFromEye).s.lower, 1.5);
  // Two cones tip to tip, on their common axis.
  const Scene tips =
      scene_of(Op::kUnion, {csgcore::make_frustum(0, 4, 0, 3), csgcore::make_frustum(-4, 0, 3, 0)});
  EXPECT_EQ(hit_of(tips, {{0, 0, 2}, {0, 0, -1}}, kFromEye).s.lower, 6);
}

TEST(ExactRays, APrimitiveThatIsBothAddedAndCut) {
  // (0 − 1) ∪ (1 − 2): what 1 cuts out of 0, it fills in part.
  const Scene scene =
      scene_of({rod(0, 10, 5), rod(4, 6, 9), rod(5, 7, 9)}, [](csgcore::CsgTreeBuilder& builder) {
        builder.open(Op::kUnion);
        builder.open(Op::kDifference);
        builder.primitive(0);
        builder.primitive(1);
        builder.close();
        builder.open(Op::kDifference);
        builder.primitive(1);
        builder.primitive(2);
        builder.close();
        builder.close();
      });
  const auto up_from = [&](double x, double z) {
    return hit_of(scene, {{x, 0, z}, {0, 0, 1}}, kFromEye);
  };
  EXPECT_EQ(up_from(0, -1).primitive, 0u);
  const ExactHit cut = up_from(0, 5.5), added = up_from(8, 0), inside = up_from(0, 4.5);
  EXPECT_EQ(cut.primitive, 1u);
  EXPECT_EQ(cut.s.lower, 0.5);
  EXPECT_EQ(cut.normal, Vec3(0, 0, -1));
  EXPECT_EQ(added.primitive, 1u);
  EXPECT_EQ(added.s.lower, 4);
  EXPECT_EQ(added.normal, Vec3(0, 0, -1));
  EXPECT_EQ(inside.primitive, 2u);
  EXPECT_EQ(inside.s.lower, 0.5);
  EXPECT_EQ(inside.normal, Vec3(0, 0, 1));  // out of the solid: into the gap
}

// --- The eye and τ ---

/// Blocks that reach from x = z + offset to 8, for an eye at the origin that looks along x. z +
/// offset is exact, however small the offset is. Two balls fix the box.
Scene block_from(double z, double offset) {
  const Mat3 z_to_x{Vec3{0, 1, 0}, Vec3{0, 0, 1}, Vec3{1, 0, 0}};
  return scene_of(Op::kUnion, {ball(1, {-20, 9, 9}), ball(1, {20, -9, -9}),
                               csgcore::make_frustum(offset, 8, 4, 4, {z_to_x, {z, 0, 0}})});
}

TEST(ExactRays, TheEyeIsDecidedByTheLastBit) {
  const double tolerance = ExactScene(block_from(1, 0)).thickness();
  const Ray ray{{0, 0, 0}, {1, 0, 0}};
  const auto first_s = [&](double offset) {
    const Scene scene = block_from(tolerance, offset);
    EXPECT_EQ(ExactScene(scene).thickness(), tolerance);
    return hit_of(scene, ray, kFromEye).s;
  };
  EXPECT_NEAR(first_s(0).lower, 8, 1e-6);  // at τ the block is behind the eye, which is inside
  EXPECT_NEAR(first_s(-0x1p-130).lower, 8, 1e-6);
  EXPECT_EQ(first_s(0x1p-130).lower, tolerance);
  EXPECT_EQ(first_s(0x1p-130).upper, next(tolerance));
  // Without an eye nothing is behind it.
  EXPECT_EQ(hit_of(block_from(tolerance, 0), ray, kWholeLine).s.upper, tolerance);
}

TEST(ExactRays, WallsOfToleranceAreThereOrNot) {
  // A lid over a cavity, seen from above, and leaning by 60°: thickness is measured along the
  // normal.
  const double size = ExactScene(scene_of(Op::kUnion, {rod(-1, 1, 1)})).size();
  EXPECT_NEAR(size, std::sqrt(12.0), 1e-15);
  const double tolerance = 1e-9 * size;
  for (const Vec3 direction : {Vec3(0, 0, -1), Vec3(1e-9, 0, -1), Vec3(1.7320508, 0, -1)}) {
    const Ray ray{Vec3(0.1, 0, 1) - direction, direction};
    const auto lid = [&](double in_tolerances) {
      const Scene scene =
          scene_of(Op::kDifference, {rod(-1, 1, 1), rod(-2, 1 - in_tolerances * tolerance, 0.9)});
      return hit_of(scene, ray).primitive;
    };
    EXPECT_EQ(lid(1.00001), 0u);
    EXPECT_NE(lid(0.99999), 0u);
  }
}

TEST(ExactRays, TheOrderOfCrossings1e31ApartDecides) {
  // Two sheets of 0.7 τ each, one on the other, over a gap and a block. If they overlap by 2⁻¹⁰⁰
  // they are one, thicker than τ, and the lower one is entered near its face and not left there. If
  // they are 2⁻¹⁰⁰ apart, all four faces are one coincidence.
  const double tolerance = ExactScene(scene_of(Op::kUnion, {rod(-1, 1, 1)})).thickness();
  const double seam = 1 - 0.7 * tolerance;
  const auto first = [&](double gap, bool upper_first) {
    const Primitive block = rod(-1, 0, 1), upper = rod(seam, 1, 1);
    const Primitive lower = rod(-0.7 * tolerance, -gap, 1, {0, 0, seam});
    const Scene scene = upper_first ? scene_of(Op::kUnion, {upper, lower, block})
                                    : scene_of(Op::kUnion, {lower, upper, block});
    return hit_of(scene, {{0.25, 0.25, 3}, {0, 0, -1}}).primitive;
  };
  for (const bool upper_first : {true, false}) {
    EXPECT_EQ(first(-0x1p-100, upper_first), upper_first ? 1u : 0u);
    EXPECT_EQ(first(0x1p-100, upper_first), 2u);
  }
}

TEST(ExactRays, LikePrimitivesThatAreALastBitApart) {
  // A skin of 1.4 τ, and halfway through it 1 − 2, two equal rods or boxes of one frame, of which
  // one is 2⁻⁶⁰ higher. If 1 is higher, the gap between them makes one coincidence of the skin.
  const Primitive aside = ball(1, {3, 3, -3});
  const double tolerance =
      ExactScene(scene_of(Op::kUnion, {rod(-1e-9, 1e-9, 1), aside})).thickness();
  const auto is_whole = [&](const Primitive& higher, const Primitive& lower) {
    const Scene scene = scene_of({rod(-0.7 * tolerance, 0.7 * tolerance, 1), higher, lower, aside},
                                 [](csgcore::CsgTreeBuilder& builder) {
                                   builder.open(Op::kUnion);
                                   builder.open(Op::kDifference);
                                   builder.primitive(0);
                                   builder.open(Op::kDifference);
                                   builder.primitive(1);
                                   builder.primitive(2);
                                   builder.close();
                                   builder.close();
                                   builder.primitive(3);
                                   builder.close();
                                 });
    return hit_of(scene, {{0.25, 0.25, 3}, {0, 0, -1}}).hit();
  };
  const auto rod_at = [](double height) { return rod(-10, 0, 2, {0, 0, height}); };
  const auto block_to = [](double height) { return block({-2, -2, -10}, {2, 2, height}); };
  EXPECT_FALSE(is_whole(rod_at(0x1p-60), rod_at(0)));
  EXPECT_TRUE(is_whole(rod_at(-0x1p-60), rod_at(0)));
  EXPECT_FALSE(is_whole(block_to(0x1p-60), block_to(0)));
  EXPECT_TRUE(is_whole(block_to(-0x1p-60), block_to(0)));
}

TEST(ExactRays, NormalsOfTinyPrimitives) {
  const double radius = 0x1p-20;
  const Vec3 at{0.7, 0.1, 0.3};
  const Scene scene = scene_of(Op::kUnion, {ball(radius, at), ball(1, {5, 5, 5})});
  const ExactHit hit = hit_of(scene, {at + Vec3(0.6 * radius, 0, 1), {0, 0, -1}});
  EXPECT_EQ(hit.primitive, 0u);
  // The result is as exact as the ray's own place beside the ball.
  const double x = (at.x + 0.6 * radius - at.x) / radius;
  EXPECT_NEAR(hit.normal.x, x, 1e-15);
  EXPECT_NEAR(hit.normal.z, std::sqrt(1 - x * x), 1e-15);
}

// --- Doubts ---

TEST(ExactRays, DoubtNearSilhouettes) {
  const Scene scene = scene_of(Op::kUnion, {rod(-1, 1, 1)});
  const double step = ExactScene(scene).displacement();
  EXPECT_LT(step, 1e-11);
  const auto at = [&](double x) { return doubt_of(scene, {{x, 0, 5}, {0, 0, -1}}); };
  EXPECT_EQ(at(1 - 0.5 * step), Doubt::kSilhouette);
  EXPECT_EQ(at(1 + 0.5 * step), Doubt::kSilhouette);
  EXPECT_EQ(at(1), Doubt::kSilhouette);
  EXPECT_EQ(at(1 - 2 * step), Doubt::kNone);
  EXPECT_EQ(at(1 + 2 * step), Doubt::kNone);
  // A silhouette inside something larger does not matter, and leaves no doubt.
  const Scene covered = scene_of(Op::kUnion, {rod(-1, 1, 1), rod(-2, 2, 3)});
  EXPECT_EQ(doubt_of(covered, {{1, 0, 5}, {0, 0, -1}}), Doubt::kNone);
  EXPECT_EQ(doubt_of(covered, {{0, 3, 5}, {0, 0, -1}}), Doubt::kSilhouette);
}

TEST(ExactRays, DoubtAtEdgesOfPolyhedra) {
  const Scene scene = scene_of(Op::kUnion, {block(Vec3(-1), Vec3(1))});
  const double step = ExactScene(scene).displacement();
  // Rays past the edge, and over an edge where one face follows the other.
  const auto beside = [&](double x) { return doubt_of(scene, {{x, 0, 5}, {0, 0, -1}}); };
  const auto over = [&](double x) { return doubt_of(scene, {{x, -2, 5}, {0, 0.6, -1}}); };
  const auto across = [&](double x) { return doubt_of(scene, {{3 + x, 0.1, 3}, {-1, 0, -1}}); };
  for (const double sign : {-1, 1}) {
    EXPECT_EQ(beside(1 + sign * 0.5 * step), Doubt::kSilhouette);
    EXPECT_EQ(beside(1 + sign * 2 * step), Doubt::kNone);
    EXPECT_EQ(over(1 + sign * 0.5 * step), Doubt::kSilhouette);
    EXPECT_EQ(over(sign * 0.5 * step), Doubt::kNone);
    EXPECT_EQ(across(sign * 0.5 * step), Doubt::kSilhouette);
    EXPECT_EQ(across(sign * 3 * step), Doubt::kNone);
  }
}

TEST(ExactRays, DoubtAtTheEyeAndAtTau) {
  const Scene block = scene_of(Op::kUnion, {rod(-1, 1, 1)});
  const ExactScene prepared(block);
  const double tolerance = prepared.thickness(), step = prepared.displacement();
  const auto from = [&](double height) {
    return doubt_of(block, {{0.25, 0.25, 1 + height}, {0, 0, -1}}, kFromEye);
  };
  EXPECT_EQ(from(0), Doubt::kNone);
  EXPECT_EQ(from(tolerance), Doubt::kEye);
  EXPECT_EQ(from(tolerance + 0.5 * step), Doubt::kEye);
  EXPECT_EQ(from(tolerance + 3 * step), Doubt::kNone);
  const auto lid = [&](double thickness) {
    return doubt_of(scene_of(Op::kDifference, {rod(-1, 1, 1), rod(-2, 1 - thickness, 0.9)}),
                    {{0.25, 0.25, 9}, {0, 0, -1}});
  };
  EXPECT_EQ(lid(tolerance), Doubt::kThickness);
  EXPECT_EQ(lid(tolerance + 1.5 * step), Doubt::kThickness);
  EXPECT_EQ(lid(tolerance - 1.5 * step), Doubt::kThickness);
  EXPECT_EQ(lid(tolerance + 3 * step), Doubt::kNone);
  EXPECT_EQ(lid(tolerance - 3 * step), Doubt::kNone);
  EXPECT_EQ(lid(0), Doubt::kNone);
}

TEST(ExactRays, CountsWhereIntervalsDidNotSuffice) {
  const Scene apart = scene_of(Op::kUnion, {rod(-1, 0.1, 0.5), ball(0.3, {0, 0, 0.3})});
  const Primitive same = csgcore::make_sphere(0.35, {Mat3(2.0), {0, 0, 0.1}});
  const Scene shared = scene_of(Op::kUnion, {ball(0.7, {0, 0, 0.1}), same});
  const Scene twice = scene_of(Op::kUnion, {same, same});
  const auto counts = [](const Scene& scene) {
    const ExactScene prepared(scene);
    ExactRays rays(prepared);
    for (int i = 0; i < 10; ++i) rays.first_hit({{0.01 * i, 0.03, 5}, {0.1, 0.2, -5}}, kWholeLine);
    return rays.counts();
  };
  EXPECT_EQ(counts(apart).rays, 10u);
  EXPECT_EQ(counts(apart).segments, 20u);
  EXPECT_GT(counts(apart).comparisons, 20u);
  EXPECT_EQ(counts(apart).exact_comparisons, 0u);
  EXPECT_EQ(counts(apart).exact_segments, 0u);
  EXPECT_EQ(counts(shared).exact_segments, 20u);
  EXPECT_GE(counts(shared).exact_comparisons, 20u);
  EXPECT_EQ(counts(twice).exact_comparisons, 0u);  // equal numbers need none
  EXPECT_EQ(counts(shared).unsettled_thicknesses, 0u);
}

}  // namespace
}  // namespace oracle
