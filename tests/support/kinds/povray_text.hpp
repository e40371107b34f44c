// Numbers, vectors and profiles in POV-Ray's language.
#pragma once

#include <string>

#include "csgcore/geometry.hpp"
#include "csgcore/profile.hpp"

namespace test_support::povray {

/// All 17 digits, by which POV-Ray reads the same double.
std::string number(double value);
std::string vector(const csgcore::Vec3& v);
/// Returns "count, points" for a linear spline. Curves become many lines; each loop is closed by
/// its first point.
std::string figure(const csgcore::Profile& profile, double scale);

}  // namespace test_support::povray
