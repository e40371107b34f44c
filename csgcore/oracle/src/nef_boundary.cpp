#include "nef_boundary.hpp"

#include <istream>
#include <ostream>
#include <stdexcept>
#include <string>

namespace oracle {
namespace {

// The base of numbers in the text. A power of two is fastest.
constexpr int kBase = 32;

}  // namespace

void write_boundary(std::ostream& out, const ExactBoundary& boundary) {
  out << boundary.vertices.size() << ' ' << boundary.triangles.size() << '\n';
  for (const Point& vertex : boundary.vertices) {
    for (int axis = 0; axis < 3; ++axis) {
      out << rational_of(vertex[axis]).get_str(kBase) << (axis < 2 ? ' ' : '\n');
    }
  }
  for (const auto& [a, b, c] : boundary.triangles) out << a << ' ' << b << ' ' << c << '\n';
}

ExactBoundary read_boundary(std::istream& in) {
  std::size_t vertices = 0, triangles = 0;
  in >> vertices >> triangles;
  ExactBoundary boundary;
  for (std::size_t i = 0; i < vertices && in; ++i) {
    std::array<Number, 3> coordinates;
    for (Number& coordinate : coordinates) {
      std::string digits;
      if (in >> digits) coordinate = Rational(digits, kBase);
    }
    boundary.vertices.emplace_back(coordinates[0], coordinates[1], coordinates[2]);
  }
  for (std::size_t i = 0; i < triangles && in; ++i) {
    auto& [a, b, c] = boundary.triangles.emplace_back();
    in >> a >> b >> c;
  }
  if (!in) throw std::runtime_error("the boundary of a solid ends early");
  return boundary;
}

}  // namespace oracle
