// A profile in POV-Ray's language.
#pragma once

#include <string>

#include "csgcore/profile.hpp"

namespace test_support::povray {

/// Returns "count, points" for a linear spline. Curves become many lines; each loop is closed by
/// its first point.
std::string figure(const csgcore::Profile& profile, double scale);

}  // namespace test_support::povray
