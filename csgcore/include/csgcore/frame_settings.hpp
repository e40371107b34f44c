// What a picture of a solid looks like, whichever renderer draws it.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>

#include "csgcore/geometry.hpp"

namespace csgcore {

enum class Shading : uint8_t {
  kOpenScad,  // rgb · (0.2 + |n·(−1, 1, 1)/√3|) in eye space, OpenSCAD's light
  kPhong,     // positional light, ambient, diffuse and specular (paper §3.2; csgcore/phong.hpp)
};

struct FrameSettings {
  glm::vec3 background{1.0f};  // each 0…1, as the picture stores it
  glm::vec3 front{1.0f};       // of what has no colour of its own
  glm::vec3 back{1.0f};        // of cut faces that have none
  /// The colour of every face that is seen from within the solid. None: it is that of the outside.
  std::optional<glm::vec3> from_within;
  Shading shading = Shading::kOpenScad;
  bool measured_channels = false;  // fill Image's z, normal, position and id
  /// What the frame's light and, in GL, its precision are fitted to; empty: the solid's own box.
  /// Pictures that are laid over each other need the same one, holding all of their solids.
  Box scene_box;
};

}  // namespace csgcore
