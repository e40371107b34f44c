#include "render/scene_scale.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/primitive_traits.hpp"
#include "frontend/error.hpp"

namespace frontend {
namespace {

using csgcore::Primitive;

/// Scenes from 2^-40 to 2^40 across (1e-12 to 1e12) are drawn as they are: their squares, and those
/// of a camera a million times as far, are well within a float's 2^±126.
constexpr int kOrdinaryExponent = 40;

/// What is healed or faceted may have grown a little since its size was found to be one that can be
/// drawn.
constexpr int kSpareExponents = 2;

/// A primitive that has no volume in doubles when the scene is of size 1 is thinner there than
/// 2^-340, which nothing shows. A speck of this size, which nothing shows either, stands for it.
constexpr int kSpeckExponent = -100;
/// The volume of what a smaller matrix makes is not in the doubles.
constexpr int kLeastMatrixExponent = -330;

[[noreturn]] void throw_unscalable() {
  throw Error({}, {}, "the design is too large or too small to be drawn",
              "scale it to between 1e-90 and 1e90 across");
}

csgcore::Vec3 scaled(const csgcore::Vec3& v, int exponent) {
  return {std::ldexp(v.x, exponent), std::ldexp(v.y, exponent), std::ldexp(v.z, exponent)};
}

}  // namespace

int scale_exponent(const csgcore::Scene& scene) {
  if (scene.primitives.empty()) return 0;
  double largest = 0;
  for (const Primitive& primitive : scene.primitives) {
    largest = std::max(largest, size_of(primitive));
  }
  if (largest == 0 || !std::isfinite(largest)) throw_unscalable();
  const int exponent = std::ilogb(largest) + 1;
  if (std::abs(exponent) <= kOrdinaryExponent) return 0;
  if (std::abs(exponent) > kLargestExponent + kSpareExponents) throw_unscalable();
  return -exponent;
}

csgcore::Scene scaled(const csgcore::Scene& scene, int exponent) {
  csgcore::Scene result = scene;
  for (Primitive& primitive : result.primitives) {
    csgcore::Affine& map = primitive.local_to_world;
    for (int column = 0; column < 3; ++column) {
      map.linear[column] = scaled(map.linear[column], exponent);
    }
    map.translation = scaled(map.translation, exponent);
    if (csgcore::is_valid(primitive)) continue;
    map.linear = csgcore::Mat3(1.0);
    const int local_exponent = std::ilogb(size_of(primitive));
    map.linear *= std::ldexp(1.0, std::max(kSpeckExponent - local_exponent, kLeastMatrixExponent));
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
