// Tests the CPU tracer on thousands of random trees against the exact ray oracle. The full run has
// 10,000 trees of 1,024 rays each; SCADRAY_TEST_TREES sets another number, for fuzzing.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "cpu_methods.hpp"
#include "disagreement.hpp"
#include "judge.hpp"
#include "random_scenes.hpp"
#include "support/full_run.hpp"

namespace {

using csgcore::Hits;
using csgcore::Solid;
using oracle::Doubt;
using oracle::ExactHit;
using oracle::ExactRays;
using oracle::ExactScene;
using stress::Method;
using stress::Scene;
using stress::Verdict;
using stress::View;

/// Even, so that no row of pixels is in the middle of a symmetric scene.
constexpr stress::PictureSize kPicture{32, 32};
constexpr uint32_t kParts = 10;          // so that they run side by side
constexpr double kMostUndecided = 1e-5;  // a share of the rays; in a smaller sample two rays may be
/// A view along an axis may have a whole row of pixels on the diagonal of a torn face.
constexpr double kMostUndecidedOnMeshes = 1e-4;

/// Exact rays through profiles are slow.
constexpr uint32_t kProfileTreesOfAPart = 10, kProfileTreesOfAFullPart = 100;

uint32_t trees_of_a_part(stress::Leaves leaves) {
  if (const char* trees = std::getenv("SCADRAY_TEST_TREES")) {
    return uint32_t(std::strtoul(trees, nullptr, 10)) / kParts;
  }
  if (leaves == stress::Leaves::kProfiles) {
    return test_support::full_run() ? kProfileTreesOfAFullPart : kProfileTreesOfAPart;
  }
  if (test_support::full_run()) return 1000;
  // In fewer trees, two views along an axis would be too large a share of all rays.
  return leaves == stress::Leaves::kMeshes ? 120 : 60;
}

Hits picture_by(const Method& method, const Scene& scene, const View& view) {
  const Solid solid(csgcore::canonical_primitives(scene), scene.model);
  return method.prepare(scene, solid)(view);
}

csgcore::Ray ray_of(const View& view, size_t pixel) {
  return csgcore::pixel_ray(view, double(pixel % view.width_px), double(pixel / view.width_px));
}

bool is_wrong(const Method& method, const Scene& scene, const View& view, size_t pixel) {
  const ExactScene exact(scene);
  ExactRays rays(exact);
  const csgcore::Ray ray = ray_of(view, pixel);
  const ExactHit expected = rays.first_hit(ray, view.projection);
  const Hits picture = picture_by(method, scene, view);
  return stress::verdict_of(expected, picture, pixel, stress::kDoubleTolerance, exact) !=
             Verdict::kRight &&
         rays.doubt(ray, view.projection) == Doubt::kNone;
}

struct Sums {
  uint64_t hits = 0, undecided = 0;
  oracle::ExactCounts exact;
};

/// Returns what is wrong; empty if nothing is.
std::string judge_tree(const Scene& scene, const View& view, const std::vector<Method>& methods,
                       Sums& sums) {
  const ExactScene exact(scene);
  ExactRays rays(exact);
  const std::vector<ExactHit> expected = oracle::exact_picture(exact, view, &sums.exact);
  for (const ExactHit& hit : expected) sums.hits += hit.hit();
  std::vector<bool> is_undecided(expected.size());
  for (const Method& method : methods) {
    const Hits picture = picture_by(method, scene, view);
    for (size_t i = 0; i < expected.size(); ++i) {
      const Verdict verdict =
          stress::verdict_of(expected[i], picture, i, stress::kDoubleTolerance, exact);
      if (verdict == Verdict::kRight) continue;
      const Doubt doubt = rays.doubt(ray_of(view, i), view.projection);
      if (doubt == Doubt::kNone) {
        const auto shows = [&](const Scene& smaller) { return is_wrong(method, smaller, view, i); };
        return "by " + method.name + ", " + stress::minimised(scene, view, i, shows);
      }
      if (!is_undecided[i]) {
        std::printf("undecided by %s: %s at pixel %zu\n", method.name.c_str(),
                    stress::name_of(doubt), i);
      }
      is_undecided[i] = true;
    }
  }
  for (const bool undecided : is_undecided) sums.undecided += undecided;
  return {};
}

class RandomTrees : public testing::TestWithParam<uint32_t> {
 protected:
  void expect_exact(stress::Leaves leaves) const;
};

void RandomTrees::expect_exact(stress::Leaves leaves) const {
  const std::vector<Method> kd_trees = stress::cpu_methods();
  Sums sums;
  for (uint32_t i = 0; i < trees_of_a_part(leaves); ++i) {
    const uint32_t seed = 1 + GetParam() + kParts * i;
    const Scene scene = stress::random_scene(seed, leaves);
    const View view = stress::random_view(scene, kPicture, seed);
    const std::vector<Method> methods{stress::cpu_method("tiles"),
                                      kd_trees[1 + i % (kd_trees.size() - 1)]};
    const std::string wrong = judge_tree(scene, view, methods, sums);
    ASSERT_TRUE(wrong.empty()) << "tree " << seed << ", " << wrong;
  }
  const auto number = [](uint64_t n) { return static_cast<unsigned long long>(n); };
  std::printf("%s: %u trees, %llu rays, %llu hits, %llu undecided; %llu crossings coincide\n",
              test_support::full_run() ? "full run" : "sample", trees_of_a_part(leaves),
              number(sums.exact.rays), number(sums.hits), number(sums.undecided),
              number(sums.exact.exact_comparisons));
  const auto rays = double(sums.exact.rays);
  EXPECT_GT(double(sums.hits), rays / 10);
  const bool has_profiles = leaves == stress::Leaves::kProfiles;
  // The sample of profiles is too small for each part to have such faces.
  if (!has_profiles || test_support::full_run()) {
    EXPECT_GT(double(sums.exact.exact_comparisons), rays / (has_profiles ? 1000 : 100));
  }
  const bool is_torn = leaves == stress::Leaves::kMeshes;
  const double most = is_torn ? kMostUndecidedOnMeshes : kMostUndecided;
  // A view along an axis may have a diagonal of pixels on an edge of a profile or of a torn face.
  const double least = has_profiles || is_torn ? kPicture.width_px : 2;
  EXPECT_LE(double(sums.undecided), std::max(least, most * rays));
}

TEST_P(RandomTrees, CpuEqualsTheExactOracle) { expect_exact(stress::Leaves::kAll); }
TEST_P(RandomTrees, CpuEqualsTheExactOracleOnMeshes) { expect_exact(stress::Leaves::kMeshes); }
TEST_P(RandomTrees, CpuEqualsTheExactOracleOnProfiles) { expect_exact(stress::Leaves::kProfiles); }

INSTANTIATE_TEST_SUITE_P(, RandomTrees, testing::Range(0u, kParts));

// A renderer that takes the wrong sign for one coordinate of its spheres.
TEST(RandomTreesPlanted, AWrongSignIsFoundAndMinimised) {
  const Method tiles = stress::cpu_method("tiles");
  const Method wrong{"planted", [&](const Scene& scene, const Solid&) -> stress::Drawer {
                       return [&](const View& view) {
                         Scene flipped = scene;
                         for (csgcore::Primitive& primitive : flipped.primitives) {
                           if (primitive.shape() != csgcore::Shape::kSphere) continue;
                           primitive.local_to_world.translation.y *= -1;
                         }
                         return picture_by(tiles, flipped, view);
                       };
                     }};
  int found = 0;
  for (uint32_t seed = 1; seed <= 30; ++seed) {
    const Scene scene = stress::random_scene(seed, stress::Leaves::kAll);
    Sums sums;
    const std::string report =
        judge_tree(scene, stress::random_view(scene, kPicture, seed), {wrong}, sums);
    if (report.empty()) continue;
    ++found;
    // One sphere is left, which is wrong by itself.
    EXPECT_THAT(report, testing::StartsWith("by planted, pixel"));
    EXPECT_THAT(report, testing::HasSubstr("scene.primitives = {\n    make_sphere("));
    EXPECT_THAT(report, testing::HasSubstr("builder.primitive(0);\nscene.model"));
    EXPECT_THAT(report, testing::HasSubstr(") sphere("));
  }
  EXPECT_GE(found, 3);
}

}  // namespace
