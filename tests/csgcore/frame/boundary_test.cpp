// Tests which boundaries of a solid are shown, against the reference.
#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <limits>

#include "checks.hpp"
#include "csgcore/tracer.hpp"
#include "support/reference.hpp"
#include "trace_scenes.hpp"
#include "whole_list.hpp"

namespace csgcore {
namespace {

/// Fails unless the pixel shows the hit, on the side where the ray enters the solid or leaves it.
void expect_shown(const Hits& hits, size_t pixel, const Ray& ray, const ReferenceHit& hit,
                  bool enters, double size) {
  ASSERT_EQ(hits.primitive[pixel], hit.hit() ? hit.primitive : Hits::kMiss);
  if (!hit.hit()) {
    ASSERT_EQ(hits.s[pixel], std::numeric_limits<double>::infinity());
    ASSERT_EQ(hits.position[pixel], Vec3{0.0});
    ASSERT_EQ(hits.normal[pixel], Vec3{0.0});
    return;
  }
  const Real facing = glm::dot(LongVec3(hits.normal[pixel]), LongVec3(ray.direction));
  // Along the normal, positions are exact up to the last bits of the coordinates and of s.
  const Real last_bits = 1e-15L * (std::abs(hit.s) + Real(glm::length(ray.origin)));
  const Real allowed = 1e-13L * size + last_bits;
  ASSERT_LE(std::abs(facing * (hit.s - hits.s[pixel])), allowed);
  const LongVec3 off = LongVec3(hits.position[pixel]) - hit.position;
  ASSERT_LE(std::abs(facing) * glm::length(off), allowed);
  // The normal points out of the solid: against the ray where it enters.
  ASSERT_EQ(facing < 0, enters);
}

class BoundariesOf : public testing::TestWithParam<const char*> {};

TEST_P(BoundariesOf, AreThoseOfTheReference) {
  const Scene scene = checks::trace_scene(GetParam()).scene;
  const Solid solid(canonical_primitives(scene), scene.model);
  TraceOptions behind;
  behind.boundary = Boundary::kBehind;
  uint32_t compared = 0, undecided = 0, seconds = 0;
  for (const auto& [name, view] : checks::trace_views(solid.bounds(), 17, 13)) {
    SCOPED_TRACE(name);
    const Reference reference(scene, view);
    const Hits first = checks::trace_by_tiles(solid, view);
    const Hits second = checks::trace_by_tiles(solid, view, behind);
    const bool is_inside =
        view.projection == Projection::kPerspective && checks::holds(scene, view.eye);
    for (uint32_t pixel = 0; pixel < first.s.size(); ++pixel) {
      const uint32_t x = pixel % view.width_px, y = pixel / view.width_px;
      const bool is_decided = !reference.undecided(x, y);
      (is_decided ? compared : undecided) += 1;
      if (!is_decided) continue;
      const Ray ray = pixel_ray(view, x, y);
      const ReferenceHit hit = reference.behind(x, y);
      seconds += hit.hit();
      const double size = solid.bounds().diagonal();
      ASSERT_NO_FATAL_FAILURE(
          expect_shown(first, pixel, ray, reference.at(x, y), !is_inside, size));
      ASSERT_NO_FATAL_FAILURE(expect_shown(second, pixel, ray, hit, is_inside, size));
    }
  }
  EXPECT_GT(compared, 20 * undecided);
  EXPECT_GT(seconds, 100u);
}

INSTANTIATE_TEST_SUITE_P(Tracer, BoundariesOf,
                         testing::Values("Ball", "Random3", "Random10", "Random40", "Repeated"),
                         [](const auto& name) { return std::string(name.param); });

}  // namespace
}  // namespace csgcore
