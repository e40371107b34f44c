// Tests the judges of rays and points on simple solids.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "csgcore/polyhedron.hpp"
#include "csgcore/solid.hpp"
#include "faceted_scene.hpp"
#include "nef_judge.hpp"
#include "ray_judge.hpp"
#include "samples.hpp"

namespace validation {
namespace {

using csgcore::Projection;
using csgcore::Ray;
using csgcore::Scene;
using csgcore::Vec3;

csgcore::Primitive box(const Vec3& min, const Vec3& max) {
  return csgcore::make_polyhedron(csgcore::Polyhedron::box({min, max}));
}

Scene union_of(std::vector<csgcore::Primitive> primitives) {
  csgcore::CsgTreeBuilder builder;
  for (uint32_t i = 0; i < primitives.size(); ++i) builder.primitive(i);
  return {std::move(primitives), builder.finish(), {}};
}

constexpr double kSize = 10, kThickness = 1e-8;

NefTruth truth_of(const Scene& scene) { return NefTruth(scene, kSize, kThickness, {}); }

/// A ray upwards from z = −5.
Ray upwards(double x, double y) { return {{x, y, -5}, {0, 0, 1}}; }

Seen seen_upwards(const Ray& ray, uint32_t primitive, double z) {
  return {primitive, z - ray.origin.z, {ray.origin.x, ray.origin.y, z}, {0, 0, -1}};
}

std::string text_of(const Verdict& verdict) {
  if (verdict.outcome == Outcome::kAgreed) return "agreed";
  if (verdict.outcome == Outcome::kUndecided) return "undecided";
  return verdict.details["differs_in"];
}

/// Judges a ray upwards that sees the primitive at that height, or nothing.
template <typename Truth>
class Upwards {
 public:
  Upwards(const Truth& truth, std::unique_ptr<RayJudge> judge)
      : truth_(truth), judge_(std::move(judge)) {}
  std::string sees(uint32_t primitive, double x, double y, double z) {
    const Ray ray = upwards(x, y);
    return text_of(
        judge_->judge({ray, Projection::kOrthographic, seen_upwards(ray, primitive, z)}));
  }
  std::string misses(double x, double y) {
    return text_of(judge_->judge({upwards(x, y), Projection::kOrthographic, Seen{}}));
  }
  RayJudge& judge() { return *judge_; }

