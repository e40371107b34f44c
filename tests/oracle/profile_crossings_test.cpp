// Tests the crossings of rays with extruded and revolved profiles against exact ones: wherever a ray
// is inside by the one and outside by the other, it is next to the surface, up to the derived bound
// (NUMERICS.md, "Profiles").
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <sstream>
#include <glm/geometric.hpp>
#include <iterator>
#include <limits>
#include <numbers>
#include <vector>

#include "checks.hpp"
#include "exact_primitive.hpp"
#include "exact_profile.hpp"
#include "placements.hpp"
#include "primitives/intersect.hpp"
#include "profile_figures.hpp"
#include "ray_oracle.hpp"
#include "support/full_run.hpp"
#include "support/kinds/profile_figure.hpp"
#include "support/test_profiles.hpp"

namespace oracle {
namespace {

using csgcore::Affine;
using csgcore::CanonicalPrimitive;
using csgcore::FrameRays;
using csgcore::kPacketRays;
using csgcore::LongVec3;
using csgcore::Primitive;
using csgcore::Profile;
using csgcore::ProfileEdge;
using csgcore::ProfileLoop;
using csgcore::Real;
using csgcore::Vec2;
using csgcore::Vec3;
using csgcore::checks::EdgePoint;
using csgcore::checks::LongRay;
using csgcore::checks::MapKind;
using csgcore::checks::PivotRay;
using csgcore::checks::Placement;
using csgcore::checks::RayOracle;
using csgcore::checks::uniform;
using csgcore::Shape;

// --- Rays ---

enum class Aim {
  kAny,
  kAtAVertex,
  kTangent,
  kGrazing,  // tangent, but for some roundings to a millionth of the size
  kAlongAxis,
  kThroughAxis,
  kLevel,
  kToAnotherPoint,
  kFromFarAway,
};
constexpr int kAims = 9;
constexpr const char* kAimNames[kAims] = {"Any",         "AtAVertex", "Tangent",
                                          "Grazing",     "AlongAxis", "ThroughAxis",
                                          "Level",       "ToAnotherPoint", "FromFarAway"};

/// A place of the solid's surface, in local space: a point, two directions that touch the surface
/// there, and its normal.
struct Place {
  Vec3 point, up, around, normal;
};

Place revolved_place(const Vec2& at, const Vec2& tangent, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {{c * at.x, s * at.x, at.y},
          {c * tangent.x, s * tangent.x, tangent.y},
          {-s, c, 0},
          {c * tangent.y, s * tangent.y, -tangent.x}};
}

Place extruded_place(const Primitive& primitive, const Vec2& at, const Vec2& tangent, double share) {
  const double scale = primitive.r_bottom + share * (primitive.r_top - primitive.r_bottom);
  const double height = primitive.z_max - primitive.z_min;
  const Vec3 point{scale * at.x, scale * at.y, primitive.z_min + share * height};
  const Vec3 leading{(primitive.r_top - primitive.r_bottom) * at.x,
                     (primitive.r_top - primitive.r_bottom) * at.y, height};
  const Vec3 along{tangent.x, tangent.y, 0};
  return {point, glm::normalize(leading), along, glm::normalize(glm::cross(along, leading))};
}

class Rays {
 public:
  Rays(const Primitive& primitive, const Vec3& pivot, std::mt19937& random)
      : primitive_(primitive), pivot_(pivot), random_(random) {
    const Profile& profile = *primitive.profile;
    size_ = std::max(profile.half().x, profile.half().y);
  }

