// Scenes with any number of primitives.
#pragma once

#include <cstdint>
#include <span>

#include "csgcore/scene.hpp"

namespace measure {

struct SceneFamily {
  const char* name;   // in the results
  const char* title;  // for readers
  /// Makes a scene of about `primitives` primitives, at least 10; always the same.
  csgcore::Scene (*make)(uint32_t primitives);
};
std::span<const SceneFamily> scene_families();

}  // namespace measure
