#include "oracle/minimise.hpp"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <memory>
#include <tuple>
#include <vector>

#include "csgcore/polyhedron.hpp"
#include "csgcore/triangle_mesh.hpp"
#include "exact_twin.hpp"
#include "number_text.hpp"
#include "tree_order.hpp"

namespace oracle {
namespace {

using csgcore::Affine;
using csgcore::CsgToken;
using csgcore::CsgTree;
using csgcore::Primitive;
using csgcore::Scene;
using csgcore::Shape;
using csgcore::Vec3;
using Tokens = std::vector<CsgToken>;

/// Returns all numbers of a primitive except those of the solid of a polyhedron or a mesh.
std::vector<double*> numbers_of(Primitive& primitive) {
  std::vector<double*> numbers = twin_of(primitive.shape()).sizes(primitive);
  Affine& map = primitive.local_to_world;
  for (Vec3* column : {&map.translation, &map.linear[0], &map.linear[1], &map.linear[2]}) {
    for (int i = 0; i < 3; ++i) numbers.push_back(&(*column)[i]);
  }
  return numbers;
}

/// The size of a scene: tokens, primitives that are no spheres, meshes' triangles, half-spaces,
/// digits. Sizes are compared in this order.
using Size = std::tuple<size_t, size_t, size_t, size_t, size_t>;

Size size_of(const Scene& scene) {
  size_t shapes = 0, triangles = 0, half_spaces = 0, digits = 0;
  for (Primitive primitive : scene.primitives) {
    shapes += primitive.shape() != Shape::kSphere;
    const auto count_digits = [&](double number) {
      if (number != 0) digits += shortest_text(number).size();
    };
    for (const double* number : numbers_of(primitive)) count_digits(*number);
    if (primitive.mesh()) triangles += primitive.mesh()->triangles().size();
    if (!primitive.polyhedron()) continue;
    half_spaces += primitive.polyhedron()->half_spaces().size();
    for (const csgcore::HalfSpace& half_space : primitive.polyhedron()->half_spaces()) {
      for (int i = 0; i < 3; ++i) count_digits(half_space.normal[i]);
      count_digits(half_space.offset);
    }
  }
  return {scene.model.tokens().size(), shapes, triangles, half_spaces, digits};
}

/// Returns a scene of the primitives that the tokens name, with their indices for ids.
Scene scene_of(const std::vector<Primitive>& primitives, const Tokens& tokens) {
  constexpr uint32_t kUnnamed = std::numeric_limits<uint32_t>::max();
  std::vector<uint32_t> indices(primitives.size(), kUnnamed);
  for (const CsgToken& token : tokens) {
    if (token.is_primitive) indices[token.value] = 0;
  }
  Scene scene;
  for (size_t i = 0; i < primitives.size(); ++i) {
    if (indices[i] == kUnnamed) continue;
    indices[i] = uint32_t(scene.primitives.size());
    scene.primitives.push_back(primitives[i]);
    scene.primitives.back().id = indices[i];
  }
  Tokens renamed = tokens;
  for (CsgToken& token : renamed) {
    if (token.is_primitive) token.value = indices[token.value];
  }
  csgcore::CsgTreeBuilder builder;
  visit_outside_in(renamed, builder);
  scene.model = builder.finish();
  return scene;
}

class Minimiser {
 public:
  Minimiser(const Scene& scene, const Shows& shows, uint32_t most_tries)
      : shows_(shows), tries_left_(most_tries) {
    const std::span<const CsgToken> tokens = scene.model.tokens();
    best_ = scene_of(scene.primitives, {tokens.begin(), tokens.end()});
    size_ = size_of(best_);
  }

  Scene run() {
    while (drop_operands() || simplify_shapes() || simplify_numbers()) {
    }
    return best_;
  }

 private:
  Tokens tokens() const { return {best_.model.tokens().begin(), best_.model.tokens().end()}; }

  /// Takes the scene if it is smaller and still shows the disagreement. Returns whether it did.
  bool take(Scene scene) {
    const Size size = size_of(scene);
    if (!(size < size_) || tries_left_ == 0) return false;
    for (const Primitive& primitive : scene.primitives) {
      if (!csgcore::is_valid(primitive)) return false;
    }
    --tries_left_;
    if (!shows_(scene)) return false;
    best_ = std::move(scene);
    size_ = size;
    return true;
  }

  bool take(const Primitive& primitive, size_t index) {
    Scene scene = best_;
    scene.primitives[index] = primitive;
    return take(std::move(scene));
  }

  /// Tries to drop adjacent operands of an operation: half of them, a quarter, …, one.
  bool drop_operands() {
    const Tokens all = tokens();
    const std::vector<size_t> firsts = first_tokens(all);
    for (size_t i = all.size(); i-- > 0;) {
      if (all[i].is_primitive) continue;
      std::vector<size_t> ends{i};  // the ends of the operands, the last one first
      while (ends.back() > firsts[i]) ends.push_back(firsts[ends.back() - 1]);
      const size_t count = ends.size() - 1;
      for (size_t part = count / 2; part > 0; part /= 2) {
        for (size_t k = 0; k + part <= count; k += part) {
          if (take(without(all, i, ends[k + part], ends[k], count - part))) return true;
        }
      }
    }
    return false;
  }

  /// Returns the scene without the tokens [from, to), which are operands of the operation `op`;
  /// `operands` of its operands are left.
  Scene without(const Tokens& all, size_t op, size_t from, size_t to, size_t operands) const {
    Tokens rest = all;
    rest[op].value = uint32_t(operands);
    if (operands == 1) rest.erase(rest.begin() + long(op));
    rest.erase(rest.begin() + long(from), rest.begin() + long(to));
    return scene_of(best_.primitives, rest);
  }

  bool simplify_shapes() {
    for (size_t i = 0; i < best_.primitives.size(); ++i) {
      const Primitive primitive = best_.primitives[i];
      for (const Primitive& simpler : twin_of(primitive.shape()).simpler(primitive)) {
        if (take(simpler, i)) return true;
      }
    }
    return false;
  }

  bool simplify_numbers() {
    bool taken = false;
    for (size_t i = 0; i < best_.primitives.size(); ++i) {
      Primitive upright = best_.primitives[i];
      upright.local_to_world.linear = csgcore::Mat3(1.0);
      taken |= take(upright, i);
      const size_t count = numbers_of(upright).size();
      for (size_t k = 0; k < count; ++k) taken |= simplify_number(i, k);
    }
    return taken;
  }

  bool simplify_number(size_t index, size_t which) {
    const double number = *numbers_of(best_.primitives[index])[which];
    const auto take_number = [&](double simple) {
      Primitive primitive = best_.primitives[index];
      *numbers_of(primitive)[which] = simple;
      return take(primitive, index);
    };
    if (take_number(0) || take_number(std::copysign(1, number))) return true;
    for (int digits = 1; digits <= std::numeric_limits<double>::digits10; ++digits) {
      char text[40];
      std::snprintf(text, sizeof text, "%.*g", digits, number);
      if (take_number(std::strtod(text, nullptr))) return true;
    }
    return false;
  }

  const Shows& shows_;
  uint32_t tries_left_;
  Scene best_;
  Size size_;
};

}  // namespace

Scene minimise(const Scene& scene, const Shows& shows, uint32_t most_tries) {
  return Minimiser(scene, shows, most_tries).run();
}

}  // namespace oracle
