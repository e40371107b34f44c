// Small scenes for the tests of the reference.
#pragma once

#include <functional>
#include <utility>
#include <vector>

#include "reference.hpp"

namespace csgcore::reference_test {

inline Primitive rod(double z_min, double z_max, double radius, Vec3 at = Vec3(0.0)) {
  return make_frustum(z_min, z_max, radius, radius, {Mat3(1.0), at});
}

inline Primitive ball(double radius, Vec3 at = Vec3(0.0)) {
  return make_sphere(radius, {Mat3(1.0), at});
}

/// `build` is given a builder for the primitives, which it names by index.
inline Scene scene_of(std::vector<Primitive> primitives,
                      const std::function<void(CsgTreeBuilder&)>& build) {
  Scene scene;
  scene.primitives = std::move(primitives);
  CsgTreeBuilder builder;
  build(builder);
  scene.model = builder.finish();
  return scene;
}

inline Scene scene_of(Op op, std::vector<Primitive> primitives) {
  const auto count = uint32_t(primitives.size());
  return scene_of(std::move(primitives), [&](CsgTreeBuilder& builder) {
    builder.open(op);
    for (uint32_t i = 0; i < count; ++i) builder.primitive(i);
    builder.close();
  });
}

/// Looks straight down from (0, 0, height), with 3×3 pixels; the middle one's ray is the z axis.
inline View down(double height, Projection projection = Projection::kPerspective) {
  View view;
  view.projection = projection;
  view.eye = {0, 0, height};
  view.half_height = projection == Projection::kPerspective ? 0.01 : 1;
  view.width_px = view.height_px = 3;
  return view;
}

inline ReferenceHit middle_hit(const Scene& scene, const View& view) {
  return Reference(scene, view).at(1, 1);
}

}  // namespace csgcore::reference_test
