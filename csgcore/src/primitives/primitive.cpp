#include "csgcore/primitive.hpp"

#include <cmath>
#include <glm/matrix.hpp>
#include <utility>

namespace csgcore {

Primitive make_sphere(double radius, const Affine& local_to_world) {
  Primitive primitive;
  primitive.shape = Shape::kSphere;
  primitive.r_bottom = radius;
  primitive.local_to_world = local_to_world;
  return primitive;
}

Primitive make_frustum(double z_min, double z_max, double r_bottom, double r_top,
                       const Affine& local_to_world) {
  Primitive primitive;
  primitive.shape = Shape::kFrustum;
  primitive.z_min = z_min;
  primitive.z_max = z_max;
  primitive.r_bottom = r_bottom;
  primitive.r_top = r_top;
  primitive.local_to_world = local_to_world;
  return primitive;
}

Primitive make_polyhedron(std::shared_ptr<const Polyhedron> polyhedron,
                          const Affine& local_to_world) {
  Primitive primitive;
  primitive.shape = Shape::kPolyhedron;
  primitive.polyhedron = std::move(polyhedron);
  primitive.local_to_world = local_to_world;
  return primitive;
}

bool has_valid_shape(const Primitive& primitive) {
  if (primitive.shape == Shape::kPolyhedron) return primitive.polyhedron != nullptr;
  if (primitive.shape == Shape::kSphere) {
    return std::isfinite(primitive.r_bottom) && primitive.r_bottom > 0;
  }
  const double height = primitive.z_max - primitive.z_min;
  return std::isfinite(height) && height > 0 && std::isfinite(primitive.r_bottom) &&
         std::isfinite(primitive.r_top) && primitive.r_bottom >= 0 && primitive.r_top >= 0 &&
         primitive.r_bottom + primitive.r_top > 0;
}

bool is_valid(const Primitive& primitive) {
  if (!primitive.local_to_world.finite()) return false;
  const double determinant = primitive.local_to_world.determinant();
  if (!std::isfinite(determinant) || determinant == 0) return false;
  // The inverse must be representable too: a determinant that underflows flattens the solid.
  if (!Affine{inverse(primitive.local_to_world.linear), Vec3{0.0}}.finite()) return false;
  return has_valid_shape(primitive);
}

}  // namespace csgcore