  PivotRay next(Aim aim) {
    const Place place = next_place(aim == Aim::kAtAVertex);
    Vec3 point = place.point, direction = csgcore::checks::random_direction(random_);
    double furthest = 3;
    switch (aim) {
      case Aim::kAny:
      case Aim::kAtAVertex:
        break;
      case Aim::kTangent:
        direction = touching(place);
        break;
      case Aim::kGrazing:
        direction = touching(place);
        point += near_miss() * place.normal;
        break;
      case Aim::kAlongAxis:
        direction = {0, 0, random_() % 2 ? 1 : -1};
        if (random_() % 3 == 0) point += std::pow(10, uniform(random_, -17, 0)) * size_ * place.normal;
        if (random_() % 2) direction += std::pow(10, uniform(random_, -20, -2)) * csgcore::checks::random_direction(random_);
        break;
      case Aim::kThroughAxis:
        direction = Vec3(0, 0, next_place(false).point.z) - point;
        if (random_() % 2) direction += near_miss() * csgcore::checks::random_direction(random_);
        break;
      case Aim::kLevel:
        direction.z = random_() % 2 ? 0 : std::pow(10, uniform(random_, -20, -2));
        if (random_() % 2) direction = place.around + direction.z * Vec3(0, 0, 1);
        if (random_() % 4 == 0) direction = Vec3(1, 0, direction.z);
        break;
      case Aim::kToAnotherPoint:
        direction = next_place(random_() % 2).point - point;
        break;
      case Aim::kFromFarAway:
        furthest = std::pow(10, uniform(random_, 1, 6));
        if (random_() % 2) direction = touching(place);
        break;
    }
    if (!(glm::length(direction) > 0)) direction = {1, 0, 0};
    direction = glm::normalize(direction);
    const Affine& map = primitive_.local_to_world;
    const Vec3 along = std::pow(10, uniform(random_, -2, 2)) * map.direction(direction);
    const Vec3 at = map.direction(point) + (map.translation - pivot_);
    const double reach = (glm::length(point) + size_) / glm::length(along) *
                         glm::length(map.direction(direction));
    if (random_() % 3 == 0 && aim != Aim::kFromFarAway) return {at, along};
    return {at - uniform(random_, -furthest, furthest) * reach * along, along};
  }

 private:
  Vec3 touching(const Place& place) {
    const int kind = static_cast<int>(random_() % 4);
    if (kind == 0) return place.up;
    if (kind == 1) return place.around;
    const double lean = kind == 2 ? uniform(random_, -2, 2) : std::pow(10, uniform(random_, -9, 0));
    return random_() % 2 ? place.around + lean * place.up : place.up + lean * place.around;
  }
  double near_miss() {
    return (random_() % 2 ? 1 : -1) * size_ * std::pow(10, uniform(random_, -17, -3));
  }
  Place next_place(bool is_vertex) {
    const auto loops = primitive_.profile->loops();
    const ProfileLoop& loop = loops[random_() % loops.size()];
    const size_t i = random_() % loop.size();
    const Vec2 start = i == 0 ? loop.back().end : loop[i - 1].end;
    const double at = is_vertex ? double(random_() % 2) : uniform(random_, 0, 1);
    const EdgePoint edge = csgcore::checks::edge_point(start, loop[i], at);
    const Vec2 tangent = glm::normalize(edge.tangent);
    if (primitive_.shape == Shape::kRevolution) {
      return revolved_place(edge.place, tangent, random_() % 3 ? uniform(random_, 0, 6) : 0);
    }
    return extruded_place(primitive_, edge.place, tangent,
                          random_() % 3 ? uniform(random_, 0, 1) : double(random_() % 2));
  }

  const Primitive& primitive_;
  const Vec3 pivot_;
  std::mt19937& random_;
  double size_;
};

// --- Comparison ---

struct Stretch {
  Real begin, end;
};

/// The faces of a profile's solid in world space.
class Surfaces {
 public:
  Surfaces(const Primitive& primitive, const Vec3& pivot)
      : primitive_(primitive),
        figure_(*primitive.profile),
        world_to_local_(glm::inverse(LongMat3(primitive.local_to_world.linear))),
        pivot_(LongVec3(pivot) - LongVec3(primitive.local_to_world.translation)) {}

  void dump(const LongVec3& point) const {
    const LongVec3 local = world_to_local_ * (point + pivot_);
    const LongVec2 place{std::hypot(local.x, local.y), local.z};
    std::printf("local %.17g %.17g %.17g contains %d:", double(local.x), double(local.y), double(local.z), figure_.contains(place));
    for (const FigureEdge& edge : figure_.edges()) std::printf(" %.3g", double(gap(edge, place).outside));
    std::printf("\n");
  }
  /// Returns how far a point, relative to the pivot, is from the nearest face, to first order.
  Real distance(const LongVec3& point) const {
    const LongVec3 local = world_to_local_ * (point + pivot_);
    return primitive_.shape == Shape::kRevolution ? from_revolution(local) : from_extrusion(local);
  }

 private:
  using LongMat3 = csgcore::checks::LongMat3;
  using LongVec2 = csgcore::reference::LongVec2;
  using FigureEdge = csgcore::reference::FigureEdge;

