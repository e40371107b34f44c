#include "prepared_scene.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <map>
#include <utility>
#include <vector>

#include "exact_mesh.hpp"
#include "exact_twin.hpp"
#include "oracle/exact_rays.hpp"

namespace oracle {
namespace {

using csgcore::Affine;
using csgcore::Box;
using csgcore::Op;
using csgcore::Primitive;
using csgcore::Scene;
using csgcore::TriangleMesh;
using csgcore::Vec3;

/// τ, as a share of the model's size (csgcore/NUMERICS.md, 1).
constexpr double kThicknessTolerance = 1e-9;

/// Returns the primitive's box relative to a point. RoundingUp must be on.
Box box_about(const Vec3& point, const Primitive& primitive) {
  Box box;
  twin_of(primitive.shape()).merge_box(point, primitive, box);
  return box;
}

/// Returns the model's box: for a union the union of the operands' boxes, for an intersection their
/// intersection, for a difference the first operand's box.
Box model_box(const Scene& scene, const std::vector<Box>& boxes) {
  std::vector<Box> stack;
  for (const csgcore::CsgToken& token : scene.model.tokens()) {
    if (token.is_primitive) {
      stack.push_back(boxes[token.value]);
      continue;
    }
    const size_t first = stack.size() - token.value;
    Box box = stack[first];
    for (size_t i = first + 1; i < stack.size() && token.op != Op::kDifference; ++i) {
      if (token.op == Op::kUnion) {
        box.merge(stack[i]);
      } else {
        box = {glm::max(box.min, stack[i].min), glm::min(box.max, stack[i].max)};
      }
    }
    stack.resize(first);
    stack.push_back(box.empty() ? Box{} : box);
  }
  return stack.empty() ? Box{} : stack.back();
}

std::vector<Box> boxes_about(const Vec3& point, const Scene& scene) {
  std::vector<Box> boxes;
  for (const Primitive& primitive : scene.primitives) {
    boxes.push_back(box_about(point, primitive));
  }
  return boxes;
}

/// Returns a point near the model; any will do.
Vec3 pivot_of(const Scene& scene) {
  const Box box = model_box(scene, boxes_about(Vec3(0.0), scene));
  return box.empty() ? Vec3(0.0) : box.center();
}

std::vector<uint32_t> find_alike(const Scene& scene) {
  std::map<std::pair<csgcore::LocalSolid, std::array<double, 12>>, uint32_t> first;
  std::vector<uint32_t> result;
  for (const Primitive& p : scene.primitives) {
    const Affine& map = p.local_to_world;
    std::array<double, 12> numbers;
    auto* next = numbers.begin();
    for (const Vec3& column : {map.linear[0], map.linear[1], map.linear[2], map.translation}) {
      for (int i = 0; i < 3; ++i) *next++ = column[i];
    }
    const auto index = uint32_t(result.size());
    result.push_back(first.try_emplace({p.solid, numbers}, index).first->second);
  }
  return result;
}

/// Returns the displacement by the rounding of coordinates: those of a point near the model and
/// those of a primitive's middle, each by the spacing of doubles there.
double coordinate_rounding(const Vec3& pivot, double size) {
  constexpr double kSpacing = std::numeric_limits<double>::epsilon();
  const Vec3 far = glm::abs(pivot);
  return 2 * kSpacing * (std::max({far.x, far.y, far.z}) + size);
}

}  // namespace

PreparedScene::PreparedScene(const Scene& prepared)
    : scene(prepared), outside(prepared.model, prepared.primitives.size()), boxes({}) {
  const RoundingUp rounding_up;
  pivot = pivot_of(scene);
  const std::vector<Box> all = boxes_about(pivot, scene);
  size = model_box(scene, all).diagonal();
  thickness = kThicknessTolerance * size;
  displacement = kExactDisplacement * size + coordinate_rounding(pivot, size);
  unit = size > 0 ? std::ldexp(1.0, -std::ilogb(size)) : 1;
  for (const Primitive& primitive : scene.primitives) {
    exact.push_back(make_target(primitive, pivot, unit));
    intervals.push_back(enclose(exact.back()));
  }
  first_alike = find_alike(scene);
  std::vector<Box> named;
  for (uint32_t i = 0; i < all.size(); ++i) {
    if (!outside.names(i)) continue;
    boxed.push_back(i);
    // The sheets of an open mesh reach out of its box.
    const TriangleMesh* const mesh = scene.primitives[i].mesh();
    const bool has_sheets = mesh && !mesh->is_closed();
    const Vec3 reach(has_sheets ? kSheetThickness * thickness / kSheetCosine : 0);
    named.push_back({unit * (all[i].min - reach), unit * (all[i].max + reach)});
  }
  boxes = BoxTree(named);
}

}  // namespace oracle
