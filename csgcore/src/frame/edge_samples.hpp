// Antialiasing: more rays for pixels that show an edge.
#pragma once

#include <vector>

#include "packets/hit_sink.hpp"
#include "tiles/tile_tracer.hpp"

namespace csgcore {

/// The edge pixels of an area, which differ visibly from a direct neighbour. The neighbour may lie
/// outside of the area.
class EdgeMap {
 public:
  EdgeMap(const Image& image, const PixelArea& area);
  /// Returns whether a pixel of the area is an edge pixel.
  bool is_edge(uint32_t x, uint32_t y) const {
    return edges_[size_t{y - area_.y} * area_.width + (x - area_.x)] != 0;
  }
  bool any_in(const Tile& tile) const;
  uint64_t count() const { return count_; }

 private:
  PixelArea area_;
  uint32_t block_columns_;
  std::vector<uint8_t> edges_;   // per pixel
  std::vector<uint8_t> blocks_;  // per block of kBlockSide_px a side: whether it has any
  uint64_t count_ = 0;
};

/// Returns the area enlarged by `by_px` pixels on each side, within the picture.
PixelArea grown(const PixelArea& area, uint32_t by_px, const View& view);

/// A copy of the colours of a picture's area, which can be restored.
class KeptColors {
 public:
  KeptColors(const Image& image, const PixelArea& area);
  /// Restores the colours outside of `replaced`, which must be a part of the area.
  void restore_around(const PixelArea& replaced, Image& image) const;

 private:
  PixelArea area_;
  std::vector<Rgb8> colors_;
};

/// Replaces the colours of edge pixels by the mean of `samples` rays (view.hpp).
class EdgeVisitor final : public TileVisitor {
 public:
  /// `sink` gives the shading and the background; only `rgb` of `image` is written.
  EdgeVisitor(const EdgeMap& edges, uint32_t samples, const FrameRays& frame, const ImageSink& sink,
              Image& image)
      : edges_(edges), samples_(samples), frame_(frame), sink_(sink), image_(image) {}

  bool wants(const Tile& tile) const override { return edges_.any_in(tile); }
  void visit_empty(const Tile& tile) override;
  void visit(const Tile& tile, TileRays& rays) override;

 private:
  class Batch;

  const EdgeMap& edges_;
  const uint32_t samples_;
  const FrameRays& frame_;
  const ImageSink& sink_;
  Image& image_;
};

}  // namespace csgcore
