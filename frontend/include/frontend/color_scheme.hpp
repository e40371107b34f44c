// OpenSCAD's eleven colour schemes.
#pragma once

#include <span>
#include <string_view>

#include "frontend/render_settings.hpp"

namespace frontend {

/// In OpenSCAD's order; the first is the default.
std::span<const ColorScheme> color_schemes();

/// Null where no scheme has that name, which is compared to the letter, as OpenSCAD does.
const ColorScheme* find_color_scheme(std::string_view name);

}  // namespace frontend
