// The look of a picture, whichever renderer draws it.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>

#include "csgcore/geometry.hpp"

namespace csgcore {

enum class Shading : uint8_t {
  kOpenScad,  // OpenSCAD's light: rgb · (0.2 + |n·(−1, 1, 1)/√3|) in eye space
  kPhong,     // positional light with ambient, diffuse and specular parts (csgcore/phong.hpp)
  kStudio,    // distant key and fill lights and light from all around (csgcore/studio_light.hpp)
};

struct FrameSettings {
  glm::vec3 background{1.0f};  // each channel in [0, 1], as the picture stores it
  /// The background's colour at the picture's lower edge; from `background`, at the upper one, it
  /// changes evenly. None: it is one colour.
  std::optional<glm::vec3> background_below;
  glm::vec3 front{1.0f};  // colour of surfaces whose primitive has none
  glm::vec3 back{1.0f};   // colour of cut faces whose primitive has none
  /// The colour of every face that is seen from within the solid. None: it is that of the outside.
  std::optional<glm::vec3> from_within;
  Shading shading = Shading::kOpenScad;
  bool measured_channels = false;  // fill Image's z, normal, position and id
  bool depth_and_id_only = false;  // of the measured channels fill z and id alone
  /// The box that the light and, in GL, the precision are fitted to; empty: the solid's own bounds.
  /// Pictures that are laid over each other need the same box, which holds all of their solids.
  Box scene_box;
};

/// Returns the colour of the background in the middle of a row, of which 0 is the uppermost.
inline glm::vec3 background_of_row(const FrameSettings& settings, uint32_t y, uint32_t height_px) {
  if (!settings.background_below) return settings.background;
  const float below = (static_cast<float>(y) + 0.5f) / static_cast<float>(height_px);
  return settings.background * (1 - below) + *settings.background_below * below;
}

/// Returns that colour as an Image has it.
inline std::array<uint8_t, 3> background_pixel(const FrameSettings& settings, uint32_t y,
                                               uint32_t height_px) {
  const glm::vec3 color = background_of_row(settings, y, height_px);
  const auto channel = [](float value) {
    return static_cast<uint8_t>(std::lround(255.0f * std::clamp(value, 0.0f, 1.0f)));
  };
  return {channel(color.r), channel(color.g), channel(color.b)};
}

}  // namespace csgcore
