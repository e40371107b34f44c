// Small designs for the window's tests.
#pragma once

#include <string>

namespace window_test {

/// Two primitives that look different from every side.
inline const std::string kBlock = R"(difference() {
	cube(size = [10, 20, 30], center = true);
	multmatrix([[1, 0, 0, 5], [0, 1, 0, 10], [0, 0, 1, 15], [0, 0, 0, 1]]) {
		sphere($fn = 0, $fa = 12, $fs = 2, r = 8);
	}
}
)";

/// A ball about the origin.
constexpr double kBallRadius = 10;
inline const std::string kBall = "sphere($fn = 0, $fa = 12, $fs = 2, r = 10);\n";

/// A row of `count` spheres.
inline std::string row_of(int count) {
  std::string text;
  for (int i = 0; i < count; ++i) {
    text += "multmatrix([[1, 0, 0, " + std::to_string(3 * i) +
            "], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]) {\n"
            "\tsphere($fn = 0, $fa = 12, $fs = 2, r = 2);\n}\n";
  }
  return text;
}

}  // namespace window_test
