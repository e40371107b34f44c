#include "lower/typed_numbers.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

namespace frontend {
namespace {

double error_of(const Value& value) {
  const bool is_finite = value.kind == ValueKind::kNumber && std::isfinite(value.number);
  return is_finite ? typed_error(value.number) : 0;
}

/// Returns the largest error of the numbers in a value and in the lists that it holds.
double error_within(const SyntaxTree& tree, const Value& value) {
  double largest = error_of(value);
  if (value.kind != ValueKind::kList) return largest;
  for (const Value& element : tree.elements_of(value)) {
    largest = std::max(largest, error_of(element));
    if (element.kind != ValueKind::kList) continue;
    for (const Value& number : tree.elements_of(element)) {
      largest = std::max(largest, error_of(number));
    }
  }
  return largest;
}

/// A radius scales what is round about its axis; of a sphere, about its centre.
void add_radius(NodeKind kind, const Value& radius, HealedMatrix& errors) {
  const double error = error_of(radius);
  if (error == 0) return;
  const int axes = kind == NodeKind::kSphere ? 3 : 2;
  for (int i = 0; i < axes; ++i) {
    errors.linear_error[i][i] =
        std::max(errors.linear_error[i][i], error / std::abs(radius.number));
  }
}

void add_axis(int axis, double error, HealedMatrix& errors) {
  errors.translation_error[axis] = std::max(errors.translation_error[axis], error);
}

void add_cube(const SyntaxTree& tree, const Value& size, HealedMatrix& errors) {
  if (size.kind != ValueKind::kList) return;
  const std::span<const Value> sizes = tree.elements_of(size);
  for (int i = 0; i < std::min<int>(3, static_cast<int>(sizes.size())); ++i) {
    add_axis(i, error_of(sizes[i]), errors);
  }
}

void add_argument(const SyntaxTree& tree, NodeKind kind, const Argument& argument,
                  HealedMatrix& errors) {
  const std::string_view name = argument.name;
  if (name == "r" || name == "r1" || name == "r2") {
    add_radius(kind, argument.value, errors);
  } else if (name == "h" || name == "height") {
    add_axis(2, error_of(argument.value), errors);
  } else if (kind == NodeKind::kCube && name == "size") {
    add_cube(tree, argument.value, errors);
  } else if (name == "size" || name == "points" || name == "delta" || name == "newsize") {
    const double error = error_within(tree, argument.value);
    const bool is_solid = kind == NodeKind::kPolyhedron || kind == NodeKind::kResize;
    for (int i = 0; i < (is_solid ? 3 : 2); ++i) add_axis(i, error, errors);
  }
}

}  // namespace

HealedMatrix typed_numbers(const SyntaxTree& tree, uint32_t node) {
  HealedMatrix errors;
  errors.map.linear = csgcore::Mat3(1.0);
  errors.map.translation = csgcore::Vec3(0.0);
  for (uint32_t i = node; i < tree.nodes[node].subtree_end; ++i) {
    for (const Argument& argument : tree.arguments_of(tree.nodes[i])) {
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
