// Tests the crossings of rays with extruded and revolved profiles, in double, against exact ones:
// wherever a ray is inside by the one and outside by the other, it is next to the surface, up to
// the derived bound (NUMERICS.md, "Profiles"). So crossings are missed, or too many, only where the
// ray touches the surface up to that bound.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <iterator>
#include <ostream>
#include <random>
#include <vector>

#include "checks.hpp"
#include "exact_primitive.hpp"
#include "exact_profile.hpp"
#include "exact_twin.hpp"
#include "placements.hpp"
#include "primitives/intersect.hpp"
#include "profile_aims.hpp"
#include "profile_figures.hpp"
#include "profile_surfaces.hpp"
#include "support/full_run.hpp"
#include "support/test_profiles.hpp"

namespace oracle {
namespace {

using csgcore::CanonicalPrimitive;
using csgcore::FrameRays;
using csgcore::kPacketRays;
using csgcore::make_extrusion;
using csgcore::make_revolution;
using csgcore::Primitive;
using csgcore::ProfileEdge;
using csgcore::Real;
using csgcore::Shape;
using csgcore::Vec3;
using csgcore::checks::LongMat3;
using csgcore::checks::LongRay;
using csgcore::checks::PivotRay;
using csgcore::checks::Placement;
using csgcore::checks::uniform;

/// A stretch of a ray within a solid.
struct Stretch {
  Real begin, end;
};
std::ostream& operator<<(std::ostream& out, const std::vector<Stretch>& stretches) {
  for (const Stretch& stretch : stretches) {
    out << " [" << double(stretch.begin) << ", " << double(stretch.end) << "]";
  }
  return out;
}

bool holds(const std::vector<Stretch>& stretches, Real t) {
  return std::ranges::any_of(stretches, [&](const Stretch& s) { return s.begin < t && t < s.end; });
}

Real value_of(const ExactRoot& t, double base) {
  // A number of the oracle's grid has no root.
  const double high = CGAL::to_double(t.p);
  return Real(base) + high + CGAL::to_double(Exact(t.p - Exact(high)));
}

template <class Number>
NearRay<Number> near_ray(const PivotRay& ray) {
  NearRay<Number> near;
  for (int i = 0; i < 3; ++i) near.origin[i] = ray.origin[i], near.direction[i] = ray.direction[i];
  return near;
}

std::vector<Stretch> exact_stretches(const Target<Exact>& target, const PivotRay& ray) {
  double base = 0;
  {
    const RoundingUp rounding_up;
    base = base_of(enclose(target), near_ray<Interval>(ray));
  }
  std::vector<Stretch> result;
  for (const ProfileSegment& segment :
       target.profile->segments(localize(target, near_ray<Exact>(ray), base))) {
    result.push_back({value_of(segment.begin.t, base), value_of(segment.end.t, base)});
  }
  return result;
}

std::vector<Stretch> found_stretches(const std::vector<csgcore::Crossing>& found) {
  std::vector<Stretch> result;
  int winding = 0;
  Real begin = 0;
  for (const csgcore::Crossing& crossing : found) {
    if (winding == 0) begin = crossing.t;
    winding += crossing.turn;
    if (winding == 0 && begin < crossing.t) result.push_back({begin, crossing.t});
  }
  EXPECT_EQ(winding, 0);
  return result;
}

/// Returns the furthest distance from the surface of places that are inside by the one and outside
/// by the other.
Real disagreement(const ProfileSurfaces& surfaces, const LongRay& ray,
                  const std::vector<Stretch>& a, const std::vector<Stretch>& b) {
  std::vector<Real> ends;
  for (const auto* stretches : {&a, &b}) {
    for (const Stretch& stretch : *stretches) ends.insert(ends.end(), {stretch.begin, stretch.end});
  }
  std::ranges::sort(ends);
  Real furthest = 0;
  for (size_t i = 1; i < ends.size(); ++i) {
    const Real length = ends[i] - ends[i - 1];
    if (!(length > 0)) continue;
    const Real middle = ends[i - 1] + length / 2;
    if (holds(a, middle) == holds(b, middle)) continue;
    constexpr int kParts = 6;
    for (int k = 0; k <= kParts; ++k) {
      const Real t = ends[i - 1] + length * k / kParts;
      furthest = std::max(furthest, surfaces.distance(ray.at(t)));
    }
  }
  return furthest;
}

/// The largest row sum of |M|·|M⁻¹|.
Real condition_of(const csgcore::Mat3& map) {
  const LongMat3 m(map), inverse = glm::inverse(m);
  Real largest = 0;
  for (int row = 0; row < 3; ++row) {
    Real sum = 0;
    for (int i = 0; i < 9; ++i) sum += std::abs(m[i / 3][row] * inverse[i % 3][i / 3]);
    largest = std::max(largest, sum);
  }
  return largest;
}

/// A thin ring: a circle of a radius down to 1e-12, next to 1 from the axis. Its vertices are
/// exact.
Primitive thin_ring(std::mt19937& random) {
  constexpr double kGrain = 0x1p-50;
  const auto even = [](double x) { return kGrain * std::round(x / kGrain); };
  const double radius = even(std::pow(10, uniform(random, -12, -0.5)));
  const double x = even(uniform(random, 0.5, 1)),
               y = random() % 2 ? 0 : even(uniform(random, -1, 1));
  const auto arc = [&](double right, double up) -> ProfileEdge {
    return {.kind = ProfileEdge::Kind::kArc,
            .end = {x + radius * right, y + radius * up},
            .control = {x, y}};
  };
  return make_revolution(
      test_support::profile_of({{arc(1, 0), arc(0, 1), arc(-1, 0), arc(0, -1)}}));
}

Primitive random_solid(std::mt19937& random) {
  if (random() % 2) return make_revolution(csgcore::checks::random_profile(random, true));
  constexpr double kScales[][2] = {{1, 1}, {1, 0}, {0, 2}, {0.5, 2}};
  const auto& [bottom, top] = kScales[random() % 4];
  return make_extrusion(csgcore::checks::random_profile(random, false), -1, 2, bottom, top);
}

/// Returns a thin ring, a random solid, or one of the extrusions and revolutions of all tests.
Primitive next_solid(std::mt19937& random) {
  const auto kind = random() % 4;
  if (kind == 0) return thin_ring(random);
  if (kind == 1) return random_solid(random);
  const auto variants =
      test_support::test_kind_of(kind == 2 ? Shape::kExtrusion : Shape::kRevolution).variants();
  test_support::Sizes sizes(random, {.low = 0.5, .high = 2, .even_share = 0.6, .step = 0.25});
  return variants[random() % variants.size()].make(sizes);
}

/// A crossing with a profile's solid takes half as many operations again as one with a convex
/// primitive, for which RayOracle has kRoundings.
constexpr Real kMoreRoundings = 1.5;

class ProfileCrossings : public testing::TestWithParam<int> {};

TEST_P(ProfileCrossings, AreTheExactOnes) {
  const Aim aim = static_cast<Aim>(GetParam());
  std::mt19937 random(5 + static_cast<unsigned>(GetParam()));
  const int targets = test_support::full_run() ? 4000 : 40;
  double worst = 0;
  size_t crossed = 0;
  int too_thin = 0;
  for (int i = 0; i < targets; ++i) {
    SCOPED_TRACE(testing::Message() << "target " << i);
    Primitive primitive = next_solid(random);
    if (!csgcore::is_valid(primitive)) continue;
    const Placement& placement =
        csgcore::checks::kPlacements[random() % std::size(csgcore::checks::kPlacements)];
    const auto map = static_cast<csgcore::checks::MapKind>(random() % csgcore::checks::kMapKinds);
    FrameRays frame;
    frame.pivot = placement.from_world * csgcore::checks::random_direction(random);
    primitive.local_to_world = csgcore::checks::placed(placement, map, frame.pivot, random);
    const CanonicalPrimitive canonical = csgcore::canonicalize(primitive);
    // An extrusion that leans adds a shear to the primitive's map.
    const Real shear =
        condition_of(canonical.canonical_to_world) / condition_of(primitive.local_to_world.linear);
    const csgcore::checks::RayOracle bounds(primitive, frame.pivot);
    const ProfileSurfaces surfaces(primitive, frame.pivot);
    const Target<Exact> target = make_target(primitive, frame.pivot, 1);
    AimedRays rays(primitive, frame.pivot, random);
    std::vector<PivotRay> lanes(kPacketRays);
    for (PivotRay& ray : lanes) ray = rays.next(aim);
    csgcore::CrossingSearch search;
    csgcore::find_all_crossings(frame, csgcore::checks::packet_of(lanes), canonical, search);
    for (uint32_t lane = 0; lane < kPacketRays; ++lane) {
      const PivotRay& ray = lanes[lane];
      const Real bound = kMoreRoundings * shear * bounds.error_bound(ray);
      // To first order distances are right only if they are small.
      constexpr int kFarThinner = 10;
      if (kFarThinner * bound > surfaces.thickness()) {
        ++too_thin;
        continue;
      }
      const auto found = found_stretches(search.lanes[lane].found);
      const auto exact = exact_stretches(target, ray);
      const Real error = disagreement(surfaces, ray, found, exact);
      EXPECT_LE(error, bound) << target.twin->as_cpp(primitive, "map") << "\n"
                              << found << " instead of" << exact << " on " << ray.origin.x << ", "
                              << ray.origin.y << ", " << ray.origin.z << " + t " << ray.direction.x
                              << ", " << ray.direction.y << ", " << ray.direction.z;
      worst = std::max(worst, double(error / bound));
      crossed += found.size();
    }
    if (HasFailure()) return;
  }
  std::printf("%s: %zu stretches, the worst end is off by %.2f roundings; %d rays left out\n",
              test_support::full_run() ? "full run" : "sample", crossed,
              worst * double(kMoreRoundings) * csgcore::checks::kRoundings, too_thin);
  EXPECT_GT(crossed, 10 * static_cast<size_t>(targets));
}

INSTANTIATE_TEST_SUITE_P(, ProfileCrossings, testing::Range(0, kAims),
                         [](const testing::TestParamInfo<int>& aim) {
                           return name_of(static_cast<Aim>(aim.param));
                         });

}  // namespace
}  // namespace oracle
