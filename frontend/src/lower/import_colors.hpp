// The colours that OpenSCAD's color() knows by name.
#pragma once

#include <optional>
#include <string_view>

#include "csgcore/primitive.hpp"

namespace frontend {

/// "red", "#f00", "#ff0000" or "#ff0000ff", capitals or not, as OpenSCAD takes them.
std::optional<csgcore::Color> color_of_name(std::string_view name);

}  // namespace frontend
