#include "lower/import_view_box.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <numbers>
#include <vector>

#include "csgcore/polyhedron.hpp"

namespace frontend {
namespace {

using csgcore::Box;
using csgcore::CsgToken;
using csgcore::Op;
using csgcore::Vec3;

double cos_of_turn(double part) { return std::cos(2 * std::numbers::pi * part); }

/// Box of the regular polygon whose vertex 0 is (1, 0), x and y only. Only the vertices nearest to
/// the four axes matter.
Box unit_polygon_box(int fragments) {
  const double n = fragments;
  // The greatest coordinate along the axis that lies `turn` of a circle away from vertex 0.
  const auto reach = [&](double turn) { return cos_of_turn(std::round(turn * n) / n - turn); };
  Box box;
  box.min = Vec3(-reach(0.5), -reach(0.75), 0);
  box.max = Vec3(1, reach(0.25), 0);
  return box;
}

/// The box of the unit sphere's rings (frontend/OPENSCAD.md, "Facets"), from the polygon's.
Box unit_sphere_box(int fragments, const Box& polygon) {
  const double rings = csgcore::ring_count(fragments);
  const double nearest_equator = std::floor(rings / 2) + 0.5;
  const double widest = std::sin(std::numbers::pi * nearest_equator / rings);
  const double height = std::cos(std::numbers::pi * 0.5 / rings);
  return {{polygon.min.x * widest, polygon.min.y * widest, -height},
          {polygon.max.x * widest, polygon.max.y * widest, height}};
}

struct UnitBoxes {
  int fragments = 0;
  Box polygon, sphere;
};

/// A file has few numbers of fragments, mostly in a row: the last one's boxes are kept.
const UnitBoxes& unit_boxes(int fragments) {
  thread_local UnitBoxes last;
  if (last.fragments != fragments) {
    last.fragments = fragments;
    last.polygon = unit_polygon_box(fragments);
    last.sphere = unit_sphere_box(fragments, last.polygon);
  }
  return last;
}

/// In local coordinates.
Box faceted_round_box(const csgcore::Primitive& primitive, const csgcore::FacetSettings& settings) {
  const double radius = std::max(primitive.r_bottom, primitive.r_top);
  const UnitBoxes& unit = unit_boxes(fragment_count(primitive, settings));
  if (primitive.shape == csgcore::Shape::kSphere) {
    return {radius * unit.sphere.min, radius * unit.sphere.max};
  }
  Box box{radius * unit.polygon.min, radius * unit.polygon.max};
  box.min.z = primitive.z_min;
  box.max.z = primitive.z_max;
  return box;
}

Box box_of_points(std::span<const Vec3> points) {
  Box box;
  for (const Vec3& point : points) box.merge(point);
  return box;
}

Box intersection(const Box& a, const Box& b) {
  return {glm::max(a.min, b.min), glm::min(a.max, b.max)};
}

/// The boxes of all subtrees, in the tokens' order.
std::vector<Box> subtree_boxes(std::span<const CsgToken> tokens, std::span<const Box> boxes) {
  std::vector<Box> result(tokens.size());
  std::vector<size_t> operands;
  for (size_t i = 0; i < tokens.size(); ++i) {
    const CsgToken& token = tokens[i];
    if (token.is_primitive) {
      result[i] = boxes[token.value];
    } else {
      const size_t first = operands.size() - token.value;
      result[i] = result[operands[first]];
      for (size_t k = first + 1; k < operands.size(); ++k) {
        const Box& operand = result[operands[k]];
        if (token.op == Op::kUnion) result[i].merge(operand);
        if (token.op == Op::kIntersection) result[i] = intersection(result[i], operand);
      }
      operands.resize(first);
    }
    operands.push_back(i);
  }
  return result;
}

/// An operation on the way from the root to a leaf.
struct OpenOperation {
  Op op;
  bool negative;
  uint32_t operands_left;  // the last operand comes first
  Box context;             // where the operands can be seen
};

}  // namespace

int fragment_count(const csgcore::Primitive& primitive, const csgcore::FacetSettings& settings) {
  return csgcore::fragment_count(std::max(primitive.r_bottom, primitive.r_top), settings);
}

Box faceted_box(const csgcore::Primitive& primitive, const csgcore::FacetSettings& settings) {
  const Box local = primitive.shape == csgcore::Shape::kPolyhedron
                        ? box_of_points(primitive.polyhedron->vertices())
                        : faceted_round_box(primitive, settings);
  const csgcore::Affine& map = primitive.local_to_world;
  const Vec3 half = 0.5 * local.size();
  const Vec3 reach = glm::abs(map.linear[0]) * half.x + glm::abs(map.linear[1]) * half.y +
                     glm::abs(map.linear[2]) * half.z;
  const Vec3 center = map.point(local.center());
  return {center - reach, center + reach};
}

Box view_box(const csgcore::CsgTree& tree, std::span<const Box> boxes) {
  const std::span<const CsgToken> tokens = tree.tokens();
  const std::vector<Box> subtree = subtree_boxes(tokens, boxes);
  const Box everywhere{Vec3(-std::numeric_limits<double>::infinity()),
                       Vec3(std::numeric_limits<double>::infinity())};
  Box result;
  std::vector<OpenOperation> open;
  for (size_t i = tokens.size(); i-- > 0;) {
    bool negative = false;
    Box context = everywhere;
    if (!open.empty()) {
      const OpenOperation& parent = open.back();
      const bool subtracted = parent.op == Op::kDifference && parent.operands_left > 1;
      negative = parent.negative != subtracted;
      context = parent.context;
    }
    if (!tokens[i].is_primitive) {
      // A negated intersection is a union of complements: its operands do not bound one another.
      const bool bounds = !negative && tokens[i].op != Op::kUnion;
      open.push_back({tokens[i].op, negative, tokens[i].value,
                      bounds ? intersection(context, subtree[i]) : context});
      continue;
    }
    if (!negative && !intersection(subtree[i], context).empty()) result.merge(subtree[i]);
    while (!open.empty() && --open.back().operands_left == 0) open.pop_back();
  }
  return result;
}

}  // namespace frontend
