// Scenes that grow by parts that cannot be seen: the picture stays the same, whatever their number.
#pragma once

#include <cstdint>
#include <span>

#include "csgcore/scene.hpp"
#include "csgcore/view.hpp"

namespace frame_benchmark {

/// The primitives that make up the visible body of each scene.
constexpr uint32_t kVisiblePrimitives = 1000;

struct GrowthScene {
  const char* name;
  /// The visible body, its primitives first, and so many primitives that growth_view() does not
  /// show.
  csgcore::Scene (*make)(uint32_t unseen);
};
std::span<const GrowthScene> growth_scenes();

/// The view of all of them.
const csgcore::View& growth_view();

}  // namespace frame_benchmark
