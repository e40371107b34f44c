// Tests the two oracles against each other on the whole stress suite: exact arithmetic, and long
// double in a formulation of its own. They may differ only where a ray is undecided.
#include <gtest/gtest.h>

#include <cstdio>
#include <glm/geometric.hpp>

#include "oracle/exact_rays.hpp"
#include "suite.hpp"
#include "support/reference.hpp"

namespace {

using csgcore::LongVec3;
using csgcore::ReferenceHit;
using oracle::Doubt;
using oracle::ExactCounts;
using oracle::ExactHit;
using stress::Case;
using stress::Family;

class OracleStressTest : public testing::TestWithParam<Family> {};

TEST_P(OracleStressTest, AgreesWithTheReference) {
  ExactCounts counts;
  uint64_t hits = 0, undecided = 0;
  for (const Case* one : stress::cases_to_run(GetParam())) {
    SCOPED_TRACE(one->name);
    const csgcore::Scene scene = one->make();
    const oracle::ExactScene exact(scene);
    oracle::ExactRays rays(exact);
    for (const stress::Camera& camera : one->cameras(scene, stress::picture_size())) {
      SCOPED_TRACE(camera.name);
      const csgcore::View& view = camera.view;
      const csgcore::Reference reference(scene, view);
      const std::vector<ReferenceHit> expected = reference.picture();
      const std::vector<ExactHit> picture = oracle::exact_picture(exact, view, &counts);
      // Far from the origin the rounding of coordinates matters, in the reference's box and in
      // exact positions.
      EXPECT_NEAR(exact.size(), reference.model_size(), 4 * exact.displacement());
      const double far = oracle::kExactPositionError * exact.size() + exact.displacement();
      for (size_t i = 0; i < picture.size(); ++i) {
        const ExactHit& hit = picture[i];
        hits += hit.hit();
        const bool same =
            hit.primitive == expected[i].primitive &&
            glm::length(LongVec3(hit.position) - expected[i].position) <= far &&
            glm::length(LongVec3(hit.normal) - expected[i].normal) <= oracle::kExactNormalError;
        if (same) continue;
        ++undecided;
        const uint32_t x = uint32_t(i % view.width_px), y = uint32_t(i / view.width_px);
        EXPECT_NE(rays.doubt(csgcore::pixel_ray(view, x, y), view.projection), Doubt::kNone)
            << "pixel " << x << ", " << y << ": primitive " << int32_t(hit.primitive)
            << " instead of " << int32_t(expected[i].primitive);
      }
    }
  }
  if (!GetParam().has_ties) {
    EXPECT_LE(double(undecided), 1e-5 * double(hits));  // the suite's bar
  }
  const auto number = [](uint64_t n) { return static_cast<unsigned long long>(n); };
  std::printf(
      "%s: %llu hits, %llu undecided; exact: %llu of %llu segments, %llu of %llu "
      "comparisons, %llu of %llu thicknesses unsettled\n",
      GetParam().name.c_str(), number(hits), number(undecided), number(counts.exact_segments),
      number(counts.segments), number(counts.exact_comparisons), number(counts.comparisons),
      number(counts.unsettled_thicknesses), number(counts.thicknesses));
}

INSTANTIATE_TEST_SUITE_P(, OracleStressTest, testing::ValuesIn(stress::families()),
                         [](const auto& instance) { return instance.param.name; });

}  // namespace
