// Tests parts that share planes, and plates behind each other: what a face hides is left out of
// tiles (TileCuller::cut_by_face), and the picture stays the same.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <random>

#include "checks.hpp"
#include "csgcore/polyhedron.hpp"
#include "csgcore/tracer.hpp"
#include "support/full_run.hpp"
#include "support/models.hpp"
#include "trace_scenes.hpp"
#include "whole_list.hpp"

namespace csgcore {
namespace {

using checks::uniform;

/// A rotation about a random axis, or none.
Mat3 random_turn(std::mt19937& random) {
  if (random() % 2 == 0) return Mat3(1.0);
  const Vec3 x = checks::random_direction(random);
  const Vec3 y = glm::normalize(glm::cross(x, checks::random_direction(random)));
  return {x, y, glm::cross(x, y)};
}

/// Builds boxes, prisms and cylinders in one frame, with few planes, so that many coincide.
class Builder {
 public:
  explicit Builder(uint32_t seed) : random_(seed), turn_(random_turn(random_)) {}

  Scene scene() {
    builder_.open(Op::kUnion);
    const uint32_t count = 3 + random_() % 60;
    for (uint32_t i = 0; i < count; ++i) {
      if (random_() % 12 == 0) {
        builder_.open(random_() % 2 ? Op::kDifference : Op::kIntersection);
        for (uint32_t k = 2 + random_() % 3; k-- > 0;) add_part();
        builder_.close();
      } else {
        add_part();
      }
    }
    builder_.close();
    scene_.model = builder_.finish();
    return std::move(scene_);
  }

 private:
  int whole(int from, int to) {
    return from + static_cast<int>(random_() % uint32_t(to - from + 1));
  }

  void add_part() {
    const Vec3 at{whole(-3, 3), whole(-3, 3), whole(-1, 1)};
    const double height = random_() % 4 == 0 ? 0.01 : whole(1, 3);
    // Some parts lie on their side.
    const Mat3 local =
        random_() % 5 == 0 ? Mat3{Vec3(0, 1, 0), Vec3(0, 0, 1), Vec3(1, 0, 0)} : Mat3(1.0);
    const Affine to_world{turn_ * local, turn_ * at};
    Primitive part;
    const double radius = whole(1, 3);
    switch (random_() % 4) {
      case 0:
        part = make_polyhedron(Polyhedron::frustum(0, height, radius, radius, 6), to_world);
        break;
      case 1:
        part = make_frustum(0, height, radius, random_() % 2 ? radius : 0.5 * radius, to_world);
        break;
      default:
        part = make_polyhedron(Polyhedron::box({Vec3(0.0), Vec3(whole(1, 5), whole(1, 5), height)}),
                               to_world);
    }
    part.id = static_cast<uint32_t>(scene_.primitives.size());
    builder_.primitive(part.id);
    scene_.primitives.push_back(part);
  }

  std::mt19937 random_;
  const Mat3 turn_;
  Scene scene_;
  CsgTreeBuilder builder_;
};

TEST(FlushParts, AreDrawnAsByTheWholeList) {
  const uint32_t rounds = test_support::full_run() ? 2000 : 60;
  uint64_t hits = 0;
  uint64_t coincident = 0;
  for (uint32_t seed = 1; seed <= rounds; ++seed) {
    SCOPED_TRACE(seed);
    const Scene scene = Builder(seed).scene();
    const Solid solid(canonical_primitives(scene), scene.model);
    if (solid.bounds().empty()) continue;
    std::mt19937 random(seed);
    const Vec3 towards = random() % 4 == 0 ? Vec3(0, 0, -1) : checks::random_direction(random);
    View view = checks::view_of(solid.bounds(), towards, uniform(random, 0.5, 4));
    view.projection = random() % 2 ? Projection::kPerspective : Projection::kOrthographic;
    if (view.projection == Projection::kOrthographic) {
      view.half_height = 0.6 * solid.bounds().diagonal();
    }
    view.width_px = 40 + random() % 100;
    view.height_px = 40 + random() % 100;
    for (const Boundary boundary : {Boundary::kFirst, Boundary::kBehind}) {
      TraceOptions options;
      options.boundary = boundary;
      TraceStats stats;
      Hits by_tiles;
      trace(solid, view, options, by_tiles, stats);
      ASSERT_TRUE(checks::same_bits(by_tiles, checks::WholeList(solid, view, boundary).picture()));
      hits += checks::count_hits(by_tiles);
      coincident += stats.resolved_rays;
    }
  }
  EXPECT_GT(hits, 1000 * rounds);
  EXPECT_GT(coincident, 100 * rounds);
}

/// Returns the intersections per ray that hits, in a picture of `count` plates.
double intersections_per_ray(const std::function<Primitive(int)>& plate, int count) {
  std::vector<Primitive> plates;
  for (int i = 0; i < count; ++i) plates.push_back(plate(i));
  const Scene scene = test_support::scene_of(Op::kUnion, std::move(plates));
  const Solid solid(canonical_primitives(scene), scene.model);
  View view = checks::view_of(solid.bounds(), glm::normalize(Vec3(-0.4, 0.6, -0.7)), 4);
  view.width_px = 320;
  view.height_px = 240;
  Hits hits;
  TraceStats stats;
  trace(solid, view, {}, hits, stats);
  EXPECT_TRUE(checks::same_bits(hits, checks::WholeList(solid, view).picture()));
  EXPECT_GT(stats.rays, 1000u);
  return static_cast<double>(stats.intersections) / static_cast<double>(stats.rays);
}

/// A rotation about z by so many degrees.
Affine turned(double degrees) {
  const double c = std::cos(degrees * 0.017453292519943295);
  const double s = std::sin(degrees * 0.017453292519943295);
  return {Mat3{Vec3(c, s, 0), Vec3(-s, c, 0), Vec3(0, 0, 1)}, Vec3(0.0)};
}

TEST(FlushParts, CostLittleMoreThanWhatIsSeen) {
  const auto flush = [](int i) {
    return make_polyhedron(Polyhedron::box({Vec3(0.0), Vec3(60, 60, 5)}),
                           checks::moved({0.1 * i, 0.06 * i, 0}));
  };
  const auto nested = [](int i) {
    return make_polyhedron(Polyhedron::frustum(0, 4 + 0.01 * i, 10, 10, 6));
  };
  const auto spokes = [](int i) {
    return make_polyhedron(Polyhedron::box({Vec3(-20, -2, 0), Vec3(20, 2, 4)}), turned(0.7 * i));
  };
  EXPECT_LT(intersections_per_ray(flush, 200), 40);
  EXPECT_LT(intersections_per_ray(nested, 200), 12);
  EXPECT_LT(intersections_per_ray(spokes, 200), 60);
}

}  // namespace
}  // namespace csgcore
