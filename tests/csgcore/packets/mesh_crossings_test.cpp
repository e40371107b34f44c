// Tests the crossings of rays with triangle meshes against extended precision: each lies at its
// triangle up to the derived bound (NUMERICS.md, "Intersections"), and none is missing or too many
// except where a ray passes an edge within that bound.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <iterator>
#include <limits>

#include "checks.hpp"
#include "placements.hpp"
#include "primitives/intersect.hpp"
#include "ray_oracle.hpp"
#include "special_rays.hpp"
#include "support/full_run.hpp"
#include "support/kinds/mesh_solid.hpp"

namespace csgcore {
namespace {

using checks::LongRay;
using checks::LongVec3;
using checks::PivotRay;
using checks::RayKind;
using checks::Real;
using checks::uniform;
using reference::MeshPassage;
using test_support::Variant;

/// A mesh in the world, relative to a pivot, in extended precision.
class LongMesh {
 public:
  LongMesh(const Primitive& primitive, const Vec3& pivot)
      : mesh_(*primitive.mesh()),
        local_to_world_(primitive.local_to_world.linear),
        world_to_local_(glm::inverse(local_to_world_)),
        pivot_from_origin_(LongVec3(pivot) - LongVec3(primitive.local_to_world.translation)) {}

  LongVec3 to_local(const LongVec3& point) const {
    return world_to_local_ * (point + pivot_from_origin_);
  }
  reference::NearRay to_local(const LongRay& ray) const {
    return {to_local(ray.origin), world_to_local_ * ray.direction};
  }

  /// Returns how far a point on the ray is from the triangle's plane, or beyond the triangle along
  /// the ray if that is further. So far the surface seems displaced.
  Real displacement(const LongRay& ray, uint32_t triangle, Real t) const {
    const LongVec3 point = ray.at(t);
    const LongVec3 corner(mesh_.vertices()[mesh_.triangles()[triangle][0]]);
    // The corners of slivers must not be rounded before they are subtracted.
    const LongVec3 normal = reference::triangle_normal(mesh_, triangle);
    const Real length = glm::length(glm::transpose(world_to_local_) * normal);
    const Real gap = std::abs(glm::dot(normal, to_local(point) - corner));
    return std::max(length > 0 ? gap / length : 0, beyond_range(ray, triangle, point));
  }

  /// Returns how far the ray passes from the triangle's edges.
  Real from_edges(const LongRay& ray, uint32_t triangle) const {
    const LongVec3 along = glm::normalize(ray.direction);
    const auto across = [&](const LongVec3& v) {
      return v - ray.origin - glm::dot(v - ray.origin, along) * along;
    };
    Real nearest = std::numeric_limits<Real>::infinity();
    for (size_t k = 0; k < 3; ++k) {
      const LongVec3 from = across(at(mesh_.triangles()[triangle][k]));
      const LongVec3 edge = across(at(mesh_.triangles()[triangle][(k + 1) % 3])) - from;
      const Real length2 = glm::dot(edge, edge);
      const Real share =
          length2 > 0 ? std::clamp<Real>(-glm::dot(from, edge) / length2, 0, 1) : Real(0);
      nearest = std::min(nearest, glm::length(from + share * edge));
    }
    return nearest;
  }

 private:
  LongVec3 at(uint32_t vertex) const {
    return local_to_world_ * LongVec3(mesh_.vertices()[vertex]) - pivot_from_origin_;
  }
  Real beyond_range(const LongRay& ray, uint32_t triangle, const LongVec3& point) const {
    const LongVec3 along = glm::normalize(ray.direction);
    Real nearest = std::numeric_limits<Real>::infinity(), furthest = -nearest;
    for (const uint32_t vertex : mesh_.triangles()[triangle]) {
      const Real depth = glm::dot(at(vertex) - point, along);
      nearest = std::min(nearest, depth);
      furthest = std::max(furthest, depth);
    }
    return std::max({Real(0), nearest, -furthest});
  }

