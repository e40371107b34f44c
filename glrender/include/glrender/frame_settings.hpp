// The settings of a frame, and its statistics.
#pragma once

#include <cstdint>

#include "csgcore/frame_settings.hpp"

namespace glrender {

using csgcore::Shading;

enum class Subject : uint8_t {
  kSurface,
  kCells,  // the leaf cells that hold a surface, as boxes (paper, figure 5b)
};

/// Selects where a ray's candidate primitives come from.
enum class Technique : uint8_t {
  kCells,  // the leaf cells of the subdivision that was loaded (paper §3)
  kTiles,  // lists for tiles of the screen, which the CPU makes for each frame
};

struct FrameSettings : csgcore::FrameSettings {
  glm::vec3 edge{0.0f};  // colour of the cells' edges, in [0, 1]
  Subject subject = Subject::kSurface;
  Technique technique = Technique::kCells;  // kTiles draws kSurface only
  unsigned threads = 0;                     // for the tiles' lists; 0: all processors
  /// Rays per pixel, ≥ 1. csgcore::sample_offset displaces them, and rgb is their average. The
  /// measured channels are those of the pixel's centre.
  uint32_t samples = 1;
};

/// Statistics of one frame, all its samples included. Times are in ms; the GPU has finished before
/// a clock is read.
struct FrameStats {
  uint64_t draw_calls = 0;
  uint64_t cells_drawn = 0;  // instances: a union of n primitives counts n times (paper §3.3.3)
  uint64_t tiles_drawn = 0;
  double list_ms = 0;      // making the tiles' lists
  double traverse_ms = 0;  // sorting front to back, and uploading the parameters
  double draw_ms = 0;
  double read_ms = 0;  // from the GPU into the Image
};

}  // namespace glrender
