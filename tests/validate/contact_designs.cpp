#include "contact_designs.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <random>
#include <vector>

namespace validation {
namespace {

class Maker {
 public:
  explicit Maker(uint32_t seed) : random_(seed) {}

  std::string design() {
    const int count = 2 + below(5);
    // Starts with a large part that others reach into, or with any part.
    std::string text = below(3) > 0 ? host() : part();
    if (below(2) == 0) return operation("difference", text + parts(count - 1));
    for (int left = count - 1; left > 0;) {
      const int operands = 1 + below(left);
      left -= operands;
      const std::string more = operands > 1 && below(2) == 0
                                   ? operation(any_operation(), parts(operands))
                                   : parts(operands);
      text = operation(any_operation(), text + more);
    }
    return text;
  }

 private:
  /// Returns a number in [0, limit). std::uniform_int_distribution differs from one library to
  /// another.
  int below(int limit) { return static_cast<int>(random_() % static_cast<uint32_t>(limit)); }
  int from_to(int first, int last) { return first + below(last - first + 1); }

  static std::string operation(const std::string& name, const std::string& operands) {
    return name + "() {\n" + operands + "}\n";
  }

  std::string any_operation() {
    constexpr const char* kOperations[] = {"union", "union", "difference", "intersection"};
    return kOperations[below(std::size(kOperations))];
  }

  std::string parts(int count) {
    std::string text;
    for (int i = 0; i < count; ++i) text += part();
    return text;
  }

  /// Its faces lie in planes x, y or z = ±2 or ±3.
  std::string host() {
    const int half = from_to(2, 3);
    if (below(2) == 0) {
      return "cube(size = [" + std::to_string(2 * half) + ", " + std::to_string(2 * half) + ", " +
             std::to_string(2 * half) + "], center = true);\n";
    }
    return cylinder(2 * half, half + 1, half + 1, true);
  }

  std::string part() {
    const std::string map = place();
    switch (below(4)) {
      case 0:
        return map + "cube(size = [" + std::to_string(from_to(1, 4)) + ", " +
               std::to_string(from_to(1, 4)) + ", " + std::to_string(from_to(1, 4)) +
               "], center = false);\n";
      case 1: {
        const int r = from_to(1, 3);
        const int top = below(3) > 0 ? r : from_to(0, 3);
        return map + cylinder(from_to(1, 4), r, top, false);
      }
      case 2: {  // lowered by half its height, so that an edge of a prism is in a face, and its
                 // axis along it
        const int r = from_to(1, 3);
        return map + cylinder(2 * from_to(1, 3), r, r, true);
      }
      default:
        return map + polyhedron(from_to(1, 3));
    }
  }

  /// Has a vertex at (r, 0), and mostly one at each half-axis.
  std::string cylinder(int h, int r_bottom, int r_top, bool center) {
    constexpr int kFragments[] = {3, 4, 4, 6, 8, 8};
    return "cylinder($fn = " + std::to_string(kFragments[below(std::size(kFragments))]) +
           ", h = " + std::to_string(h) + ", r1 = " + std::to_string(r_bottom) +
           ", r2 = " + std::to_string(r_top) + ", center = " + (center ? "true" : "false") + ");\n";
  }

  std::string polyhedron(int size) {
    // Faces are clockwise seen from outside.
    constexpr const char* kFaces[] = {
        "[[1, 2, 0], [3, 1, 0], [2, 3, 0], [3, 2, 1]]",                      // a cube's corner
        "[[2, 1, 0], [4, 5, 3], [1, 4, 3, 0], [2, 5, 4, 1], [3, 5, 2, 0]]",  // a roof
        "[[4, 2, 0], [5, 0, 2], [5, 3, 0], [4, 0, 3], [5, 2, 1], [4, 1, 2], [4, 3, 1], [5, 1, 3]]",
    };
    using Points = std::vector<std::array<int, 3>>;
    const Points points[] = {
        {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
        {{0, 0, 0}, {2, 0, 0}, {1, 0, 1}, {0, 2, 0}, {2, 2, 0}, {1, 2, 1}},
        {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},  // an octahedron
    };
    const int kind = below(std::size(kFaces));
    std::string text = "polyhedron(points = [";
    for (std::size_t i = 0; i < points[kind].size(); ++i) {
      text += i == 0 ? "[" : ", [";
      for (int axis = 0; axis < 3; ++axis) {
        text += (axis == 0 ? "" : ", ") + std::to_string(size * points[kind][i][axis]);
      }
      text += "]";
    }
    return text + "], faces = " + kFaces[kind] + ", convexity = 1);\n";
  }

  /// Places a part at integers, turned by right angles or mirrored; some are turned by 45° and
  /// stretched.
  std::string place() {
    std::array<int, 3> axes = {0, 1, 2};
    for (int i = 2; i > 0; --i) std::swap(axes[i], axes[below(i + 1)]);
    std::array<std::array<int, 3>, 3> rows{};
    for (int i = 0; i < 3; ++i) rows[i][axes[i]] = below(2) == 0 ? 1 : -1;
    if (below(4) == 0) {
      const int fixed = below(3), a = (fixed + 1) % 3, b = (fixed + 2) % 3;
      const auto first = rows[a], second = rows[b];
      for (int k = 0; k < 3; ++k) {
        rows[a][k] = first[k] - second[k];
        rows[b][k] = first[k] + second[k];
      }
    }
    std::string text = "multmatrix([";
    for (const auto& row : rows) {
      text += "[";
      for (const int number : row) text += std::to_string(number) + ", ";
      text += std::to_string(from_to(-3, 3)) + "], ";
    }
    return text + "[0, 0, 0, 1]]) ";
  }

  std::mt19937 random_;
};

}  // namespace

std::string contact_design(uint32_t seed) { return Maker(seed).design(); }

}  // namespace validation
