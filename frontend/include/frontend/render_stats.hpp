// What is known of a picture's drawing once it is drawn.
#pragma once

#include <cstdint>
#include <string>

#include "csgcore/edit_stats.hpp"
#include "csgcore/tracer.hpp"

namespace frontend {

/// What `--stats` reports of the drawing. Times in ms. What a renderer does not have stays 0.
struct RenderStats {
  std::string renderer;   // "cpu", or "gl: " and GL_RENDERER
  std::string reason;     // why kAuto chose it; empty where it had no choice
  std::string technique;  // "cells" or "tiles"
  uint64_t primitives = 0;

  /// What is new against the last picture; all of it where that could not be kept.
  csgcore::EditStats edit;

  // The subdivision; nothing of it with tiles.
  uint64_t cells = 0;  // inner ones and leaves
  uint64_t leaves = 0;
  uint64_t leaves_empty = 0;     // paper §2.2 case 1
  uint64_t leaves_union = 0;     // case 2
  uint64_t leaves_pair = 0;      // case 3
  uint64_t leaves_general = 0;   // up to K primitives
  uint64_t leaves_full = 0;      // more than K, where no subdivision separates them
  uint64_t leaves_dropped = 0;   // case 4
  uint64_t leaves_given_up = 0;  // more than K, where the budget of cells was used up
  uint64_t leaf_primitives = 0;  // literals in all leaves
  uint64_t bytes = 0;

  // OpenGL.
  uint64_t draw_calls = 0;
  uint64_t cells_drawn = 0;

  /// The CPU: of all solids that were drawn, translucent ones twice; but `primitives`,
  /// `intersected` and `skipped` are the model's. OpenGL: `tiles` alone.
  csgcore::TraceStats trace;

  double prepare_ms = 0;    // canonical primitives, and lists for the trees
  double context_ms = 0;    // starting OpenGL
  double subdivide_ms = 0;  // the paper's S
  double traverse_ms = 0;   // T_S without the pass over the vertices: order and upload; of tiles,
                            // their lists and upload
  double render_ms = 0;     // draw, and read back from OpenGL, which compiles its shaders, too
  double read_ms = 0;       // of render_ms, reading back
  double measuring_ms = 0;  // drawing again, for the times below
  double paper_ts_ms = 0;   // T_S: traverse and pass the parameters, no pixel shader
  double paper_tr_ms = 0;   // T_R: traverse and render
  double paper_sr_ms = 0;   // S_R: render while subdividing
};

}  // namespace frontend
