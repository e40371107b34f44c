// Numbers and vectors in POV-Ray's language.
#pragma once

#include <string>

#include "csgcore/geometry.hpp"

namespace test_support::povray {

/// All 17 digits, by which POV-Ray reads the same double.
std::string number(double value);
std::string vector(const csgcore::Vec3& v);

}  // namespace test_support::povray