 private:
  const Truth& truth_;
  std::unique_ptr<RayJudge> judge_;
};

TEST(NefJudge, TellsWhatDiffers) {
  const Scene scene = union_of({box(Vec3(0), Vec3(2)), box({1, 1, -1}, {3, 3, 1})});
  const NefTruth truth = truth_of(scene);
  ASSERT_EQ(truth.status(), oracle::NefStatus::kBuilt);
  Upwards ray(truth, make_nef_judge(truth, kDoubleTolerance));
  EXPECT_EQ(ray.sees(0, 0.5, 0.5, 0), "agreed");
  EXPECT_EQ(ray.sees(1, 1.5, 1.5, -1), "agreed");
  EXPECT_EQ(ray.misses(5, 5), "agreed");
  EXPECT_EQ(ray.misses(0.5, 0.5), "hit or miss");
  EXPECT_EQ(ray.sees(0, 5, 5, 0), "hit or miss");
  EXPECT_EQ(ray.sees(0, 1.5, 1.5, 0), "position");
  EXPECT_EQ(ray.sees(0, 0.5, 0.5, 1e-7), "position");
  EXPECT_EQ(ray.sees(0, 0.5, 0.5, 1e-9), "agreed");
  EXPECT_EQ(ray.sees(1, 0.5, 0.5, 0), "primitive");
  const Ray up = upwards(0.5, 0.5);
  Seen turned = seen_upwards(up, 0, 0);
  turned.normal = {0, 0, 1};
  EXPECT_EQ(text_of(ray.judge().judge({up, Projection::kOrthographic, turned})), "normal");
}

TEST(NefJudge, AnEdgeWithinRoundingIsUndecided) {
  const Scene scene = union_of({box(Vec3(0), Vec3(2))});
  const NefTruth truth = truth_of(scene);
  Upwards ray(truth, make_nef_judge(truth, kDoubleTolerance));
  EXPECT_EQ(ray.misses(1e-13, 1), "undecided");
  EXPECT_EQ(ray.sees(0, -1e-13, 1, 0), "undecided");
  EXPECT_EQ(ray.misses(0, 1), "undecided");  // it runs in a face
  EXPECT_EQ(ray.misses(1e-10, 1), "hit or miss");
  EXPECT_EQ(ray.sees(0, -1e-10, 1, 0), "hit or miss");
}

// Pieces and gaps that are thinner than the tolerance do not exist (NUMERICS.md §1).
TEST(NefJudge, KnowsTheThicknessThatDoesNotExist) {
  const double thin = 0.9 * kThickness, thick = 1.1 * kThickness;
  const auto check = [](double gap) {
    // A plate is above the box; a skin is below it, where rays come first.
    return union_of({box(Vec3(0), Vec3(2)), box({0, 0, -1}, {1, 1, -1 + gap})});
  };
  const Scene with_skin = check(thin), with_plate = check(thick);
  const NefTruth skin = truth_of(with_skin), plate = truth_of(with_plate);
  Upwards through(skin, make_nef_judge(skin, kDoubleTolerance));
  EXPECT_EQ(through.sees(0, 0.5, 0.5, 0), "agreed");
  EXPECT_EQ(through.sees(1, 0.5, 0.5, -1), "position");
  Upwards onto(plate, make_nef_judge(plate, kDoubleTolerance));
  EXPECT_EQ(onto.sees(0, 0.5, 0.5, 0), "position");
  EXPECT_EQ(onto.sees(1, 0.5, 0.5, -1), "agreed");
  // A surface that is in front of another by less may be shown in its place.
  const Scene flush = union_of({box(Vec3(0), Vec3(2)), box({0, 0, 1e-14}, {1, 1, 3})});
  const NefTruth faces = truth_of(flush);
  Upwards at(faces, make_nef_judge(faces, kDoubleTolerance));
  EXPECT_EQ(at.sees(0, 0.5, 0.5, 0), "agreed");
  EXPECT_EQ(at.sees(1, 0.5, 0.5, 1e-14), "agreed");
}

TEST(NefJudge, APerspectiveSeesWhatLiesAhead) {
  const Scene scene = union_of({box(Vec3(0), Vec3(2))});
  const NefTruth truth = truth_of(scene);
  const auto judge = make_nef_judge(truth, kDoubleTolerance);
  const auto verdict = [&](const Vec3& eye, const Seen& seen) {
    return text_of(judge->judge({{eye, {0, 0, 1}}, Projection::kPerspective, seen}));
  };
  const Seen lid{0, 1, {1, 1, 2}, {0, 0, 1}};
  EXPECT_EQ(verdict({1, 1, 1}, lid), "agreed");
  EXPECT_EQ(verdict({1, 1, 1}, {}), "hit or miss");
  EXPECT_EQ(verdict({1, 1, 3}, {}), "agreed");
  EXPECT_EQ(verdict({1, 1, 3}, {0, -3, {1, 1, 0}, {0, 0, -1}}), "hit or miss");
  // An eye in a face is behind it.
  EXPECT_EQ(verdict({1, 1, 0}, {0, 2, {1, 1, 2}, {0, 0, 1}}), "agreed");
}

TEST(NefJudge, OfPoints) {
  const Scene scene = union_of({box(Vec3(0), Vec3(2)), box({4, 0, 0}, {5, 1, 1})});
  const NefTruth truth = truth_of(scene);
  EXPECT_EQ(text_of(judge_point(truth, Vec3(1), true)), "agreed");
  EXPECT_EQ(text_of(judge_point(truth, {3, 1, 1}, false)), "agreed");
  EXPECT_EQ(text_of(judge_point(truth, {2, 1, 1}, true)), "undecided");
  EXPECT_EQ(text_of(judge_point(truth, {2, 1, 1}, false)), "undecided");
  EXPECT_EQ(text_of(judge_point(truth, {2 - 1e-13, 1, 1}, false)), "undecided");
  const Verdict wrong = judge_point(truth, {4.25, 0.5, 0.5}, false);
  EXPECT_EQ(text_of(wrong), "membership");
  EXPECT_EQ(wrong.details["nearest"]["primitive"], 1);
  EXPECT_NEAR(wrong.error, 0.25 / kSize, 1e-12);
}

TEST(ExactJudge, TellsWhatDiffers) {
  // The diagonal of its box is about 10.
  const Scene scene = union_of({csgcore::make_frustum(0, 8, 2, 2), csgcore::make_sphere(1)});
  const oracle::ExactScene exact(scene);
  Upwards ray(exact, make_exact_judge(exact, kDoubleTolerance));
  EXPECT_EQ(ray.sees(0, 1.5, 0.5, 0), "agreed");
  EXPECT_EQ(ray.misses(5, 5), "agreed");
  EXPECT_EQ(ray.misses(1.5, 0.5), "hit or miss");
  EXPECT_EQ(ray.sees(1, 1.5, 0.5, 0), "primitive");
  EXPECT_EQ(ray.sees(0, 1.5, 0.5, 1e-7), "position");
  EXPECT_EQ(ray.misses(2 - 1e-13, 0), "undecided");
  EXPECT_EQ(ray.misses(2 - 1e-10, 0), "hit or miss");
  Upwards rough(exact, make_exact_judge(exact, kFloatTolerance));
  EXPECT_EQ(rough.sees(0, 1.5, 0.5, 1e-5), "agreed");
  EXPECT_EQ(rough.sees(0, 1.5, 0.5, 1e-2), "position");
  EXPECT_EQ(rough.misses(2 - 1e-4, 0), "undecided");
  EXPECT_EQ(rough.misses(2 - 1e-2, 0), "hit or miss");
}

// The shell contains all points at which smooth primitives and their facets differ, and is no
// thicker than needed.
TEST(SagittaShell, HoldsWhatFacetsCutOff) {
  csgcore::Affine map;
  map.linear = {{2, 0.5, 0}, {0, 1, 0.25}, {0.5, 0, -3}};  // sheared, and a mirror
  map.translation = {5, -6, 7};
  for (const int fragments : {3, 4, 5, 8, 17}) {
    for (const csgcore::Primitive& primitive :
         {csgcore::make_sphere(1.5, map), csgcore::make_frustum(-1, 2, 1, 0.25, map),
          csgcore::make_frustum(-1, 2, 0, 1, map)}) {
      const Scene smooth_scene = union_of({primitive});
      const Scene faceted_scene = faceted(smooth_scene, fragments).value();
      ASSERT_EQ(faceted_scene.primitives[0].shape(), csgcore::Shape::kPolyhedron);
      const csgcore::Solid smooth(csgcore::canonical_primitives(smooth_scene), smooth_scene.model);
      const csgcore::Solid facets(csgcore::canonical_primitives(faceted_scene),
                                  faceted_scene.model);
      const SagittaShell shell(primitive, fragments);
      int cut_off = 0, in_shell = 0;
      double deepest = 0;
      for (uint64_t i = 0; i < 20000; ++i) {
        const Vec3 point = Random(1, Random::Use::kPointsInBox, i).point_in(smooth.bounds());
        const bool is_cut_off = smooth.contains(point) && !facets.contains(point);
        EXPECT_FALSE(facets.contains(point) && !smooth.contains(point));
        if (is_cut_off) {
          EXPECT_TRUE(shell.contains(point)) << fragments;
          deepest = std::max(deepest, shell.depth(point));
        }
        cut_off += is_cut_off;
        in_shell += shell.contains(point);
      }
      EXPECT_GT(cut_off, 50);
      EXPECT_LT(in_shell, 4 * cut_off) << fragments;
      EXPECT_GT(deepest, 0);
      EXPECT_LT(deepest, smooth.bounds().diagonal());
    }
  }
}

TEST(SagittaShell, DepthIsInWorldUnits) {
  csgcore::Affine map;
  map.linear = csgcore::Mat3(10.0);
  const SagittaShell ball(csgcore::make_sphere(2, map), 8);
  EXPECT_NEAR(ball.depth({19, 0, 0}), 1, 1e-12);
  EXPECT_TRUE(ball.contains({19, 0, 0}));
  EXPECT_FALSE(ball.contains({20.01, 0, 0}));
  EXPECT_TRUE(ball.contains({17.1, 0, 0}));  // the inscribed radius is 20·cos(22.5°)² = 17.07
  EXPECT_FALSE(ball.contains({17, 0, 0}));
  const SagittaShell cone(csgcore::make_frustum(0, 1, 1, 0, map), 4);
  EXPECT_NEAR(cone.depth({4, 0, 5}), 1, 1e-12);
}

TEST(FacetedScene, SharesWhatIsEqualAndKeepsTheRest) {
  Scene scene = union_of({csgcore::make_sphere(1), csgcore::make_sphere(1), csgcore::make_sphere(2),
                          box(Vec3(0), Vec3(1))});
  scene.primitives[1].id = 7;
  scene.primitives[1].local_to_world.translation = {1, 2, 3};
  const Scene result = faceted(scene, 6).value();
  EXPECT_EQ(result.primitives[0].polyhedron(), result.primitives[1].polyhedron());
  EXPECT_NE(result.primitives[0].polyhedron(), result.primitives[2].polyhedron());
  EXPECT_EQ(result.primitives[3].polyhedron(), scene.primitives[3].polyhedron());
  EXPECT_EQ(result.primitives[1].id, 7u);
  EXPECT_EQ(result.primitives[1].local_to_world.translation, Vec3(1, 2, 3));
}

}  // namespace
}  // namespace validation
