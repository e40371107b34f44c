// Computes what the reference knows of a scene without rays.
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "reference_primitive.hpp"

namespace csgcore {
namespace {

Box primitive_box(const Primitive& p) {
  Box box;
  for (int axis = 0; axis < 3; ++axis) {
    Vec3 direction(0.0);
    direction[axis] = 1;
    box.max[axis] = reference::furthest(p, {Vec3(0.0), direction});
    box.min[axis] = -reference::furthest(p, {Vec3(0.0), -direction});
  }
  return box;
}

}  // namespace

Box reference_box(const Scene& scene) {
  std::vector<Box> stack;
  for (const CsgToken& token : scene.model.tokens()) {
    if (token.is_primitive) {
      stack.push_back(primitive_box(scene.primitives[token.value]));
      continue;
    }
    const size_t first = stack.size() - token.value;
    Box box = stack[first];
    for (size_t i = first + 1; i < stack.size(); ++i) {
      if (token.op == Op::kUnion) box.merge(stack[i]);
      if (token.op == Op::kIntersection) {
        box.min = glm::max(box.min, stack[i].min);
        box.max = glm::min(box.max, stack[i].max);
      }
    }
    stack.resize(first);
    stack.push_back(box.empty() ? Box{} : box);
  }
  return stack.empty() ? Box{} : stack.front();
}

std::vector<bool> subtracted_primitives(const Scene& scene) {
  // Read backwards, a postfix tree comes from the root down, with the last operand first. So a
  // stack of the operands that each open operation still expects gives every primitive's depth.
  struct Open {
    uint32_t operands_left;
    bool difference, subtracted;
  };
  std::vector<bool> result(scene.primitives.size(), false);
  std::vector<Open> open;
  const auto tokens = scene.model.tokens();
  for (size_t i = tokens.size(); i-- > 0;) {
    bool subtracted = false;
    if (!open.empty()) {
      Open& parent = open.back();
      subtracted = parent.subtracted != (parent.difference && parent.operands_left > 1);
      if (--parent.operands_left == 0) open.pop_back();
    }
    if (tokens[i].is_primitive) {
      result[tokens[i].value] = subtracted;
    } else {
      open.push_back({tokens[i].value, tokens[i].op == Op::kDifference, subtracted});
    }
  }
  return result;
}

void reference_shade_phong(Image& image, const Scene& scene, const View& view,
                           const PhongLight& light, const ReferenceColors& colors) {
  const std::vector<bool> subtracted = subtracted_primitives(scene);
  uint32_t ids = 0;
  for (const Primitive& p : scene.primitives) ids = std::max(ids, p.id + 1);
  std::vector<Vec3> base(ids, Vec3(0.0));
  for (size_t i = 0; i < scene.primitives.size(); ++i) {
    const Primitive& p = scene.primitives[i];
    base[p.id] = p.color ? Vec3(p.color->r, p.color->g, p.color->b)
                         : (subtracted[i] ? colors.back : colors.front);
  }
  const bool orthographic = view.projection == Projection::kOrthographic;
  for (size_t i = 0; i < image.rgb.size(); ++i) {
    Vec3 color = colors.background;
    if (image.id[i] != kNoPrimitive) {
      const Vec3 position(image.position[i]);
      const Vec3 direction = orthographic ? view.forward : position - view.eye;
      color = phong_color(base[image.id[i]], position, Vec3(image.normal[i]), direction, light);
    }
    for (int c = 0; c < 3; ++c) image.rgb[i][c] = uint8_t(std::lround(255 * color[c]));
  }
}

}  // namespace csgcore
