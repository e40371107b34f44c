// Draws frames of a triangle mesh by Embree: primary rays and OpenSCAD's shading.
#pragma once

#include <memory>
#include <span>

#include "csgcore/frame_settings.hpp"
#include "csgcore/image.hpp"
#include "csgcore/view.hpp"
#include "cut_mesh.hpp"

namespace measure {

class EmbreeFrame {
 public:
  /// Builds the tree for the fastest rays, with `threads` threads. `is_cut`, by primitive: its
  /// faces have the back colour.
  EmbreeFrame(std::span<const CutTriangle> triangles, std::span<const char> is_cut,
              unsigned threads);
  ~EmbreeFrame();

  /// The time that building the tree took.
  double build_ms() const;

  /// Draws perspective views whose sides are multiples of 16 pixels: `rgb`, and `z` if measured
  /// channels are wanted.
  void draw(const csgcore::View& view, const csgcore::FrameSettings& settings,
            csgcore::Image& image) const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace measure
