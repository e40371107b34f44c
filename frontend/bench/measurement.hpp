// How long a scene takes to draw: first and steady frames of every renderer, and the times that
// the paper measures (§4.1). Pictures are held against each other before any time is taken.
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

/// When a cell is a leaf: at most K primitives, or smaller than the threshold. scadray's own rule.
struct Rule {
  uint32_t leaf_primitives = 8;
  double threshold_px = 0;
};
/// Paper §2.2, with §4.1's threshold.
constexpr Rule kPaperRule{2, 1};

struct Settings {
  std::vector<Rule> rules{Rule{}, kPaperRule};  // at least one; frames by cells take the first
  bool frames = true;                           // or the rules' times alone
  /// kAuto: the CPU, and OpenGL, in software too, where it can be had. kGl throws without.
  frontend::RendererKind renderer = frontend::RendererKind::kAuto;
  unsigned threads = 0;  // 0: as many as the machine has
  Repetitions repetitions;
};

/// Frames of one renderer by one technique. Times in ms.
struct FrameTimes {
  std::string renderer;   // "cpu", or "gl: " and GL_RENDERER
  std::string technique;  // "tiles" or "cells"
  /// From a scene in memory to its picture, nothing having been prepared; without `context`.
  Summary first;
  std::optional<Summary> subdivide;  // of `first`; by cells
  /// Before `first`, OpenGL's start; and of `first`, what a first frame takes longer to render than
  /// the same frame once more: shaders are compiled, or taken from where the driver keeps them.
  std::optional<Summary> context, shaders;
  Summary steady;             // of a turning camera
  uint64_t wrong_pixels = 0;  // against the CPU's picture by tiles
};

/// The paper's times by OpenGL, in ms.
struct GlTimes {
  std::string renderer;              // as FrameTimes has it
  Summary pass;                      // T_S
  Summary render;                    // T_R
  Summary render_while_subdividing;  // S_R
  uint64_t draw_calls = 0;
  uint64_t cells_drawn = 0;
  uint64_t wrong_pixels = 0;  // those that the threshold costs included
};

struct RuleTimes {
  Rule rule;
  frontend::RenderStats cells;        // of the subdivision
  Summary subdivide;                  // S
  std::optional<Summary> cpu_render;  // T_R by the CPU, which has no parameters to pass
  uint64_t cpu_wrong_pixels = 0;
  std::optional<GlTimes> gl;
};

struct Result {
  uint64_t primitives = 0;  // of the model, as the next two
  uint64_t pixels = 0;
  uint64_t hits = 0;  // pixels that show it
  std::vector<FrameTimes> frames;
  std::vector<RuleTimes> rules;
  std::vector<std::string> left_out;  // and why
  /// Pictures that are not what they have to be; their times are not there.
  std::vector<std::string> wrong;
};

using ScenePointer = std::shared_ptr<const csgcore::Scene>;
using Progress = std::function<void(const std::string& stage)>;

/// `views`, at least one: those of a turning camera. Of an empty model nothing is measured. Throws
/// frontend::Error.
Result measure(const ScenePointer& scene, std::span<const csgcore::View> views,
               const Settings& settings, const Progress& progress);

}  // namespace bench