  /// Returns the length in world space of `outside` along a unit gradient of local space.
  Real in_world(Real outside, const LongVec3& gradient) const {
    return outside / glm::length(glm::transpose(world_to_local_) * gradient);
  }
  struct Gap {
    Real outside;
    LongVec2 outwards;
  };
  static Gap gap(const FigureEdge& edge, const LongVec2& place) {
    const LongVec2 nearest = edge.nearest(place);
    LongVec2 away = place - nearest;
    const Real distance = glm::length(away);
    // A Bézier curve may be straight.
    const LongVec2 chord = edge.end - edge.start, slope = edge.gradient(nearest);
    const LongVec2 normal = glm::normalize(glm::length(slope) > 0 ? slope : LongVec2(chord.y, -chord.x));
    // Next to the edge rounding leaves nothing of the direction.
    constexpr Real kNear = Real(1e-14);
    const Real along = std::abs(glm::dot(away, normal));
    if (along >= Real(0.999) * distance || distance < kNear * glm::length(place)) {
      return {distance, normal};
    }
    return {distance, away / distance};
  }
  Real from_revolution(const LongVec3& p) const {
    const LongVec2 place{std::hypot(p.x, p.y), p.z};
    const LongVec2 across = place.x > 0 ? LongVec2(p) / place.x : LongVec2(1, 0);
    Real least = std::numeric_limits<Real>::infinity();
    for (const FigureEdge& edge : figure_.edges()) {
      if (edge.is_line() && edge.start.x == 0 && edge.end.x == 0) continue;
      const Gap near = gap(edge, place);
      least = std::min(least, in_world(near.outside, {near.outwards.x * across.x,
                                                      near.outwards.x * across.y, near.outwards.y}));
    }
    return least;
  }
  Real from_extrusion(const LongVec3& p) const {
    const Real growth = (Real(primitive_.r_top) - primitive_.r_bottom) /
                        (Real(primitive_.z_max) - primitive_.z_min);
    const Real scale = primitive_.r_bottom + growth * (p.z - primitive_.z_min);
    const Real beyond = std::max(primitive_.z_min - p.z, p.z - primitive_.z_max);
    const LongVec3 up(0, 0, 1);
    const Real from_cap = in_world(std::abs(beyond), up);
    if (!(scale > 0)) return from_cap;
    const LongVec2 place = LongVec2(p) / scale;
    Real beside = std::numeric_limits<Real>::infinity();
    for (const FigureEdge& edge : figure_.edges()) {
      const auto [outside, outwards] = gap(edge, place);
      const Real rise = growth * (outside - glm::dot(outwards, place));
      beside = std::min(beside, in_world(scale * outside, {outwards.x, outwards.y, rise}));
    }
    return std::min(std::max(beside, beyond > 0 ? from_cap : Real(0)),
                    figure_.contains(place) ? from_cap : std::max(from_cap, beside));
  }

  const Primitive& primitive_;
  const csgcore::reference::Figure figure_;
  const LongMat3 world_to_local_;
  const LongVec3 pivot_;
};

/// A solid that rays are compared with.
class Judge {
 public:
  Judge(const Primitive& primitive, const Vec3& pivot)
      : target_(make_target(primitive, pivot, 1)),
        near_(primitive, pivot),
        surface_(primitive, pivot) {
    const CanonicalPrimitive canonical = csgcore::canonicalize(primitive);
    shear_ = condition(canonical.canonical_to_world) / condition(primitive.local_to_world.linear);
  }
  static Real condition(const csgcore::Mat3& map) {
    const csgcore::checks::LongMat3 m(map), inverse = glm::inverse(m);
    Real largest = 0;
    for (int row = 0; row < 3; ++row) {
      Real sum = 0;
      for (int i = 0; i < 3; ++i) for (int k = 0; k < 3; ++k) sum += std::abs(m[k][row]) * std::abs(inverse[i][k]);
      largest = std::max(largest, sum);
    }
    return largest;
  }

  /// Returns the ray's stretches within the solid.
  std::vector<Stretch> stretches(const PivotRay& ray) const {
    NearRay<Exact> near;
    for (int i = 0; i < 3; ++i) near.origin[i] = ray.origin[i], near.direction[i] = ray.direction[i];
    const double base = base_of(ray);
    std::vector<Stretch> result;
    for (const ProfileSegment& segment :
         target_.profile->segments(localize(target_, near, base))) {
      result.push_back({value(segment.begin.t, base), value(segment.end.t, base)});
    }
    return result;
  }

