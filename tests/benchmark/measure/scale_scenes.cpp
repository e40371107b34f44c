#include "scale_scenes.hpp"

#include <cmath>
#include <utility>

#include "support/models.hpp"

namespace measure {
namespace {

using csgcore::Affine;
using csgcore::Mat3;
using csgcore::Op;
using csgcore::Primitive;
using csgcore::Scene;
using csgcore::Vec3;

constexpr double kHalfSize = 10;
constexpr uint32_t kSeed = 1;

Scene minus_spheres(uint32_t primitives) {
  return test_support::cylinder_minus_spheres(primitives - 1);
}

Scene minus_cones(uint32_t primitives) {
  return test_support::cylinder_minus_cones(primitives - 1);
}

/// Balls with a hole, side by side throughout a cube, touching nothing.
Scene parts(uint32_t primitives) {
  const uint32_t count = primitives / 2;
  const auto side = static_cast<uint32_t>(std::ceil(std::cbrt(count)));
  const double pitch = 2 * kHalfSize / side;
  Scene scene;
  csgcore::CsgTreeBuilder tree;
  const auto add = [&](Primitive primitive) {
    primitive.id = static_cast<uint32_t>(scene.primitives.size());
    tree.primitive(primitive.id);
    scene.primitives.push_back(std::move(primitive));
  };
  tree.open(Op::kUnion);
  for (uint32_t i = 0; i < count; ++i) {
    const Vec3 cell{i % side, i / side % side, i / side / side};
    const Affine at{Mat3{1.0}, (cell + 0.5) * pitch - kHalfSize};
    tree.open(Op::kDifference);
    add(csgcore::make_sphere(0.4 * pitch, at));
    add(csgcore::make_frustum(-0.5 * pitch, 0.5 * pitch, 0.2 * pitch, 0.2 * pitch, at));
    tree.close();
  }
  tree.close();
  scene.model = tree.finish();
  return scene;
}

Scene random_tree(uint32_t primitives) { return test_support::random_tree(primitives, kSeed); }

/// CSn's primitives, subtracted and added in turn, each from and to all before it. The tree is as
/// deep as it has primitives.
Scene deep(uint32_t primitives) {
  Scene scene = minus_spheres(primitives);
  const auto count = static_cast<uint32_t>(scene.primitives.size());
  csgcore::CsgTreeBuilder tree;
  for (uint32_t i = count - 1; i > 0; --i) {
    tree.open(i % 2 == 0 ? Op::kUnion : Op::kDifference);
  }
  tree.primitive(0);
  for (uint32_t i = 1; i < count; ++i) {
    tree.primitive(i);
    tree.close();
  }
  scene.model = tree.finish();
  return scene;
}

constexpr SceneFamily kFamilies[] = {
    {"cs", "a cylinder minus spheres", minus_spheres},
    {"cc", "a cylinder minus cones", minus_cones},
    {"parts", "a union of pierced balls", parts},
    {"random", "random trees, all in one place", random_tree},
    {"deep", "spheres subtracted and added in turn", deep},
};

}  // namespace

std::span<const SceneFamily> scene_families() { return kFamilies; }

}  // namespace measure
