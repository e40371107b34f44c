// Scenes that grow by parts that cannot be seen: the picture stays the same, whatever their number.
#pragma once

#include <cstdint>
#include <span>

#include "csgcore/scene.hpp"
#include "csgcore/view.hpp"

namespace frame_benchmark {

/// The number of primitives of each scene's visible body.
constexpr uint32_t kVisiblePrimitives = 1000;

struct GrowthScene {
  const char* name;
  /// Makes the visible body, whose primitives come first, and `unseen` primitives that
  /// growth_view() does not show.
  csgcore::Scene (*make)(uint32_t unseen);
};
std::span<const GrowthScene> growth_scenes();

/// The view of all these scenes.
const csgcore::View& growth_view();

}  // namespace frame_benchmark