  /// Returns the largest distance from the surface of places of the ray that are inside by the one
  /// and outside by the other, in units of the bound.
  double error(const LongRay& ray, const std::vector<Stretch>& a,
               const std::vector<Stretch>& b) const {
    std::vector<Real> ends;
    for (const auto* stretches : {&a, &b}) {
      for (const Stretch& stretch : *stretches) {
        ends.push_back(stretch.begin), ends.push_back(stretch.end);
      }
    }
    std::sort(ends.begin(), ends.end());
    Real worst = 0;
    for (size_t i = 0; i + 1 < ends.size(); ++i) {
      if (!(ends[i] < ends[i + 1])) continue;
      const Real middle = ends[i] + (ends[i + 1] - ends[i]) / 2;
      if (holds(a, middle) == holds(b, middle)) continue;
      constexpr int kParts = 6;
      for (int k = 0; k <= kParts; ++k) {
        const Real t = ends[i] + (ends[i + 1] - ends[i]) * k / kParts;
        worst = std::max(worst, surface_.distance(ray.at(t)));
        if (std::getenv("DUMP") && surface_.distance(ray.at(t)) > std::atof(std::getenv("DUMP"))*near_.error_bound(ray)) { std::printf("at %.17g of [%.17g %.17g]: ", double(t), double(ends[i]), double(ends[i+1])); surface_.dump(ray.at(t)); }
      }
    }
    return double(worst / bound(ray));
  }
  Real bound(const LongRay& ray) const { return shear_ * near_.error_bound(ray); }

 private:
  static Real value(const ExactRoot& t, double base) {
    // A number of the grid has no root.
    const double high = CGAL::to_double(t.p);
    const double low = CGAL::to_double(Exact(t.p - Exact(high)));
    return Real(base) + high + low;
  }
  static bool holds(const std::vector<Stretch>& stretches, Real t) {
    return std::any_of(stretches.begin(), stretches.end(),
                       [&](const Stretch& s) { return s.begin < t && t < s.end; });
  }
  double base_of(const PivotRay& ray) const {
    const RoundingUp rounding_up;
    NearRay<Interval> near;
    for (int i = 0; i < 3; ++i) near.origin[i] = ray.origin[i], near.direction[i] = ray.direction[i];
    return oracle::base_of(enclose(target_), near);
  }

