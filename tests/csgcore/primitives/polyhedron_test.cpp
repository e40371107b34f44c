// Tests the hierarchies of convex polyhedra against all of their faces and vertices.
#include "csgcore/polyhedron.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "checks.hpp"
#include "packets/packet.hpp"
#include "primitives/intersect.hpp"

namespace csgcore {
namespace {

using Entry = Polyhedron::Entry;
using Shared = std::shared_ptr<const Polyhedron>;

struct Named {
  const char* name;
  Shared polyhedron;
};

std::vector<Named> all_kinds() {
  return {{"cube", Polyhedron::box({Vec3(-1), Vec3(1)})},
          {"plate", Polyhedron::box({Vec3(3), Vec3(4, 8, 3 + 1e-7)})},
          {"octahedron", test_support::octahedron()},
          {"triangular prism", Polyhedron::frustum(0, 1, 2, 2, 3)},
          {"hexagonal prism", Polyhedron::frustum(-4, 1, 2, 2, 6)},
          {"pyramid", Polyhedron::frustum(0, 3, 1, 0, 4)},
          {"pyramid upside down", Polyhedron::frustum(0, 3, 0, 1, 7)},
          {"cylinder", Polyhedron::frustum(0, 1e-3, 5, 5, 200)},
          {"frustum", Polyhedron::frustum(-1, 1, 1, 0.2, 90)},
          {"sphere of 3", Polyhedron::sphere(2, 3)},
          {"sphere of 5", Polyhedron::sphere(2, 5)},
          {"sphere of 48", Polyhedron::sphere(0.1, 48)},
          {"sphere of 200", Polyhedron::sphere(10, 200)}};
}

std::vector<Vec3> faces_of(const Polyhedron& polyhedron) {
  std::vector<Vec3> faces;
  for (const Entry& entry : polyhedron.entries()) {
    if (entry.skip == 0) faces.push_back(entry.normal);
  }
  return faces;
}

Vec3 canonical(const Polyhedron& polyhedron, const Vec3& local) {
  return (local - polyhedron.canonical().center) / polyhedron.canonical().scale;
}

bool is_enclosed(const Polyhedron& polyhedron, const Vec3& p) {
  const Polyhedron::Canonical& quadric = polyhedron.canonical();
  if (!quadric.in_frustum) return glm::length(p) <= 1;
  return std::abs(p.z) <= 1 &&
         std::hypot(p.x, p.y) <= quadric.radius_mid + quadric.radius_slope * p.z;
}

/// Distances from faces in canonical space, where a polyhedron has a size of about 1: the rounding
/// of a face and a vertex, which gives up to 4.4e-16 here, with room; and what is still taken for a
/// touch.
constexpr double kRounding = 1e-13, kTouch = 1e-12;

TEST(Polyhedron, FacesAreTheHalfSpaces) {
  for (const auto& [name, polyhedron] : all_kinds()) {
    const std::vector<HalfSpace>& half_spaces = polyhedron->half_spaces();
    const std::vector<Vec3> faces = faces_of(*polyhedron);
    ASSERT_EQ(faces.size(), half_spaces.size()) << name;
    for (const Vec3& vertex : polyhedron->vertices()) {
      const Vec3 p = canonical(*polyhedron, vertex);
      EXPECT_TRUE(is_enclosed(*polyhedron, p)) << name;
      int touching = 0;
      double furthest = -std::numeric_limits<double>::infinity();
      for (const Vec3& face : faces) {
        const double beyond = (glm::dot(face, p) - 1) / glm::length(face);
        furthest = std::max(furthest, beyond);
        touching += beyond > -kTouch;
      }
      EXPECT_LE(furthest, kRounding) << name;
      EXPECT_GE(touching, 3) << name;
    }
  }
}

/// The tracer relies on it that a branch which is skipped has no face that matters.
TEST(Polyhedron, BranchesImplyTheirFaces) {
  std::mt19937 random(1);
  for (const auto& [name, polyhedron] : all_kinds()) {
    const std::vector<Entry>& entries = polyhedron->entries();
    int passed_over = 0;
    for (int round = 0; round < 200; ++round) {
      // Points near the surface, where it matters.
      const Vec3 face = polyhedron->face_towards(checks::random_direction(random));
      Vec3 p = checks::random_point(random, {Vec3(-1), Vec3(1)});
      const double reach = glm::dot(face, p);
      if (reach > 0 && round % 2 == 0) p *= checks::uniform(random, 0.99, 1.01) / reach;
      if (!is_enclosed(*polyhedron, p)) continue;
      for (size_t i = 0; i < entries.size(); ++i) {
        if (entries[i].skip == 0 || glm::dot(entries[i].normal, p) > entries[i].limit) continue;
        for (size_t k = i + 1; k <= i + entries[i].skip; ++k) {
          if (entries[k].skip == 0) {
            ASSERT_LT(glm::dot(entries[k].normal, p), 1) << name;
          }
        }
        passed_over += 1;
        i += entries[i].skip;
      }
    }
    if (entries.size() > 20) {
      EXPECT_GT(passed_over, 50) << name;
    }
  }
}

TEST(Polyhedron, AnswersAreThoseOfAllFacesAndVertices) {
  std::mt19937 random(2);
  for (const auto& [name, polyhedron] : all_kinds()) {
    const std::vector<Vec3> faces = faces_of(*polyhedron);
    for (int round = 0; round < 300; ++round) {
      const Vec3 direction = checks::random_direction(random);
      double furthest = 0;
      for (const Vec3& face : faces) furthest = std::max(furthest, glm::dot(face, direction));
      EXPECT_DOUBLE_EQ(glm::dot(polyhedron->face_towards(direction), direction), furthest) << name;
      EXPECT_DOUBLE_EQ(glm::dot(polyhedron->face_towards(9.0 * direction), direction), furthest);
      const Vec3 surface = direction / furthest;
      for (const double slack : {0.0, 1e-12, 1e-3}) {
        const double depth = slack * glm::length(polyhedron->face_towards(direction));
        EXPECT_TRUE(polyhedron->contains(surface * (1 - 1e-10), 0)) << name;
        EXPECT_FALSE(polyhedron->contains(surface * (1 - depth + 1e-10), slack)) << name;
        EXPECT_FALSE(polyhedron->contains(surface * (1 + 1e-10), slack)) << name;
      }
      double support = -std::numeric_limits<double>::infinity();
      for (const Vec3& vertex : polyhedron->vertices()) {
        support = std::max(support, glm::dot(direction, canonical(*polyhedron, vertex)));
      }
      EXPECT_DOUBLE_EQ(glm::dot(polyhedron->support(direction), direction), support) << name;
    }
    EXPECT_FALSE(polyhedron->contains(Vec3(std::numeric_limits<double>::quiet_NaN()))) << name;
  }
}

/// Returns a ray's segment by all half-spaces.
std::pair<double, double> segment_of(const Polyhedron& polyhedron, const Vec3& o, const Vec3& d) {
  double start = -std::numeric_limits<double>::infinity();
  double end = -start;
  for (const HalfSpace& half_space : polyhedron.half_spaces()) {
    const double growth = glm::dot(half_space.normal, d);
    const double at = (half_space.offset - glm::dot(half_space.normal, o)) / growth;
    if (growth < 0) start = std::max(start, at);
    if (growth > 0) end = std::min(end, at);
  }
  return {start, end};
}

TEST(Polyhedron, RaysAreCutByAllFaces) {
  std::mt19937 random(3);
  for (const auto& [name, polyhedron] : all_kinds()) {
    const CanonicalPrimitive primitive = canonicalize(make_polyhedron(polyhedron));
    const Vec3 size = primitive.bounds.size();
    int crossed = 0;
    for (int round = 0; round < 60; ++round) {
      RayPacket packet;
      for (uint32_t lane = 0; lane < kPacketRays; ++lane) {
        const Vec3 at = checks::random_point(random, primitive.bounds);
        const Vec3 direction = size * checks::random_direction(random);
        for (int axis = 0; axis < 3; ++axis) {
          packet.origin[axis][lane] = at[axis] - 2 * direction[axis];
          packet.direction[axis][lane] = direction[axis];
        }
        packet.inverse_length2[lane] = 1 / glm::dot(direction, direction);
      }
      PacketSegments segments;
      intersect(FrameRays{}, packet, primitive, segments);
      for (uint32_t lane = 0; lane < kPacketRays; ++lane) {
        Vec3 o, d;
        for (int axis = 0; axis < 3; ++axis) {
          o[axis] = packet.origin[axis][lane];
          d[axis] = packet.direction[axis][lane];
        }
        const auto [start, end] = segment_of(*polyhedron, o, d);
        if (end - start < 1e-9) continue;
        ASSERT_NEAR(segments.start[lane], start, 1e-9) << name;
        ASSERT_NEAR(segments.end[lane], end, 1e-9) << name;
        ++crossed;
      }
    }
    EXPECT_GT(crossed, 100) << name;
  }
}

TEST(Polyhedron, OnlyBoxesHaveSlabs) {
  for (const auto& [name, polyhedron] : all_kinds()) {
    const bool is_box = polyhedron->half_spaces().size() == 6 && polyhedron->vertices().size() == 8;
    ASSERT_EQ(polyhedron->slabs().has_value(), is_box && !polyhedron->canonical().in_frustum)
        << name;
    if (!polyhedron->slabs()) continue;
    const std::vector<Vec3> faces = faces_of(*polyhedron);
    for (int axis = 0; axis < 3; ++axis) {
      Vec3 below(0.0), above(0.0);
      below[axis] = polyhedron->slabs()->below[axis];
      above[axis] = polyhedron->slabs()->above[axis];
      EXPECT_TRUE(below[axis] < 0 && above[axis] > 0) << name;
      EXPECT_EQ(std::count(faces.begin(), faces.end(), below), 1) << name;
      EXPECT_EQ(std::count(faces.begin(), faces.end(), above), 1) << name;
    }
  }
}

/// Rays along a box's face, inside it, on it and beyond it: the box is closed.
TEST(Polyhedron, RaysAlongFacesOfABox) {
  const CanonicalPrimitive box =
      canonicalize(make_polyhedron(Polyhedron::box({Vec3(-1), Vec3(1)})));
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      RayPacket packet;
      const double heights[] = {0, 0.5, 0.999, 1, 1.001, 2};
      for (uint32_t lane = 0; lane < kPacketRays; ++lane) {
        for (int i = 0; i < 3; ++i) packet.origin[i][lane] = packet.direction[i][lane] = 0;
        packet.origin[axis][lane] = side * heights[lane % std::size(heights)];
        packet.direction[(axis + 1) % 3][lane] = lane % 2 == 0 ? 1 : -1;
        packet.inverse_length2[lane] = 1;
      }
      PacketSegments segments;
      intersect(FrameRays{}, packet, box, segments);
      for (uint32_t lane = 0; lane < kPacketRays; ++lane) {
        const double height = heights[lane % std::size(heights)];
        const bool crosses = segments.start[lane] < segments.end[lane];
        ASSERT_EQ(crosses, height <= 1) << axis << ' ' << side * height;
        if (!crosses) continue;
        EXPECT_NEAR(segments.start[lane], -1, 1e-12);
        EXPECT_NEAR(segments.end[lane], 1, 1e-12);
      }
    }
  }
}

