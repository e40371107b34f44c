#include "kinds/povray_text.hpp"

#include <cstdio>

#include "kinds/profile_figure.hpp"

namespace test_support::povray {

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

std::string vector(const csgcore::Vec3& v) {
  return std::string("<") + number(v.x) + "," + number(v.y) + "," + number(v.z) + ">";
}

std::string figure(const csgcore::Profile& profile, double scale) {
  constexpr int kParts = 256;
  const csgcore::reference::Figure all(profile);
  std::string points;
  size_t count = 0, edge = 0;
  const auto add = [&](const csgcore::reference::LongVec2& p) {
    points += ", <" + number(scale * double(p.x)) + "," + number(scale * double(p.y)) + ">";
    ++count;
  };
  for (const csgcore::ProfileLoop& loop : profile.loops()) {
    add(all.edges()[edge].start);
    for (size_t i = 0; i < loop.size(); ++i, ++edge) {
      const int parts = all.edges()[edge].is_line() ? 1 : kParts;
      for (int part = 1; part < parts; ++part) {
        add(all.edges()[edge].at(csgcore::Real(part) / parts));
      }
      add(all.edges()[edge].end);
    }
  }
  return std::to_string(count) + points;
}

}  // namespace test_support::povray
