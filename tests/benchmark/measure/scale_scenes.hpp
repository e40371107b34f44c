// Scenes of any number of primitives.
#pragma once

#include <cstdint>
#include <span>

#include "csgcore/scene.hpp"

namespace measure {

struct SceneFamily {
  const char* name;   // in the results
  const char* title;  // to be read
  /// Of about so many primitives, at least 10; always the same.
  csgcore::Scene (*make)(uint32_t primitives);
};
std::span<const SceneFamily> scene_families();

}  // namespace measure
