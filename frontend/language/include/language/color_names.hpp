// The colours that color() knows by name.
#pragma once

#include <array>
#include <optional>
#include <string_view>

namespace language {

/// Returns red, green, blue and alpha from 0 to 1 of a CSS name in any case, "transparent" among
/// them, or of "#rgb", "#rgba", "#rrggbb", "#rrggbbaa"; nothing for any other text. `has_survey`:
/// also of "xkcd:" with a name of that colour survey.
std::optional<std::array<float, 4>> color_of_name(std::string_view name, bool has_survey = false);

}  // namespace language
