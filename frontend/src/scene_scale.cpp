#include "scene_scale.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "csgcore/polyhedron.hpp"
#include "frontend/error.hpp"

namespace frontend {
namespace {

using csgcore::Primitive;

/// Scenes from 2^-40 to 2^40 across (1e-12 to 1e12) are drawn as they are: their squares, and those
/// of a camera a million times as far, are well within a float's 2^±126.
constexpr int kOrdinaryExponent = 40;

/// Beyond 2^±300 (1e±90) the determinant of a matrix, a product of three, nears the end of the
/// doubles.
constexpr int kLargestExponent = 300;

[[noreturn]] void throw_unscalable() {
  throw Error({}, {}, "the design is too large or too small to be drawn",
              "scale it to between 1e-90 and 1e90 across");
}

/// No coordinate of the local solid is larger. Of a polyhedron a bound, of the order of its size.
double local_extent(const Primitive& primitive) {
  if (primitive.shape == csgcore::Shape::kPolyhedron) {
    const csgcore::Polyhedron::Canonical& canonical = primitive.polyhedron->canonical();
    double extent = 0;
    for (int axis = 0; axis < 3; ++axis) {
      extent = std::max(extent, std::abs(canonical.center[axis]) + canonical.scale[axis]);
    }
    return extent;
  }
  return std::max(
      {primitive.r_bottom, primitive.r_top, std::abs(primitive.z_min), std::abs(primitive.z_max)});
}

/// The least e, or a few more, with |x| < 2^e for all extents x of the primitive.
int size_exponent(const Primitive& primitive) {
  const double local = local_extent(primitive);
  double stretch = 0;
  for (int column = 0; column < 3; ++column) {
    for (int row = 0; row < 3; ++row) {
      stretch = std::max(stretch, std::abs(primitive.local_to_world.linear[column][row]));
    }
  }
  // The exponents are added, as the product may not be representable.
  return std::ilogb(local) + std::ilogb(stretch) + 2;
}

csgcore::Vec3 scaled(const csgcore::Vec3& v, int exponent) {
  return {std::ldexp(v.x, exponent), std::ldexp(v.y, exponent), std::ldexp(v.z, exponent)};
}

}  // namespace

int scale_exponent(const csgcore::Scene& scene) {
  if (scene.primitives.empty()) return 0;
  int largest = size_exponent(scene.primitives.front());
  for (const Primitive& primitive : scene.primitives) {
    largest = std::max(largest, size_exponent(primitive));
  }
  if (std::abs(largest) <= kOrdinaryExponent) return 0;
  if (std::abs(largest) > kLargestExponent) throw_unscalable();
  return -largest;
}

csgcore::Scene scaled(const csgcore::Scene& scene, int exponent) {
  csgcore::Scene result = scene;
  for (Primitive& primitive : result.primitives) {
    csgcore::Affine& map = primitive.local_to_world;
    for (int column = 0; column < 3; ++column) {
      map.linear[column] = scaled(map.linear[column], exponent);
    }
    map.translation = scaled(map.translation, exponent);
    if (!csgcore::is_valid(primitive)) throw_unscalable();
  }
  return result;
}

csgcore::View scaled(const csgcore::View& view, int exponent) {
  csgcore::View result = view;
  result.eye = scaled(view.eye, exponent);
  if (view.projection == csgcore::Projection::kOrthographic) {
    result.half_height = std::ldexp(view.half_height, exponent);
  }
  return result;
}

void undo_scale(int exponent, csgcore::Image& image) {
  for (float& z : image.z) z = std::ldexp(z, -exponent);
  for (glm::vec3& p : image.position) {
    p = {std::ldexp(p.x, -exponent), std::ldexp(p.y, -exponent), std::ldexp(p.z, -exponent)};
  }
}

}  // namespace frontend