TEST(Polyhedron, OnlyOfConvexMeshes) {
  // The corner of a cube is pushed in.
  Mesh mesh = box_mesh({Vec3(0), Vec3(1)});
  ASSERT_TRUE(Polyhedron::from(mesh));
  for (Vec3& vertex : mesh.vertices) {
    if (vertex == Vec3(1)) vertex = Vec3(0.4);
  }
  EXPECT_FALSE(Polyhedron::from(mesh));
  EXPECT_FALSE(Polyhedron::from(Mesh{}));
}

TEST(Polyhedron, FacesMayRunEitherWay) {
  for (const Mesh& mesh : {box_mesh({Vec3(-1, 0, 2), Vec3(1, 3, 5)}), sphere_mesh(2, 9),
                           frustum_mesh(0, 3, 2, 0, 7)}) {
    const std::vector<HalfSpace> wanted = Polyhedron::from(mesh)->half_spaces();
    std::mt19937 random(7);
    for (int i = 0; i < 8; ++i) {
      Mesh turned = mesh;
      for (std::vector<uint32_t>& face : turned.faces) {
        // First all faces are reversed, then some.
        if (i == 0 || random() % 2 == 0) std::reverse(face.begin(), face.end());
      }
      const auto polyhedron = Polyhedron::from(turned);
      ASSERT_TRUE(polyhedron);
      for (size_t k = 0; k < wanted.size(); ++k) {
        const HalfSpace& found = polyhedron->half_spaces()[k];
        EXPECT_LE(glm::length(found.normal - wanted[k].normal),
                  1e-14 * glm::length(wanted[k].normal));
        EXPECT_NEAR(found.offset, wanted[k].offset, 1e-14);
      }
    }
  }
}