  const TriangleMesh& mesh_;
  const checks::LongMat3 local_to_world_, world_to_local_;
  const LongVec3 pivot_from_origin_;
};

/// Returns a ray through a vertex, a point of an edge or of a face, in a direction that is often
/// along an edge, a face or an axis; relative to the pivot.
PivotRay ray_at_a_feature(const Primitive& primitive, const Vec3& pivot, std::mt19937& random) {
  const TriangleMesh& mesh = *primitive.mesh();
  const auto triangle = [&] { return mesh.triangles()[random() % mesh.triangles().size()]; };
  const auto vertex = [&](uint32_t i) { return mesh.vertices()[i]; };
  const auto [a, b, c] = triangle();
  const double shares[] = {0, 0.5, uniform(random, 0, 1)};
  const Vec3 on_edge = glm::mix(vertex(a), vertex(b), shares[random() % 3]);
  const Vec3 point = random() % 3 ? on_edge : glm::mix(on_edge, vertex(c), uniform(random, 0, 1));
  Vec3 direction = checks::random_direction(random);
  switch (random() % 5) {
    case 0:
      direction = vertex(b) - vertex(a);
      break;
    case 1:
      direction = glm::mix(vertex(b), vertex(c), uniform(random, -1, 2)) - vertex(a);
      break;
    case 2:
      direction = Vec3(0.0);
      direction[static_cast<int>(random() % 3)] = random() % 2 ? 1 : -1;
      break;
    case 3:
      direction = vertex(triangle()[0]) - point;
      break;
  }
  if (direction == Vec3(0.0)) direction = {0, 0, 1};
  const Affine& map = primitive.local_to_world;
  const Vec3 along = map.direction(direction);
  const Vec3 at = map.direction(point) + (map.translation - pivot);
  return {at - uniform(random, -3, 3) * along, along};
}

/// The kinds of checks::RayKind, and rays at features of the mesh.
class MeshCrossingsOf : public testing::TestWithParam<int> {};

TEST_P(MeshCrossingsOf, RaysAreThoseOfExtendedPrecision) {
  std::mt19937 random(3);
  double worst = 0;
  int crossed = 0, at_edges = 0;
  for (int round = 0; round < (test_support::full_run() ? 20 : 1); ++round) {
    for (const checks::Placement& placement : checks::kPlacements) {
      SCOPED_TRACE(placement.name);
      for (const Variant& variant : test_support::test_kind_of(Shape::kMesh).variants()) {
        SCOPED_TRACE(variant.name);
        const auto map = static_cast<checks::MapKind>(random() % checks::kMapKinds);
        SCOPED_TRACE(static_cast<int>(map));
        test_support::Sizes sizes(random, {.low = 0.5, .high = 2});
        Primitive primitive = variant.make(sizes);
        FrameRays frame;
        frame.pivot = placement.from_world * checks::random_direction(random);
        primitive.local_to_world = checks::placed(placement, map, frame.pivot, random);
        ASSERT_TRUE(is_valid(primitive));
        std::vector<PivotRay> rays;
        if (GetParam() < checks::kRayKinds) {
          rays = checks::SpecialRays(primitive, frame.pivot, random)
                     .next(static_cast<RayKind>(GetParam()));
        } else {
          while (rays.size() < kPacketRays) {
            rays.push_back(ray_at_a_feature(primitive, frame.pivot, random));
          }
        }
        CrossingSearch search;
        find_all_crossings(frame, checks::packet_of(rays), canonicalize(primitive), search);
        const checks::RayOracle oracle(primitive, frame.pivot);
        const LongMesh mesh(primitive, frame.pivot);
        for (uint32_t lane = 0; lane < kPacketRays; ++lane) {
          const LongRay ray = rays[lane];
          const Real bound = oracle.error_bound(ray);
          std::vector<uint32_t> expected, found;
          for (const MeshPassage& passage :
               reference::passages(*primitive.mesh(), mesh.to_local(ray))) {
            expected.push_back(passage.triangle);
          }
          int turns = 0;
          for (const Crossing& crossing : search.lanes[lane].found) {
            turns += crossing.turn;
            found.push_back(crossing.face);
            const Real off = mesh.displacement(ray, crossing.face, crossing.t);
            worst = std::max(worst, static_cast<double>(off / bound));
            if (off > bound) {
              const auto& tr = primitive.mesh()->triangles()[crossing.face];
              const auto nl = mesh.to_local(ray);
              auto seen = reference::passages(*primitive.mesh(), nl);
              printf("off %Lg bound %Lg t %g edges %Lg\n", off, bound, crossing.t,
                     mesh.from_edges(ray, crossing.face));
              printf("local o %.17Lg %.17Lg %.17Lg d %.17Lg %.17Lg %.17Lg\n", nl.origin.x,
                     nl.origin.y, nl.origin.z, nl.direction.x, nl.direction.y, nl.direction.z);
              for (auto v : tr) {
                auto p = primitive.mesh()->vertices()[v];
                printf("  v %.17g %.17g %.17g\n", p.x, p.y, p.z);
              }
              for (auto p : seen)
                printf("  expected %Lg tri %u turn %d\n", p.t, p.triangle, p.turn);
              for (auto p : search.lanes[lane].found)
                printf("  found %g tri %u turn %d\n", p.t, p.face, p.turn);
            }
            ASSERT_LE(off, bound) << "triangle " << crossing.face;
          }
          ASSERT_EQ(turns, 0);
          crossed += !found.empty();
          std::sort(expected.begin(), expected.end());
          std::sort(found.begin(), found.end());
          std::vector<uint32_t> different;
          std::set_symmetric_difference(expected.begin(), expected.end(), found.begin(),
                                        found.end(), std::back_inserter(different));
          at_edges += !different.empty();
          for (const uint32_t triangle : different) {
            worst = std::max(worst, static_cast<double>(mesh.from_edges(ray, triangle) / bound));
            ASSERT_LE(mesh.from_edges(ray, triangle), bound) << "triangle " << triangle;
          }
        }
      }
    }
  }
  EXPECT_GT(crossed, 500);
  std::printf("%d crossed, %d of them otherwise at an edge; the worst is off by %.2f roundings\n",
              crossed, at_edges, worst * checks::kRoundings);
}

INSTANTIATE_TEST_SUITE_P(Packets, MeshCrossingsOf, testing::Range(0, checks::kRayKinds + 1),
                         [](const testing::TestParamInfo<int>& kind) -> std::string {
                           if (kind.param == checks::kRayKinds) return "AtFeatures";
                           return checks::name_of(static_cast<RayKind>(kind.param));
                         });

}  // namespace
}  // namespace csgcore