  const Target<Exact> target_;
  const RayOracle near_;
  Real shear_;
  const Surfaces surface_;
};

std::vector<Stretch> found_stretches(const csgcore::CrossingSearch::Lane& lane) {
  std::vector<Stretch> result;
  int winding = 0;
  double start = 0;
  for (const csgcore::Crossing& crossing : lane.found) {
    if (winding == 0) start = crossing.t;
    winding += crossing.turn;
    if (winding == 0 && start < crossing.t) result.push_back({start, crossing.t});
  }
  EXPECT_EQ(winding, 0);
  return result;
}

// --- Solids ---

Primitive thin_ring(std::mt19937& random) {
  const double share = std::pow(10, uniform(random, -12, 0));
  const double z = random() % 2 ? 0 : uniform(random, -2, 2);
  std::vector<ProfileLoop> loops{csgcore::checks::circle({1 + share, z}, share, 2 + int(random() % 3), random() % 2,
                              random() % 2)};
  return csgcore::make_revolution(test_support::profile_of(loops));
}
Primitive random_solid(std::mt19937& random) {
  if (random() % 2) return csgcore::make_revolution(csgcore::checks::random_profile(random, true));
  const double scales[] = {1, 0, 0.5, 2};
  const double bottom = random() % 2 ? 1 : scales[random() % 4];
  const double top = bottom == 0 ? 1 : random() % 2 ? bottom : scales[random() % 4];
  return csgcore::make_extrusion(csgcore::checks::random_profile(random, false), -1, 2, bottom, top);
}

class ProfileCrossings : public testing::TestWithParam<int> {};

struct Tally { double worst = 0; int crossed = 0; std::string what; };

TEST_P(ProfileCrossings, AreExact) {
  const Aim aim = static_cast<Aim>(GetParam());
  std::mt19937 random(5 + unsigned(GetParam()));
  std::vector<std::pair<const char*, std::function<Primitive()>>> makers{
      {"thin ring", [&] { return thin_ring(random); }},
      {"random", [&] { return random_solid(random); }}};
  for (const auto& variant : test_support::all_variants()) {
    std::mt19937 probe(1);
    test_support::Sizes s0(probe);
    const Shape shape = variant.make(s0).shape;
    if (shape != Shape::kExtrusion && shape != Shape::kRevolution) continue;
    makers.push_back({variant.name, [&random, make = variant.make] {
      test_support::Sizes sizes(random, {.low = 0.5, .high = 2, .even_share = 0.6, .step = 0.25});
      return make(sizes); }});
  }
  const int rounds = test_support::full_run() ? 30 : 2;
  double worst_all = 0;
  for (const auto& [name, make] : makers) {
    Tally tally; int over[4] = {}; int total = 0;
    for (int round = 0; round < rounds; ++round)
      for (const Placement& placement : csgcore::checks::kPlacements)
        for (int map = 0; map < csgcore::checks::kMapKinds; ++map) {
          Primitive primitive = make();
          if (!csgcore::is_valid(primitive)) continue;
          FrameRays frame;
          frame.pivot = placement.from_world * csgcore::checks::random_direction(random);
          primitive.local_to_world = csgcore::checks::placed(placement, MapKind(map), frame.pivot, random);
          const Judge judge(primitive, frame.pivot);
          const CanonicalPrimitive canonical = csgcore::canonicalize(primitive);
          Rays rays(primitive, frame.pivot, random);
          std::vector<PivotRay> lanes(kPacketRays);
          for (PivotRay& ray : lanes) ray = rays.next(aim);
          csgcore::CrossingSearch search;
          csgcore::find_all_crossings(frame, csgcore::checks::packet_of(lanes), canonical, search);
          for (uint32_t lane = 0; lane < kPacketRays; ++lane) {
            const auto found = found_stretches(search.lanes[lane]);
            const auto exact = judge.stretches(lanes[lane]);
            const double error = judge.error(lanes[lane], found, exact) * 4;
            ++total;
            tally.crossed += found.size();
            over[0] += error > 4; over[1] += error > 100; over[2] += error > 1e4;
            if (error > tally.worst) {
              tally.worst = error;
              std::ostringstream os; os.precision(17);
              os << placement.name << " map " << map << " bound " << double(judge.bound(lanes[lane]));
              os << " share " << primitive.profile->radii().y;
              os << " found";
              for (auto& s : found) os << " [" << double(s.begin) << "," << double(s.end) << "]";
              os << " exact";
              for (auto& s : exact) os << " [" << double(s.begin) << "," << double(s.end) << "]";
              tally.what = os.str();
              if (std::getenv("DUMP") && error > std::atof(std::getenv("DUMP"))) {
                std::ostringstream e; e.precision(17);
                e << name << " " << kAimNames[GetParam()] << " error " << error << " shape " << int(primitive.shape) << " fill " << int(primitive.profile->fill_rule()) << " scales " << primitive.r_bottom << " " << primitive.r_top << "\n";
                for (auto& loop : primitive.profile->loops()) { e << " loop\n"; for (auto& x : loop) e << "   " << int(x.kind) << " ccw " << x.is_counterclockwise << " end " << x.end.x << "," << x.end.y << " c " << x.control.x << "," << x.control.y << "\n"; }
                std::printf("%s%s\n\n", e.str().c_str(), tally.what.c_str());
              }
            }
          }
        }
    worst_all = std::max(worst_all, tally.worst);
    std::printf("%-14s %-22s worst %12.4g roundings, %d over 4, %d over 100, %d over 1e4 of %d, %d crossed; %s\n", kAimNames[GetParam()], name, tally.worst, over[0], over[1], over[2], total, tally.crossed, tally.worst > 4 ? tally.what.c_str() : "");
  }
  EXPECT_LT(worst_all, 4);
}

INSTANTIATE_TEST_SUITE_P(Profiles, ProfileCrossings, testing::Range(0, kAims),
                         [](const testing::TestParamInfo<int>& aim) {
                           return std::string(kAimNames[aim.param]);
                         });

}  // namespace
}  // namespace oracle
