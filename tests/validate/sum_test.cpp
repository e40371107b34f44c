// Tests how comparisons are summed up: the loop over samples, the volume, the table.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <numbers>

#include "csgcore/polyhedron.hpp"
#include "frontend/error.hpp"
#include "support/test_meshes.hpp"
#include "validation.hpp"
#include "volume.hpp"

namespace validation {
namespace {

using csgcore::Op;
using csgcore::Scene;
using csgcore::Vec3;
using testing::HasSubstr;
using testing::Not;

constexpr Clock::time_point kNever = Clock::time_point::max();
const Progress kSilent = [](const std::string&, double) {};

TEST(RunCheck, AddsUpVerdictsInOrder) {
  const CheckResult result = run_check("g", "n", 5000, kNever, kSilent, []() -> Judge {
    return [](uint64_t i) -> Verdict {
      if (i % 1000 == 7) return {Outcome::kDisagreed, double(i), {{"i", i}}};
      if (i % 10 == 3) return {Outcome::kUndecided, 0.5, {}};
      return {};
    };
  });
  EXPECT_EQ(result.compared, 5000u);
  EXPECT_EQ(result.disagreed, 5u);
  EXPECT_EQ(result.undecided, 500u);
  EXPECT_EQ(result.agreed, 4495u);
  EXPECT_EQ(result.worst_error, 4007);
  ASSERT_EQ(result.disagreements.size(), 5u);
  for (uint64_t i = 0; i < 5; ++i) EXPECT_EQ(result.disagreements[i]["i"], 1000 * i + 7);
}

TEST(RunCheck, StopsAtTheDeadlineButNotBeforeAFirstPart) {
  std::atomic<int> judged{0};
  const auto run = [&](uint64_t planned, Clock::time_point deadline) {
    return run_check("g", "n", planned, deadline, kSilent, [&]() -> Judge {
      return [&](uint64_t) -> Verdict {
        ++judged;
        return {};
      };
    });
  };
  const CheckResult result = run(1'000'000, Clock::now());
  EXPECT_EQ(result.compared, kLeastSamples);
  EXPECT_EQ(result.planned, 1'000'000u);
  EXPECT_EQ(judged, int(kLeastSamples));
  EXPECT_EQ(run(10, Clock::now()).compared, 10u);
}

TEST(RunCheck, ListsSomeDisagreementsAndCountsAll) {
  const CheckResult result = run_check("g", "n", 3000, kNever, kSilent, []() -> Judge {
    return [](uint64_t) -> Verdict { return {Outcome::kDisagreed, 0, {}}; };
  });
  EXPECT_EQ(result.disagreed, 3000u);
  EXPECT_EQ(result.disagreements.size(), kMostListed);
}

TEST(RunCheck, ShowsWhatIsLeft) {
  std::vector<std::pair<std::string, double>> shown;
  run_check(
      "g", "n", 2 * kLeastSamples, Clock::now() + std::chrono::hours(1),
      [&](const std::string& stage, double fraction) { shown.emplace_back(stage, fraction); },
      []() -> Judge { return [](uint64_t) { return Verdict{}; }; });
  ASSERT_EQ(shown.size(), 2u);
  EXPECT_EQ(shown[0].second, 0.5);
  EXPECT_EQ(shown[1].second, 1);
  EXPECT_EQ(shown[1].first, "n, 0 s left");
}

VolumeEstimate volume_of(std::vector<csgcore::Primitive> primitives, Op op, uint64_t rays,
                         Clock::time_point deadline = kNever) {
  Scene scene;
  csgcore::CsgTreeBuilder builder;
  builder.open(op);
  for (uint32_t i = 0; i < primitives.size(); ++i) builder.primitive(i);
  builder.close();
  scene.primitives = std::move(primitives);
  scene.model = builder.finish();
  const csgcore::Solid solid(csgcore::canonical_primitives(scene), scene.model);
  return estimate_volume(csgcore::Subdivision(solid, {}), 1, rays, deadline, kSilent);
}

void expect_volume(const VolumeEstimate& estimate, double volume, double bound) {
  EXPECT_NEAR(estimate.volume, volume, estimate.bound);
  EXPECT_LT(estimate.bound, bound);
}

TEST(Volume, OfKnownSolids) {
  using std::numbers::pi;
  expect_volume(volume_of({csgcore::make_sphere(2)}, Op::kUnion, 20000), 32 * pi / 3, 0.5);
  expect_volume(volume_of({csgcore::make_frustum(0, 3, 2, 0)}, Op::kUnion, 20000), 4 * pi, 0.3);
  // A shell: two pieces on a ray. A quarter of the rays meet the cavity.
  expect_volume(
      volume_of({csgcore::make_sphere(2), csgcore::make_sphere(1)}, Op::kDifference, 20000),
      28 * pi / 3, 0.5);
  const csgcore::Affine turned{{{0.6, 0, 0.8}, {0, 1, 0}, {-0.8, 0, 0.6}}, {100, 200, 300}};
  expect_volume(
      volume_of({csgcore::make_polyhedron(csgcore::Polyhedron::box({Vec3(0), {1, 2, 3}}), turned)},
                Op::kUnion, 20000),
      6, 0.05);
}

// The solid fills its box, so that all rays agree.
TEST(Volume, OfABox) {
  const VolumeEstimate estimate =
      volume_of({csgcore::make_polyhedron(csgcore::Polyhedron::box({Vec3(1), {2, 3, 4}}))},
                Op::kUnion, 10000);
  EXPECT_NEAR(estimate.volume, 6, 1e-12);
  EXPECT_GT(estimate.bound, 0);
}

// A mesh is one primitive, but a ray meets it in any number of pieces.
TEST(Volume, OfAMeshThatRaysMeetInThreePieces) {
  const auto floor = [](double z) { return test_support::box_parts({0, 0, z}, {4, 4, z + 1}); };
  const auto mesh = test_support::joined({floor(0), floor(2), floor(4)}).mesh();
  const VolumeEstimate estimate = volume_of({csgcore::make_mesh(mesh)}, Op::kUnion, 1000);
  EXPECT_NEAR(estimate.volume, 3 * 16, 1e-12);
}

TEST(Volume, MoreRaysMakeABetterBound) {
  const auto of = [](uint64_t rays) {
    return volume_of({csgcore::make_sphere(1), csgcore::make_frustum(-2, 2, 0.5, 0.5)},
                     Op::kDifference, rays);
  };
  const VolumeEstimate few = of(1000), some = of(20000), many = of(2 * kVolumePass);
  EXPECT_LT(some.bound, few.bound / 5);
  EXPECT_LT(many.bound, some.bound / 2);
  EXPECT_GT(many.rays, 3 * kVolumePass / 2);
  const VolumeEstimate late =
      volume_of({csgcore::make_sphere(1)}, Op::kUnion, 2 * kVolumePass, Clock::now());
  EXPECT_LT(late.rays, 3 * kVolumePass / 2);
}

// The bound includes a needle that no ray meets.
TEST(Volume, OfNeedlesThatRaysMiss) {
  const VolumeEstimate estimate =
      volume_of({csgcore::make_frustum(0, 10, 1e-4, 1e-4),
                 csgcore::make_frustum(0, 10, 1e-4, 1e-4, {csgcore::Mat3(1.0), {10, 10, 0}})},
                Op::kUnion, 1000);
  EXPECT_NEAR(estimate.volume, 20 * std::numbers::pi * 1e-8, estimate.bound);
}

Result some_result() {
  CheckResult good{"group one", "rays", 2000000, 1234567, 1234000, 567, 0, 1.25e-12, {}};
  CheckResult bad{"group two", "points", 3, 3, 1, 0, 2, 0, {}};
  bad.disagreements = {{{"seen", {{"primitive", 4}}}, {"expected", {{"primitive", 4}}}},
                       {{"seen", {{"primitive", 4}}}, {"expected", {{"primitive", 9}}}}};
  return {{good, bad}, {"a note"}, 1.25};
}

TEST(Report, Table) {
  EXPECT_EQ(table_of(some_result()),
            "                           compared     agreed  undecided  disagreed  worst error\n"
            "group one\n"
            "  rays                    1,234,567  1,234,000        567          0  1.2e-12\n"
            "group two\n"
            "  points                          3          1          0          2  0\n"
            "a note\n"
            "CGAL took 1.2 s for its solid\n"
            "not all was compared: time ran out (raise --time-limit)\n"
            "first disagreement, points (group two): "
            "{\"seen\":{\"primitive\":4},\"expected\":{\"primitive\":4}}\n"
            "primitives that disagreements name: 4 (2 times), 9 (1 times)\n"
            "DISAGREES\n");
  Result agrees = some_result();
  agrees.checks.pop_back();
  agrees.checks[0].compared = agrees.checks[0].planned;
  EXPECT_THAT(table_of(agrees), HasSubstr("agrees\n"));
  EXPECT_THAT(table_of(agrees), Not(HasSubstr("not all")));
}

TEST(Report, Json) {
  Settings settings;
  settings.seed = 77;
  const Json report = Json::parse(report_of(some_result(), "a\xff.csg", settings, 3));
  EXPECT_EQ(report["agrees"], false);
  EXPECT_EQ(report["seed"], 77);
  EXPECT_EQ(report["fn"], 8);
  EXPECT_EQ(report["scale_exponent"], 3);
  EXPECT_EQ(report["notes"][0], "a note");
  EXPECT_EQ(report["checks"][0]["compared"], 1234567);
  EXPECT_EQ(report["checks"][0]["worst_error"], 1.25e-12);
  EXPECT_EQ(report["checks"][1]["disagreements"][1]["expected"]["primitive"], 9);
}

}  // namespace
}  // namespace validation
