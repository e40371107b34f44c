#include "kinds/povray_text.hpp"

#include <cstdio>

namespace test_support::povray {

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

std::string vector(const csgcore::Vec3& v) {
  return std::string("<") + number(v.x) + "," + number(v.y) + "," + number(v.z) + ">";
}

}  // namespace test_support::povray
