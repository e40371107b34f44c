#include "random_scenes.hpp"

#include <cmath>
#include <random>
#include <utility>

#include "csgcore/profile.hpp"
#include "csgcore/triangle_mesh.hpp"
#include "support/kinds/test_kind.hpp"
#include "support/models.hpp"
#include "support/test_meshes.hpp"
#include "support/test_profiles.hpp"

namespace stress {
namespace {

using Random = std::mt19937;
using csgcore::Vec2;

constexpr uint32_t kMostPrimitives = 12;
constexpr int kMostDepth = 5;

double uniform(Random& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

bool by_chance(Random& random, double share) { return uniform(random, 0, 1) < share; }

/// Sizes are often integers, so that some are equal.
constexpr test_support::SizeRange kSizes{
    .low = 1, .high = 4, .even_share = 0.6, .step = 1, .most_fragments = 8};

/// Returns the mesh without a tenth of its triangles, or without one.
Primitive torn(const Primitive& primitive, Random& random) {
  const csgcore::TriangleMesh& mesh = *primitive.mesh();
  test_support::MeshParts parts{{mesh.vertices().begin(), mesh.vertices().end()},
                                {mesh.triangles().begin(), mesh.triangles().end()}};
  parts = test_support::with_holes(parts, 0.1, random);
  if (!parts.triangles.empty()) parts.triangles.pop_back();
  return parts.triangles.empty() ? primitive : csgcore::make_mesh(parts.mesh());
}

/// Returns a random profile, extruded or revolved.
Primitive profile_solid(Random& random) {
  const bool is_revolution = random() % 2 == 0;
  const Vec2 min(is_revolution ? 0 : -3, -3);
  auto profile = test_support::random_profile(random, min, Vec2(3));
  if (is_revolution) return csgcore::make_revolution(std::move(profile));
  const double z_min = std::round(uniform(random, -3, 0));
  const double z_max = z_min + std::round(uniform(random, 1, 4));
  constexpr double kScales[][2] = {{1, 1}, {1, 1}, {1, 1}, {1, 0.5}, {0.25, 1}, {1, 0}};
  const auto& scales = kScales[random() % std::size(kScales)];
  return csgcore::make_extrusion(std::move(profile), z_min, z_max, scales[0], scales[1]);
}

/// Returns a primitive in its own frame, which is to be a place in the world.
Primitive random_primitive(Random& random, Leaves leaves) {
  test_support::Sizes sizes(random, kSizes);
  if (leaves == Leaves::kAll) return test_support::random_primitive(sizes, {});
  if (leaves == Leaves::kProfiles) {
    return random() % 3 == 0 ? test_support::random_primitive(sizes, {}) : profile_solid(random);
  }
  if (leaves == Leaves::kMeshes) {
    if (random() % 2) return test_support::random_primitive(sizes, {});
    const auto& meshes = test_support::test_kind_of(csgcore::Shape::kMesh);
    const Primitive primitive = test_support::random_primitive(meshes, sizes, {});
    return by_chance(random, 0.2) ? torn(primitive, random) : primitive;
  }
  const bool is_mesh = leaves == Leaves::kFaceted && random() % 2;
  const auto& kind =
      test_support::test_kind_of(is_mesh ? csgcore::Shape::kMesh : csgcore::Shape::kPolyhedron);
  constexpr size_t kMostTriangles = 100;
  for (;;) {
    const Primitive primitive = test_support::random_primitive(kind, sizes, {});
    if (!is_mesh || primitive.mesh()->triangles().size() <= kMostTriangles) return primitive;
  }
}

Vec3 whole_offset(Random& random) {
  Vec3 offset(0.0);
  offset[random() % 3] = std::round(uniform(random, -4, 4));
  return offset;
}

/// Returns a frame that shares planes or an axis with `frame`: shifted by integers, or turned about
/// z so that hexagons, squares and cubes coincide with themselves, up to rounding.
Affine related(const Affine& frame, Random& random) {
  switch (random() % 4) {
    case 0:
      return frame;
    case 1:
      return csgcore::compose(frame, {Mat3{1.0}, whole_offset(random)});
    case 2:
      return csgcore::compose(frame, turn(0, 0, random() % 2 ? 60 : 90));
    default:
      return csgcore::compose(frame, turn(90, 0, 0));
  }
}

Affine random_frame(Random& random) {
  if (by_chance(random, 0.7)) return test_support::random_affine(random);
  return {Mat3{1.0}, whole_offset(random)};
}

std::vector<Primitive> random_primitives(Random& random, Leaves leaves) {
  std::vector<Primitive> primitives;
  const uint32_t count = 1 + random() % kMostPrimitives;
  for (uint32_t i = 0; i < count; ++i) {
    Primitive primitive = random_primitive(random, leaves);
    primitive.local_to_world = random_frame(random);
    if (i > 0 && by_chance(random, 0.5)) {
      const Primitive& other = primitives[random() % i];
      if (by_chance(random, 0.2)) primitive = other;
      primitive.local_to_world = related(other.local_to_world, random);
    }
    primitive.id = i;
    primitives.push_back(primitive);
  }
  return primitives;
}

/// Operations open and close at random between the primitives. Intersections are rarer, since deep
/// ones are mostly empty.
csgcore::CsgTree random_tree(Random& random, uint32_t primitives) {
  constexpr Op kOps[] = {Op::kUnion,      Op::kUnion,       Op::kUnion,      Op::kUnion,
                         Op::kDifference, Op::kDifference,  Op::kDifference, Op::kDifference,
                         Op::kDifference, Op::kIntersection};
  csgcore::CsgTreeBuilder tree;
  int depth = 0;
  for (uint32_t i = 0; i < primitives; ++i) {
    for (; depth < kMostDepth && by_chance(random, 0.5); ++depth) {
      tree.open(kOps[random() % std::size(kOps)]);
    }
    tree.primitive(i);
    for (; depth > 0 && by_chance(random, 0.4); --depth) tree.close();
  }
  for (; depth > 0; --depth) tree.close();
  return tree.finish();
}

}  // namespace

Scene random_scene(uint32_t seed, Leaves leaves) {
  Random random(seed);
  Scene scene;
  scene.primitives = random_primitives(random, leaves);
  scene.model = random_tree(random, uint32_t(scene.primitives.size()));
  return scene;
}

View random_view(const Scene& scene, PictureSize size, uint32_t seed) {
  Random random(seed);
  const Box box = camera_box(scene);
  const Projection projection =
      random() % 3 == 0 ? Projection::kOrthographic : Projection::kPerspective;
  const double distance = std::exp2(uniform(random, -1, 5));
  View view = random() % 4 == 0 ? view_along(box, size, projection, int(random() % 3), distance)
                                : view_around(box, size, projection, uniform(random, 0, 360),
                                              uniform(random, -90, 90), distance);
  view.half_height *= uniform(random, 0.5, 1);
  if (projection == Projection::kPerspective && random() % 4 == 0) {
    const Vec3 half = 0.5 * box.size();
    view.eye = box.center();
    for (int i = 0; i < 3; ++i) view.eye[i] += half[i] * uniform(random, -1, 1);
    view.half_height = uniform(random, 0.3, 1.5);
  }
  return view;
}

}  // namespace stress
