#include "checks.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <set>

#include "csgcore/polyhedron.hpp"
#include "support/evaluate_tree.hpp"
#include "support/models.hpp"

namespace csgcore::checks {

double uniform(std::mt19937& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

Vec3 random_point(std::mt19937& random, const Box& box) {
  return {uniform(random, box.min.x, box.max.x), uniform(random, box.min.y, box.max.y),
          uniform(random, box.min.z, box.max.z)};
}

Vec3 random_direction(std::mt19937& random) {
  for (;;) {
    const Vec3 v = random_point(random, {Vec3(-1.0), Vec3(1.0)});
    const double length = glm::length(v);
    if (length > 0.1 && length < 1) return v / length;
  }
}

Primitive random_primitive(std::mt19937& random) {
  const Affine map = test_support::random_affine(random);
  switch (random() % 9) {
    case 0:
      return make_sphere(uniform(random, 0.2, 3), map);
    case 1: {  // a ball: the matrix is a similarity
      const double scale = uniform(random, 0.2, 3);
      return make_sphere(1, {Mat3{scale}, map.translation});
    }
    case 2:
      return make_frustum(-uniform(random, 0, 2), 1, 0, uniform(random, 0.2, 3), map);
    case 3:
      return make_frustum(0.5, uniform(random, 1, 3), uniform(random, 0.2, 3), 0, map);
    case 4: {
      const Vec3 corner = random_point(random, {Vec3(-2.0), Vec3(0.0)});
      const Vec3 size = random_point(random, {Vec3(0.2), Vec3(3.0)});
      return make_polyhedron(Polyhedron::box({corner, corner + size}), map);
    }
    case 5:
      return make_octahedron(map);
    case 6:
      return faceted(make_sphere(uniform(random, 0.2, 3), map), 3 + int(random() % 30));
    case 7:
      return faceted(make_frustum(-1, uniform(random, 0, 3), uniform(random, 0, 3),
                                  uniform(random, 0.2, 3), map),
                     3 + int(random() % 60));
    default:
      return make_frustum(-1, uniform(random, 0, 3), uniform(random, 0.2, 3),
                          uniform(random, 0.2, 3), map);
  }
}

Primitive faceted(const Primitive& primitive, int fragments) {
  Primitive result = primitive;
  result.shape = Shape::kPolyhedron;
  result.polyhedron = Polyhedron::faceted(primitive, fragments);
  return result;
}

Primitive make_octahedron(const Affine& local_to_world) {
  const Vec3 x(1, 0.2, 0), y(-0.3, 0.8, 0.1), z(0, 0, 1.1);
  Mesh mesh{{x, y, -x, -y, z, -z}, {}};
  for (uint32_t i = 0; i < 4; ++i) {
    const uint32_t next = (i + 1) % 4;
    mesh.faces.push_back({i, next, 4});
    mesh.faces.push_back({next, i, 5});
  }
  return make_polyhedron(Polyhedron::from(mesh), local_to_world);
}

double room_along(std::span<const HalfSpace> half_spaces, const Vec3& point,
                  const Vec3& direction) {
  double room = std::numeric_limits<double>::infinity();
  for (const HalfSpace& half_space : half_spaces) {
    const double growth = glm::dot(half_space.normal, direction);
    if (growth <= 0) continue;
    room = std::min(room, (half_space.offset - glm::dot(half_space.normal, point)) / growth);
  }
  return room;
}

Vec3 surface_point(const Primitive& primitive, std::mt19937& random) {
  const Affine& map = primitive.local_to_world;
  const Vec3 direction = random_direction(random);
  if (primitive.shape == Shape::kSphere) return map.point(primitive.r_bottom * direction);
  if (primitive.shape == Shape::kPolyhedron) {
    const Polyhedron& polyhedron = *primitive.polyhedron;
    const std::vector<Vec3>& vertices = polyhedron.vertices();
    if (random() % 3 == 0) return map.point(vertices[random() % vertices.size()]);
    const Vec3& middle = polyhedron.canonical().center;
    return map.point(middle + room_along(polyhedron.half_spaces(), middle, direction) * direction);
  }
  const double share =
      random() % 3 == 0 ? static_cast<double>(random() % 2) : uniform(random, 0, 1);
  const double z = primitive.z_min + share * (primitive.z_max - primitive.z_min);
  const double r = primitive.r_bottom + share * (primitive.r_top - primitive.r_bottom);
  const double across = std::hypot(direction.x, direction.y);
  return map.point({r * direction.x / across, r * direction.y / across, z});
}

bool holds(const Primitive& primitive, const Vec3& point) {
  const Affine& map = primitive.local_to_world;
  const Vec3 local = glm::inverse(map.linear) * (point - map.translation);
  if (primitive.shape == Shape::kSphere) return glm::length(local) <= primitive.r_bottom;
  if (primitive.shape == Shape::kPolyhedron) {
    const std::vector<HalfSpace>& half_spaces = primitive.polyhedron->half_spaces();
    return std::all_of(half_spaces.begin(), half_spaces.end(), [&](const HalfSpace& half_space) {
      return glm::dot(half_space.normal, local) <= half_space.offset;
    });
  }
  const double share = (local.z - primitive.z_min) / (primitive.z_max - primitive.z_min);
  const double radius = primitive.r_bottom + share * (primitive.r_top - primitive.r_bottom);
  return share >= 0 && share <= 1 && std::hypot(local.x, local.y) <= radius;
}

bool holds(const Scene& scene, const Vec3& point) {
  return test_support::evaluate_tree(scene.model.tokens(),
                                     [&](uint32_t i) { return holds(scene.primitives[i], point); });
}

bool holds(const Subdivision& subdivision, const Leaf& leaf, const Vec3& point) {
  if (leaf.literal_count == 0) return leaf.solid;
  return evaluate(subdivision.literals_of(leaf), [&](uint32_t primitive) {
    return contains(subdivision.solid().primitives()[primitive], point);
  });
}

View view_of(const Box& box, const Vec3& direction, double distance) {
  View view;
  view.forward = direction;
  const Vec3 helper = std::abs(direction.z) < 0.9 ? Vec3(0, 0, 1) : Vec3(1, 0, 0);
  view.right = glm::normalize(glm::cross(direction, helper));
  view.up = glm::cross(view.right, direction);
  view.eye = box.center() - distance * direction;
  view.half_height = 0.2;
  view.width_px = 640;
  view.height_px = 480;
  return view;
}

namespace {

void expect_kind(const Subdivision& subdivision, const Leaf& leaf) {
  const SubdivisionOptions& options = subdivision.options();
  const auto literals = subdivision.literals_of(leaf);
  std::set<uint32_t> distinct;
  for (const Literal& literal : literals) distinct.insert(literal.primitive);
  const bool few = distinct.size() <= options.leaf_primitives;
  if (leaf.kind != LeafKind::kEmpty) {
    EXPECT_FALSE(leaf.solid);
  }
  switch (leaf.kind) {
    case LeafKind::kEmpty:
      EXPECT_EQ(leaf.literal_count, 0u);
      break;
    case LeafKind::kUnion:
      EXPECT_TRUE(is_union(literals));
      EXPECT_TRUE(few || options.stop_at_unions);
      break;
    case LeafKind::kPair:
      EXPECT_EQ(literals.size(), 2u);
      EXPECT_FALSE(is_union(literals));
      EXPECT_TRUE(few);
      break;
    case LeafKind::kGeneral:
      EXPECT_NE(literals.size(), 2u);
      EXPECT_FALSE(is_union(literals));
      EXPECT_TRUE(few);
      break;
    case LeafKind::kFull:
    case LeafKind::kGivenUp:
      EXPECT_FALSE(few);
      break;
    case LeafKind::kDropped:
      EXPECT_FALSE(few);
      EXPECT_LT(projected_size_px(*options.view, leaf.box), options.threshold_px);
      break;
    case LeafKind::kReplaced:
      break;
  }
}

double volume(const Box& box) {
  const Vec3 size = box.size();
  return size.x * size.y * size.z;
}

}  // namespace

void expect_correct(const Subdivision& subdivision, const Scene& scene, int points_per_leaf) {
  std::mt19937 random(7);
  double sum = 0;
  size_t wrong = 0;
  for (const Leaf& leaf : subdivision.leaves()) {
    expect_kind(subdivision, leaf);
    if (leaf.kind == LeafKind::kReplaced) continue;
    sum += volume(leaf.box);
    for (int i = 0; i < points_per_leaf; ++i) {
      const Vec3 point = random_point(random, leaf.box);
      wrong += holds(subdivision, leaf, point) != holds(scene, point);
    }
    if (testing::Test::HasFailure()) return;
  }
  EXPECT_EQ(wrong, 0u) << "of " << subdivision.leaves().size() << " leaves";
  if (subdivision.nodes().empty()) return;
  EXPECT_NEAR(sum / volume(subdivision.root_box()), 1, 1e-9);
  // The tree leads to the leaves' cells.
  for (int i = 0; i < 1000; ++i) {
    const Vec3 point = random_point(random, subdivision.root_box());
    const Leaf* leaf = subdivision.find(point);
    ASSERT_NE(leaf, nullptr);
    ASSERT_NE(leaf->kind, LeafKind::kReplaced);
    for (int axis = 0; axis < 3; ++axis) {
      ASSERT_GE(point[axis], leaf->box.min[axis]);
      ASSERT_LE(point[axis], leaf->box.max[axis]);
    }
  }
}

}  // namespace csgcore::checks
