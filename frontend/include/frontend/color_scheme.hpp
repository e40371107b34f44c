// OpenSCAD's eleven colour schemes.
#pragma once

#include <span>
#include <string_view>

#include "frontend/render_settings.hpp"

namespace frontend {

/// Returns the schemes in OpenSCAD's order; the first is the default.
std::span<const ColorScheme> color_schemes();

/// Finds a scheme by its exact name, upper and lower case distinguished, as OpenSCAD does. Null if
/// there is none.
const ColorScheme* find_color_scheme(std::string_view name);

}  // namespace frontend
