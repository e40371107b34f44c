// The look of a picture, whichever renderer draws it.
#pragma once

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
  glm::vec3 front{1.0f};       // colour of surfaces whose primitive has none
  glm::vec3 back{1.0f};        // colour of cut faces whose primitive has none
  /// The colour of every face that is seen from within the solid. None: it is that of the outside.
  std::optional<glm::vec3> from_within;
  Shading shading = Shading::kOpenScad;
  bool measured_channels = false;  // fill Image's z, normal, position and id
  bool depth_and_id_only = false;  // of the measured channels fill z and id alone
  /// The box that the light and, in GL, the precision are fitted to; empty: the solid's own bounds.
  /// Pictures that are laid over each other need the same box, which holds all of their solids.
  Box scene_box;
};

}  // namespace csgcore
