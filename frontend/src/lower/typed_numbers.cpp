#include "lower/typed_numbers.hpp"

#include <algorithm>
#include <cmath>

#include "csg/argument_value.hpp"

namespace frontend {
namespace {

double error_of(const ArgumentValue& value) {
  const bool is_finite = value.is_number() && std::isfinite(value.number());
  return is_finite ? typed_error(value.number()) : 0;
}

/// Returns the largest error of the numbers in a value and in the lists that it holds.
double error_within(const ArgumentValue& value) {
  double largest = error_of(value);
  if (!value.is_list()) return largest;
  for (const ArgumentValue element : value.elements()) {
    largest = std::max(largest, error_of(element));
    if (!element.is_list()) continue;
    for (const ArgumentValue number : element.elements()) {
      largest = std::max(largest, error_of(number));
    }
  }
  return largest;
}

/// A radius scales what is round about its axis; of a sphere, about its centre.
void add_radius(NodeKind kind, const ArgumentValue& radius, HealedMatrix& errors) {
  const double error = error_of(radius);
  if (error == 0) return;
  const int axes = kind == NodeKind::kSphere ? 3 : 2;
  for (int i = 0; i < axes; ++i) {
    errors.linear_error[i][i] =
        std::max(errors.linear_error[i][i], error / std::abs(radius.number()));
  }
}

void add_axis(int axis, double error, HealedMatrix& errors) {
  errors.translation_error[axis] = std::max(errors.translation_error[axis], error);
}

void add_cube(const ArgumentValue& size, HealedMatrix& errors) {
  if (!size.is_list()) return;
  const ValueList sizes = size.elements();
  for (int i = 0; i < std::min<int>(3, static_cast<int>(sizes.size())); ++i) {
    add_axis(i, error_of(sizes[i]), errors);
  }
}

void add_argument(const NodeTree& tree, NodeKind kind, const language::NodeArgument& argument,
                  HealedMatrix& errors) {
  const language::ArgumentName name = argument.name;
  const ArgumentValue value(tree, argument);
  if (name == "r" || name == "r1" || name == "r2") {
    add_radius(kind, value, errors);
  } else if (name == "h" || name == "height") {
    add_axis(2, error_of(value), errors);
  } else if (kind == NodeKind::kCube && name == "size") {
    add_cube(value, errors);
  } else if (name == "size" || name == "points" || name == "delta" || name == "newsize") {
    const double error = error_within(value);
    const bool is_solid = kind == NodeKind::kPolyhedron || kind == NodeKind::kResize;
    for (int i = 0; i < (is_solid ? 3 : 2); ++i) add_axis(i, error, errors);
  }
}

}  // namespace

HealedMatrix typed_numbers(const NodeTree& tree, uint32_t node) {
  HealedMatrix errors;
  errors.map.linear = csgcore::Mat3(1.0);
  errors.map.translation = csgcore::Vec3(0.0);
  for (uint32_t i = node; i < tree.nodes[node].end; ++i) {
    for (const language::NodeArgument& argument : tree.arguments_of(tree.nodes[i])) {
      add_argument(tree, tree.nodes[i].kind, argument, errors);
    }
  }
  for (int i = 0; i < 3; ++i) {
    errors.exact =
        errors.exact && errors.linear_error[i][i] == 0 && errors.translation_error[i] == 0;
  }
  return errors;
}

}  // namespace frontend
