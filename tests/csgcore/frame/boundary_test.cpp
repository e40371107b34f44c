// Tests which boundaries of a solid are shown, against the tree's own value between crossings in
// extended precision.
#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>

#include "checks.hpp"
#include "csgcore/tracer.hpp"
#include "ray_oracle.hpp"
#include "support/evaluate_tree.hpp"
#include "trace_scenes.hpp"
#include "whole_list.hpp"

namespace csgcore {
namespace {

using checks::LongRay;
using checks::LongVec3;
using checks::RayOracle;
using checks::Real;

constexpr Real kInfinity = std::numeric_limits<Real>::infinity();

/// A place on a ray where it enters or leaves the solid.
struct Turn {
  Real s;
  uint32_t primitive;
  bool enters = false;
};

/// Finds the turns of rays in scenes without coincident crossings.
class TurnOracle {
 public:
  explicit TurnOracle(const Scene& scene) : scene_(scene) {
    for (const Primitive& primitive : scene.primitives) {
      primitives_.emplace_back(primitive, Vec3{0.0});
    }
  }

  /// Returns the turns beyond s, in order, and sets `is_close` if any two crossings are close to
  /// each other.
  std::vector<Turn> turns(const LongRay& ray, Real from_s, bool& is_close) const {
    std::vector<Turn> crossings;
    std::vector<bool> inside(primitives_.size());
    for (uint32_t i = 0; i < primitives_.size(); ++i) {
      for (const RayOracle::Segment& segment : primitives_[i].segments(ray)) {
        if (segment.start <= from_s && segment.end > from_s) inside[i] = true;
        if (segment.start > from_s) crossings.push_back({segment.start, i});
        if (segment.end > from_s) crossings.push_back({segment.end, i});
      }
    }
    std::sort(crossings.begin(), crossings.end(),
              [](const Turn& a, const Turn& b) { return a.s < b.s; });
    const auto value = [&] {
      return test_support::evaluate_tree(scene_.model.tokens(),
                                         [&](uint32_t i) { return inside[i]; });
    };
    std::vector<Turn> result;
    bool last_value = value();
    Real last_s = from_s;
    for (const Turn& crossing : crossings) {
      constexpr Real kClose = 1e-5;
      is_close |= (crossing.s - last_s) * glm::length(ray.direction) < kClose;
      last_s = crossing.s;
      inside[crossing.primitive] = !inside[crossing.primitive];
      if (value() == last_value) continue;
      last_value = !last_value;
      result.push_back({crossing.s, crossing.primitive, last_value});
    }
    return result;
  }

 private:
  const Scene& scene_;
  std::vector<RayOracle> primitives_;
};

/// Fails unless the pixel shows the turn, or nothing if there is none.
void expect_shown(const Hits& hits, size_t pixel, const LongRay& ray, const Turn* turn,
                  double size) {
  ASSERT_EQ(hits.primitive[pixel], turn ? turn->primitive : Hits::kMiss);
  if (!turn) {
    ASSERT_EQ(hits.s[pixel], kInfinity);
    ASSERT_EQ(hits.position[pixel], Vec3{0.0});
    ASSERT_EQ(hits.normal[pixel], Vec3{0.0});
    return;
  }
  const Real facing = glm::dot(LongVec3(hits.normal[pixel]), ray.direction);
  // Along the normal, positions are exact up to the last bits of the coordinates and of s.
  const Real last_bits = 1e-15L * (std::abs(turn->s) + glm::length(ray.origin));
  const Real allowed = 1e-13L * size + last_bits;
  ASSERT_LE(std::abs(facing * (turn->s - hits.s[pixel])), allowed);
  const LongVec3 off = LongVec3(hits.position[pixel]) - ray.at(turn->s);
  ASSERT_LE(std::abs(facing) * glm::length(off), allowed);
  // The normal points out of the solid: against the ray where it enters.
  ASSERT_EQ(facing < 0, turn->enters);
}

class BoundariesOf : public testing::TestWithParam<const char*> {};

TEST_P(BoundariesOf, AreWhereTheTreesValueChanges) {
  const Scene scene = checks::trace_scene(GetParam()).scene;
  const Solid solid(canonical_primitives(scene), scene.model);
  const TurnOracle oracle(scene);
  TraceOptions behind;
  behind.boundary = Boundary::kBehind;
  uint32_t compared = 0, close = 0, seconds = 0;
  for (const auto& [name, view] : checks::trace_views(solid.bounds(), 17, 13)) {
    SCOPED_TRACE(name);
    const Hits hits[] = {checks::trace_by_tiles(solid, view),
                         checks::trace_by_tiles(solid, view, behind)};
    const bool is_perspective = view.projection == Projection::kPerspective;
    const Real from_s = is_perspective ? Real(thickness_tolerance(solid.bounds())) : -kInfinity;
    for (uint32_t pixel = 0; pixel < hits[0].s.size(); ++pixel) {
      const Ray ray = pixel_ray(view, pixel % view.width_px, pixel / view.width_px);
      const LongRay line{LongVec3(ray.origin), LongVec3(ray.direction)};
      bool is_close = false;
      const std::vector<Turn> turns = oracle.turns(line, from_s, is_close);
      (is_close ? close : compared) += 1;
      if (is_close) continue;
      seconds += turns.size() > 1;
      for (size_t which = 0; which < 2; ++which) {
        const Turn* turn = turns.size() > which ? &turns[which] : nullptr;
        expect_shown(hits[which], pixel, line, turn, solid.bounds().diagonal());
        if (HasFatalFailure()) return;
      }
    }
  }
  EXPECT_GT(compared, 20 * close);
  EXPECT_GT(seconds, 100u);
}

INSTANTIATE_TEST_SUITE_P(Tracer, BoundariesOf,
                         testing::Values("Ball", "Random3", "Random10", "Random40", "Repeated"),
                         [](const auto& name) { return std::string(name.param); });

}  // namespace
}  // namespace csgcore
