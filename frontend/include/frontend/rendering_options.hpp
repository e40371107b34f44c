// What openscad may be asked for where scadray has no primitives for a part of a design.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>

namespace frontend {

/// How far openscad has come with a design's parts.
struct RenderingProgress {
  uint32_t line = 0;  // of the first part that is not finished, in the design's .csg
  std::size_t finished = 0;
  std::size_t parts = 0;
};

struct RenderingOptions {
  /// The most seconds that all parts of a design may take together. 0: openscad is not asked.
  double timeout_s = 0;
  /// Otherwise only what was rendered before is taken, and the rest is left for later
  /// (ImportedDesign::lines_to_render).
  bool waits = true;
  /// openscad gets the time that nothing else on the machine wants.
  bool is_in_background = false;
  /// Called about ten times a second while openscad runs; may be empty.
  std::function<void(const RenderingProgress&)> progress{};
};

}  // namespace frontend
