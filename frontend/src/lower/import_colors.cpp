#include "lower/import_colors.hpp"

#include <array>

#include "language/color_names.hpp"

namespace frontend {

std::optional<csgcore::Color> color_of_name(std::string_view name) {
  const std::optional<std::array<float, 4>> color = language::color_of_name(name);
  if (!color) return std::nullopt;
  return csgcore::Color{(*color)[0], (*color)[1], (*color)[2], (*color)[3]};
}

}  // namespace frontend
