// Scene and camera → Image: the seam between the command line and the renderers.
#pragma once

#include <cstdint>
#include <functional>
#include <stop_token>
#include <string>

#include "csgcore/edit_stats.hpp"
#include "csgcore/frame_settings.hpp"
#include "csgcore/image.hpp"
#include "csgcore/scene.hpp"
#include "csgcore/tracer.hpp"
#include "csgcore/view.hpp"

namespace frontend {

using csgcore::Shading;
/// What a picture shows (`--show`): the shaded surface, the leaf cells (paper, figure 5b), or a
/// measured channel as grey values or colours.
enum class Show : uint8_t { kSurface, kCells, kDepth, kNormals, kId };

/// What draws (`--renderer`). kAuto: OpenGL where there is a GPU, else the CPU.
enum class RendererKind : uint8_t { kAuto, kGl, kCpu };
/// How a ray finds what it may meet (`--technique`): the leaf cells of a kd-tree, or lists for
/// tiles of the screen. kAuto: tiles, the quicker for both renderers.
enum class Technique : uint8_t { kAuto, kCells, kTiles };

/// The most --samples: an edge then has 65 steps between its two colours, and more no eye tells.
constexpr uint32_t kMaxSamples = 64;

/// 8-bit colours of a scheme (frontend/OPENSCAD.md, "Light and colours").
struct Rgb {
  uint8_t r, g, b;
  bool operator==(const Rgb&) const = default;
};
struct ColorScheme {
  const char* name;
  Rgb background, front, back, axes, crosshair;
};

/// Every setting of a picture that is not the camera's. The defaults are the command's.
struct RenderSettings {
  ColorScheme scheme{"Cornfield",        {0xff, 0xff, 0xe5}, {0xf9, 0xd7, 0x2c},
                     {0x9d, 0xcb, 0x51}, {0x00, 0x00, 0x00}, {0x80, 0x00, 0x00}};
  Shading shading = Shading::kOpenScad;
  Show show = Show::kSurface;
  RendererKind renderer = RendererKind::kAuto;
  Technique technique = Technique::kAuto;
  uint32_t samples = 1;            // --samples: rays per pixel at edges, 1…kMaxSamples
  uint32_t leaf_primitives = 8;    // --leaf-primitives: K ≥ 1
  double threshold_px = 0;         // --threshold ≥ 0; 0: no cell is dropped
  unsigned threads = 0;            // 0: as many as the machine has
  bool measured_channels = false;  // fill Image's z, normal, position and id too
  /// Fill also those RenderStats that cost something: T_S, T_R and S_R, for which OpenGL draws
  /// again, and why primitives were skipped.
  bool all_stats = false;
  /// Where it asks for it, the CPU's pictures end early, whatever they show by then.
  std::stop_token stop;
  /// Called with what is done in [0, 1] while long work goes on; may be empty.
  std::function<void(const char* stage, double fraction)> progress;
};

/// Whether the same picture comes of both.
bool draw_the_same(const RenderSettings& a, const RenderSettings& b);

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

/// Draws the scene, without a display. Where kAuto takes OpenGL and that fails, or turns out to run
/// in software, the CPU draws. Throws Error if kGl is asked for and no OpenGL can be had.
csgcore::Image render(const csgcore::Scene& scene, const csgcore::View& view,
                      const RenderSettings& settings, RenderStats& stats);

}  // namespace frontend
