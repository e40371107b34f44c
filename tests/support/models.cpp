#include "support/models.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <utility>

#include "csgcore/polyhedron.hpp"
#include "kinds/test_kind.hpp"

namespace test_support {
namespace {

using csgcore::Affine;
using csgcore::Mat3;
using csgcore::Op;
using csgcore::Scene;
using csgcore::Vec3;

constexpr double kRadius = 10;
constexpr double kHeight = 20;

double uniform(std::mt19937& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

struct SurfacePoint {
  Vec3 position, normal;
};

/// A point of the cylinder's wall or caps, uniform by area.
SurfacePoint surface_point(std::mt19937& random) {
  const double wall = 2 * kRadius * kHeight;  // both areas over π
  const double cap = kRadius * kRadius;
  const double pick = uniform(random, 0, wall + 2 * cap);
  const double angle = uniform(random, 0, 2 * std::numbers::pi);
  const Vec3 outward{std::cos(angle), std::sin(angle), 0};
  if (pick < wall) return {outward * kRadius + Vec3{0, 0, uniform(random, -10, 10)}, outward};
  const double side = pick < wall + cap ? 1 : -1;
  const double r = kRadius * std::sqrt(uniform(random, 0, 1));
  return {outward * r + Vec3{0, 0, side * kHeight / 2}, {0, 0, side}};
}

/// A rotation whose third column is `axis`.
Mat3 frame_along(const Vec3& axis) {
  const Vec3 helper = std::abs(axis.x) < 0.5 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  const Vec3 x = glm::normalize(glm::cross(helper, axis));
  return Mat3{x, glm::cross(axis, x), axis};
}

template <typename MakeTool>
Scene cylinder_minus(uint32_t n, uint32_t seed, MakeTool&& make_tool) {
  std::mt19937 random(seed);
  Scene scene;
  scene.primitives.push_back(csgcore::make_frustum(-kHeight / 2, kHeight / 2, kRadius, kRadius));
  for (uint32_t i = 0; i < n; ++i) {
    scene.primitives.push_back(make_tool(surface_point(random), random));
    scene.primitives.back().id = i + 1;
  }
  csgcore::CsgTreeBuilder tree;
  tree.open(Op::kDifference);
  for (uint32_t i = 0; i <= n; ++i) tree.primitive(i);
  tree.close();
  scene.model = tree.finish();
  return scene;
}

}  // namespace

Scene cylinder_minus_spheres(uint32_t n, uint32_t seed) {
  const double radius = 20 / std::sqrt(double(n));
  return cylinder_minus(n, seed, [&](const SurfacePoint& point, std::mt19937&) {
    return csgcore::make_sphere(radius, {Mat3{1.0}, point.position});
  });
}

Scene cylinder_minus_cones(uint32_t n, uint32_t seed) {
  const double radius = 26 / std::sqrt(double(n));
  const double height = 4 * radius;
  return cylinder_minus(n, seed, [&](const SurfacePoint& point, std::mt19937& random) {
    const double tilt = uniform(random, 0, 40) * std::numbers::pi / 180;
    const double turn = uniform(random, 0, 2 * std::numbers::pi);
    const Mat3 frame = frame_along(point.normal);
    const Vec3 axis = frame * Vec3{std::sin(tilt) * std::cos(turn), std::sin(tilt) * std::sin(turn),
                                   std::cos(tilt)};
    return csgcore::make_frustum(-2 * height / 3, height / 3, 0, radius,
                                 {frame_along(axis), point.position});
  });
}

Scene stacked_frusta(uint32_t rings) {
  constexpr double kRingHeight = 0.5, kWall = 2;
  const auto radius = [&](uint32_t i) { return 20 + 8 * std::sin(9.0 * i / rings); };
  Scene scene;
  csgcore::CsgTreeBuilder tree;
  tree.open(Op::kUnion);
  for (uint32_t i = 0; i < rings; ++i) {
    tree.open(Op::kDifference);
    for (const double inwards : {0.0, kWall}) {
      tree.primitive(static_cast<uint32_t>(scene.primitives.size()));
      scene.primitives.push_back(csgcore::make_frustum(
          kRingHeight * i, kRingHeight * (i + 1), radius(i) - inwards, radius(i + 1) - inwards));
      scene.primitives.back().id = static_cast<uint32_t>(scene.primitives.size() - 1);
    }
    tree.close();
  }
  tree.close();
  scene.model = tree.finish();
  return scene;
}

Scene scene_of(Op op, std::vector<csgcore::Primitive> primitives) {
  Scene scene;
  csgcore::CsgTreeBuilder builder;
  builder.open(op);
  for (uint32_t i = 0; i < primitives.size(); ++i) {
    primitives[i].id = i;
    builder.primitive(i);
  }
  builder.close();
  scene.primitives = std::move(primitives);
  scene.model = builder.finish();
  return scene;
}

std::shared_ptr<const csgcore::Polyhedron> octahedron(double scale) {
  const Vec3 x = scale * Vec3(1, 0.2, 0), y = scale * Vec3(-0.3, 0.8, 0.1);
  const Vec3 z = scale * Vec3(0, 0, 1.1);
  csgcore::Mesh mesh{{x, y, -x, -y, z, -z}, {}};
  for (uint32_t i = 0; i < 4; ++i) {
    const uint32_t next = (i + 1) % 4;
    mesh.faces.push_back({i, next, 4});
    mesh.faces.push_back({next, i, 5});
  }
  return csgcore::Polyhedron::from(mesh);
}

Affine random_affine(std::mt19937& random) {
  for (;;) {
    Affine map;
    for (int column = 0; column < 3; ++column) {
      for (int row = 0; row < 3; ++row) map.linear[column][row] = uniform(random, -1, 1);
      map.translation[column] = uniform(random, -5, 5);
    }
    if (std::abs(map.determinant()) > 0.05) return map;
  }
}

Scene random_tree(uint32_t primitives, uint32_t seed) {
  std::mt19937 random(seed);
  Scene scene;
  csgcore::CsgTreeBuilder tree;
  const Op ops[] = {Op::kUnion, Op::kIntersection, Op::kDifference};
  // Operations open and close at random between the primitives. Intersections are rarer, since deep
  // ones are mostly empty.
  int depth = 0;
  for (uint32_t i = 0; i < primitives; ++i) {
    while (depth < 6 && uniform(random, 0, 1) < 0.5) {
      const double pick = uniform(random, 0, 1);
      tree.open(ops[pick < 0.45 ? 0 : (pick < 0.55 ? 1 : 2)]);
      ++depth;
    }
    const Affine map = random_affine(random);
    if (uniform(random, 0, 1) < 0.4) {
      scene.primitives.push_back(csgcore::make_sphere(uniform(random, 1, 5), map));
    } else {
      const double pointed = uniform(random, 0, 1);
      const double bottom = pointed < 0.2 ? 0 : uniform(random, 0.5, 4);
      const double top = pointed > 0.8 ? 0 : (pointed > 0.5 ? bottom : uniform(random, 0.5, 4));
      scene.primitives.push_back(csgcore::make_frustum(
          uniform(random, -5, -1), uniform(random, 1, 5), bottom, bottom + top > 0 ? top : 1, map));
    }
    scene.primitives.back().id = i;
    tree.primitive(i);
    while (depth > 0 && uniform(random, 0, 1) < 0.4) {
      tree.close();
      --depth;
    }
  }
  for (; depth > 0; --depth) tree.close();
  scene.model = tree.finish();
  return scene;
}

Scene random_tree_of_all_kinds(uint32_t primitives, uint32_t seed) {
  Scene scene = random_tree(primitives, seed);
  std::mt19937 random(seed);
  Sizes sizes(random, {.low = 1, .high = 4, .most_fragments = 8});
  for (csgcore::Primitive& primitive : scene.primitives) {
    const uint32_t id = primitive.id;
    primitive = random_primitive(sizes, primitive.local_to_world);
    primitive.id = id;
  }
  return scene;
}

}  // namespace test_support