TEST(Polyhedron, OnlyOfClosedMeshes) {
  const auto without_last = [](Mesh mesh) {
    mesh.faces.pop_back();
    return mesh;
  };
  const auto with_again = [](Mesh mesh, std::vector<uint32_t> face) {
    mesh.faces.push_back(std::move(face));
    return mesh;
  };
  const Mesh box = box_mesh({Vec3(0), Vec3(1)});
  std::vector<uint32_t> turned = box.faces[0];
  std::reverse(turned.begin(), turned.end());
  EXPECT_FALSE(Polyhedron::from(without_last(box)));
  EXPECT_FALSE(Polyhedron::from(with_again(box, box.faces[0])));
  EXPECT_FALSE(Polyhedron::from(with_again(box, turned)));
  // Opposite faces of an octahedron, each twice: every edge is there twice, but nothing is closed.
  const std::vector<Vec3> corners = {Vec3(1, 0, 0),  Vec3(0, 1, 0),  Vec3(0, 0, 1),
                                     Vec3(-1, 0, 0), Vec3(0, -1, 0), Vec3(0, 0, -1)};
  EXPECT_FALSE(Polyhedron::from({corners, {{0, 1, 2}, {2, 1, 0}, {3, 4, 5}, {5, 4, 3}}}));
  EXPECT_FALSE(Polyhedron::from({corners, {{0, 1, 2}, {0, 1, 2}, {3, 4, 5}, {3, 4, 5}}}));
}

}  // namespace
}  // namespace csgcore
