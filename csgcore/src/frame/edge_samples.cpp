#include "frame/edge_samples.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "csgcore/view.hpp"

namespace csgcore {
namespace {

constexpr uint32_t kBlockSide_px = 8;

/// A difference in any channel, of 255, up to which neighbours show no visible edge but smooth
/// shading.
constexpr int kEdgeContrast = 10;

bool differs(const std::array<uint8_t, 3>& a, const std::array<uint8_t, 3>& b) {
  return std::abs(a[0] - b[0]) > kEdgeContrast || std::abs(a[1] - b[1]) > kEdgeContrast ||
         std::abs(a[2] - b[2]) > kEdgeContrast;
}

}  // namespace

EdgeMap::EdgeMap(const Image& image, const PixelArea& area)
    : area_(area), block_columns_((area.width + kBlockSide_px - 1) / kBlockSide_px) {
  const uint32_t block_rows = (area.height + kBlockSide_px - 1) / kBlockSide_px;
  edges_.assign(size_t{area.width} * area.height, 0);
  blocks_.assign(size_t{block_columns_} * block_rows, 0);
  const auto mark = [&](uint32_t x, uint32_t y) {
    x -= area_.x;
    y -= area_.y;
    if (x >= area_.width || y >= area_.height)
      return;  // wrapped around if it lies above or to the
               // left
    uint8_t& edge = edges_[size_t{y} * area_.width + x];
    count_ += edge == 0;
    edge = 1;
    blocks_[size_t{y / kBlockSide_px} * block_columns_ + x / kBlockSide_px] = 1;
  };
  const uint32_t right = area.x + area.width, bottom = area.y + area.height;
  for (uint32_t y = area.y > 0 ? area.y - 1 : 0; y < bottom; ++y) {
    const auto* row = image.rgb.data() + size_t{y} * image.width_px;
    for (uint32_t x = area.x > 0 ? area.x - 1 : 0; x < right; ++x) {
      if (x + 1 < image.width_px && differs(row[x], row[x + 1])) {
        mark(x, y);
        mark(x + 1, y);
      }
      if (y + 1 < image.height_px && differs(row[x], row[x + image.width_px])) {
        mark(x, y);
        mark(x, y + 1);
      }
    }
  }
}

bool EdgeMap::any_in(const Tile& tile) const {
  const uint32_t left = tile.x - area_.x, top = tile.y - area_.y;
  const uint32_t last_row = (top + tile.height - 1) / kBlockSide_px;
  const uint32_t first = left / kBlockSide_px;
  const uint32_t last = (left + tile.width - 1) / kBlockSide_px;
  for (uint32_t row = top / kBlockSide_px; row <= last_row; ++row) {
    const uint8_t* blocks = blocks_.data() + size_t{row} * block_columns_;
    if (std::find(blocks + first, blocks + last + 1, uint8_t{1}) != blocks + last + 1) return true;
  }
  return false;
}

PixelArea grown(const PixelArea& area, uint32_t by_px, const View& view) {
  const uint32_t left = area.x - std::min(area.x, by_px);
  const uint32_t top = area.y - std::min(area.y, by_px);
  const uint32_t right = std::min(view.width_px, area.x + area.width + by_px);
  const uint32_t bottom = std::min(view.height_px, area.y + area.height + by_px);
  return {left, top, right - left, bottom - top};
}

KeptColors::KeptColors(const Image& image, const PixelArea& area) : area_(area) {
  colors_.reserve(size_t{area.width} * area.height);
  for (uint32_t y = area.y; y < area.y + area.height; ++y) {
    const Rgb8* const row = &image.rgb[size_t{y} * image.width_px + area.x];
    colors_.insert(colors_.end(), row, row + area.width);
  }
}

void KeptColors::restore_around(const PixelArea& replaced, Image& image) const {
  const uint32_t before = replaced.x - area_.x;
  const uint32_t after = area_.width - before - replaced.width;
  for (uint32_t y = area_.y; y < area_.y + area_.height; ++y) {
    const Rgb8* const from = &colors_[size_t{y - area_.y} * area_.width];
    Rgb8* const to = &image.rgb[size_t{y} * image.width_px + area_.x];
    if (y < replaced.y || y >= replaced.y + replaced.height) {
      std::copy_n(from, area_.width, to);
      continue;
    }
    std::copy_n(from, before, to);
    std::copy_n(from + area_.width - after, after, to + area_.width - after);
  }
}

/// Fills packets with the samples of pixels one after the other; a pixel's samples may be in two
/// packets.
class EdgeVisitor::Batch {
 public:
  Batch(EdgeVisitor& owner, TileRays& rays) : owner_(owner), rays_(rays) {}

