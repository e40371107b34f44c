// What a frame is to show and how it is drawn, and what is known of it afterwards.
#pragma once

#include <cstdint>

#include "csgcore/frame_settings.hpp"

namespace glrender {

using csgcore::Shading;

enum class Subject : uint8_t {
  kSurface,
  kCells,  // the leaf cells with a surface in them, as boxes (paper, figure 5b)
};

/// How a ray finds what it may meet.
enum class Technique : uint8_t {
  kCells,  // the leaf cells of the subdivision that was loaded (paper §3)
  kTiles,  // lists for tiles of the screen, which the CPU makes for each frame
};

struct FrameSettings : csgcore::FrameSettings {
  glm::vec3 edge{0.0f};  // of the cells' edges
  Subject subject = Subject::kSurface;
  Technique technique = Technique::kCells;  // kTiles: of a surface only
  unsigned threads = 0;                     // that make the tiles' lists; 0: as many as there are
  /// Rays per pixel, ≥ 1, displaced by csgcore::sample_offset; rgb is their average. The measured
  /// channels are those of the pixel's centre.
  uint32_t samples = 1;
};

/// Of one frame, all samples together. Times in ms; GL is finished before a clock is read.
struct FrameStats {
  uint64_t draw_calls = 0;
  uint64_t cells_drawn = 0;  // instances: a union of n counts n times (paper §3.3.3)
  uint64_t tiles_drawn = 0;
  double list_ms = 0;      // the tiles' lists
  double traverse_ms = 0;  // front-to-back order, and the parameters' way to the GPU
  double draw_ms = 0;
  double read_ms = 0;  // from the GPU into the Image
};

}  // namespace glrender
