// Measures how long a scene takes to draw: first and steady frames of every renderer, and the times
// that the paper measures (§4.1). Pictures are compared with each other before any time is taken.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "csgcore/scene.hpp"
#include "csgcore/view.hpp"
#include "frontend/render.hpp"
#include "samples.hpp"

namespace bench {

/// The rule that makes a cell a leaf: it has at most K primitives, or is smaller than the
/// threshold. The default is scadray's own.
struct Rule {
  uint32_t leaf_primitives = 8;
  double threshold_px = 0;
};
/// The paper's rule (§2.2), with the threshold of §4.1.
constexpr Rule kPaperRule{2, 1};

struct Settings {
  std::vector<Rule> rules{Rule{}, kPaperRule};  // at least one; frames by cells use the first
  bool frames = true;                           // false: measure the rules' times alone
  /// kAuto: the CPU, and OpenGL if there is any, in software too. kGl: measure() throws without
  /// OpenGL.
  frontend::RendererKind renderer = frontend::RendererKind::kAuto;
  unsigned threads = 0;  // 0: as many as the machine has
  Repetitions repetitions;
};

/// Frames of one renderer by one technique. Times in ms.
struct FrameTimes {
  std::string renderer;   // "cpu", or "gl: " and GL_RENDERER
  std::string technique;  // "tiles" or "cells"
  /// The time from a scene in memory, with nothing prepared, to its picture; without `context`.
  Summary first;
  std::optional<Summary> subdivide;  // the part of `first` that subdivides; by cells only
  /// `context`: starting OpenGL, before `first`. `shaders`: how much longer a first frame takes to
  /// render than the same frame drawn again, since shaders are compiled or loaded from the driver's
  /// cache.
  std::optional<Summary> context, shaders;
  Summary steady;             // a frame of a turning camera
  uint64_t wrong_pixels = 0;  // compared with the CPU's picture by tiles
};

/// The paper's times by OpenGL, in ms.
struct GlTimes {
  std::string renderer;              // as in FrameTimes
  Summary pass;                      // T_S
  Summary render;                    // T_R
  Summary render_while_subdividing;  // S_R
  uint64_t draw_calls = 0;
  uint64_t cells_drawn = 0;
  uint64_t wrong_pixels = 0;  // including those that the threshold causes
};

struct RuleTimes {
  Rule rule;
  frontend::RenderStats cells;        // statistics of the subdivision
  Summary subdivide;                  // S
  std::optional<Summary> cpu_render;  // T_R by the CPU, which has no parameters to pass
  uint64_t cpu_wrong_pixels = 0;
  std::optional<GlTimes> gl;
};

struct Result {
  uint64_t primitives = 0;  // of the model, as are the next two
  uint64_t pixels = 0;
  uint64_t hits = 0;  // pixels that show the model
  std::vector<FrameTimes> frames;
  std::vector<RuleTimes> rules;
  std::vector<std::string> left_out;  // what was not measured, and why
  /// Pictures that are wrong; their times are left out.
  std::vector<std::string> wrong;
};

using ScenePointer = std::shared_ptr<const csgcore::Scene>;
using Progress = std::function<void(const std::string& stage)>;

/// `views`, at least one, are those of a turning camera. An empty model is not measured. Throws
/// frontend::Error.
Result measure(const ScenePointer& scene, std::span<const csgcore::View> views,
               const Settings& settings, const Progress& progress);

}  // namespace bench