  void add_pixel(uint32_t x, uint32_t y) {
    for (uint32_t sample = 0; sample < owner_.samples_; ++sample) {
      const auto offset = sample_offset(sample, owner_.samples_);
      laterals_.u[size_] = owner_.frame_.u(x + offset[0]);
      laterals_.v[size_] = owner_.frame_.v(y + offset[1]);
      pixel_of_[size_] = size_t{y} * owner_.image_.width_px + x;
      if (++size_ == kPacketRays) flush();
    }
  }

  /// Traces the samples that are in the packet.
  void flush() {
    if (size_ == 0) return;
    for (uint32_t lane = size_; lane < kPacketRays; ++lane) {
      laterals_.u[lane] = laterals_.u[0];
      laterals_.v[lane] = laterals_.v[0];
    }
    RayPacket packet;
    make_rays(owner_.frame_, laterals_, packet);
    PacketHits hits;
    const TraceList& list = rays_.trace(packet, kAllLanes >> (kPacketRays - size_), nullptr, hits);
    PacketColors colors;
    shade_packet(owner_.sink_.shade(), owner_.frame_, packet, list, hits, colors);
    for (uint32_t lane = 0; lane < size_; ++lane) add_sample(hits, colors, lane);
    size_ = 0;
  }

 private:
  void add_sample(const PacketHits& hits, const PacketColors& colors, uint32_t lane) {
    const bool hit = (hits.hits >> lane & 1) != 0;
    const size_t y = pixel_of_[lane] / owner_.image_.width_px;
    const Rgb8 background = owner_.sink_.background(static_cast<uint32_t>(y));
    for (size_t channel = 0; channel < 3; ++channel) {
      sum_[channel] += hit ? colors.rgb[channel][lane] : background[channel];
    }
    if (++summed_ < owner_.samples_) return;
    for (size_t channel = 0; channel < 3; ++channel) {
      owner_.image_.rgb[pixel_of_[lane]][channel] =
          static_cast<uint8_t>(std::floor(sum_[channel] / owner_.samples_ + 0.5));
      sum_[channel] = 0;
    }
    summed_ = 0;
  }

  EdgeVisitor& owner_;
  TileRays& rays_;
  PacketLaterals laterals_;
  size_t pixel_of_[kPacketRays];
  uint32_t size_ = 0;
  double sum_[3] = {};  // of the samples of the current pixel
  uint32_t summed_ = 0;
};

void EdgeVisitor::visit_empty(const Tile& tile) {
  for (uint32_t y = tile.y; y < tile.y + tile.height; ++y) {
    for (uint32_t x = tile.x; x < tile.x + tile.width; ++x) {
      if (edges_.is_edge(x, y)) {
        image_.rgb[size_t{y} * image_.width_px + x] = sink_.background(y);
      }
    }
  }
}

void EdgeVisitor::visit(const Tile& tile, TileRays& rays) {
  Batch batch(*this, rays);
  for (uint32_t y = tile.y; y < tile.y + tile.height; ++y) {
    for (uint32_t x = tile.x; x < tile.x + tile.width; ++x) {
      if (edges_.is_edge(x, y)) batch.add_pixel(x, y);
    }
  }
  batch.flush();
}

}  // namespace csgcore
