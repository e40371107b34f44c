// Statistics of how a picture was drawn.
#pragma once

#include <cstdint>
#include <string>

#include "csgcore/scene_edit.hpp"
#include "csgcore/tracer.hpp"

namespace frontend {

/// The part of `--stats` that is about drawing. Times are in ms. Fields that a renderer does not
/// have stay 0.
struct RenderStats {
  std::string renderer;   // "cpu", or "gl: " and GL_RENDERER
  std::string reason;     // why kAuto chose it; empty where it had no choice
  std::string technique;  // "cells" or "tiles"
  uint64_t primitives = 0;

  /// The primitives and cells that are new since the last picture; all, if that could not be
  /// reused.
  csgcore::EditStats edit;

  // The subdivision; 0 with tiles.
  uint64_t cells = 0;  // inner cells and leaves
  uint64_t leaves = 0;
  uint64_t leaves_empty = 0;     // paper §2.2 case 1
  uint64_t leaves_union = 0;     // case 2
  uint64_t leaves_pair = 0;      // case 3
  uint64_t leaves_general = 0;   // up to K primitives
  uint64_t leaves_full = 0;      // more than K, and no subdivision separates them
  uint64_t leaves_dropped = 0;   // case 4
  uint64_t leaves_given_up = 0;  // more than K when the budget of cells was used up
  uint64_t leaf_primitives = 0;  // tests in all leaves
  uint64_t bytes = 0;

  // OpenGL.
  uint64_t draw_calls = 0;
  uint64_t cells_drawn = 0;

  /// The CPU counts all solids that it draws, translucent ones twice. OpenGL fills only `tiles`.
  csgcore::TraceStats trace;

  double prepare_ms = 0;    // canonical primitives, and lists for the trees
  double context_ms = 0;    // starting OpenGL
  double subdivide_ms = 0;  // the paper's S
  double traverse_ms = 0;   // T_S without the pass over the vertices: order and upload; with tiles,
                            // making and uploading their lists
  double render_ms = 0;     // drawing and reading back; with OpenGL also compiling shaders
  double read_ms = 0;       // the part of render_ms that reads back
  double measuring_ms = 0;  // drawing again to measure the times below
  double paper_ts_ms = 0;   // T_S: traverse and pass the parameters, without a pixel shader
  double paper_tr_ms = 0;   // T_R: traverse and render
  double paper_sr_ms = 0;   // S_R: render while subdividing
};

}  // namespace frontend
