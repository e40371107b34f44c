#include "packets/hit_sink.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace csgcore {
namespace {

Vec3 lane_of(const double (&v)[3][kPacketRays], uint32_t lane) {
  return {v[0][lane], v[1][lane], v[2][lane]};
}

Vec3 position_of(const FrameRays& frame, const RayPacket& rays, const PacketHits& hits,
                 uint32_t lane) {
  return frame.pivot + (lane_of(rays.origin, lane) + hits.t[lane] * lane_of(rays.direction, lane));
}

/// Calls visit(lane, index) for each pixel of the block, with its index in a picture of this width.
template <typename Visit>
void for_each_pixel(const PacketBlock& block, uint32_t width_px, Visit&& visit) {
  for (LaneMask left = block.lanes; left != 0; left &= left - 1) {
    const uint32_t lane = static_cast<uint32_t>(std::countr_zero(left));
    const size_t row = block.y + lane / kPacketWidth_px;
    visit(lane, row * width_px + block.x + lane % kPacketWidth_px);
  }
}

constexpr LaneMask kRowLanes = (LaneMask{1} << kPacketWidth_px) - 1;

/// Writes the pixels of a block to a picture of this width.
void copy_pixels(const PacketPixels& pixels, const PacketBlock& block, uint32_t width_px,
                 std::vector<Rgb8>& picture) {
  for (uint32_t y = 0; y < kPacketHeight_px; ++y) {
    const uint32_t first = y * kPacketWidth_px;
    const LaneMask row = block.lanes >> first & kRowLanes;
    if (row == 0) continue;
    const Rgb8* from = pixels.rgb + first;
    Rgb8* to = &picture[size_t{block.y + y} * width_px + block.x];
    if (row == kRowLanes) {
      std::copy_n(from, kPacketWidth_px, to);
      continue;
    }
    for (uint32_t x = 0; x < kPacketWidth_px; ++x) {
      if (row >> x & 1) to[x] = from[x];
    }
  }
}

/// Calls visit(index) for the first pixel of each row of the tile.
template <typename Visit>
void for_each_row(const Tile& tile, uint32_t width_px, Visit&& visit) {
  for (uint32_t y = tile.y; y < tile.y + tile.height; ++y) visit(size_t{y} * width_px + tile.x);
}

}  // namespace

MemorySink::MemorySink(const FrameRays& frame, Hits& hits) : frame_(frame), hits_(hits) {
  hits.width_px = frame.view.width_px;
  hits.height_px = frame.view.height_px;
  const size_t pixels = size_t{hits.width_px} * hits.height_px;
  hits.s.resize(pixels);
  hits.position.resize(pixels);
  hits.normal.resize(pixels);
  hits.primitive.resize(pixels);
}

void MemorySink::clear(const Tile& tile) {
  for_each_row(tile, hits_.width_px, [&](size_t first) {
    const auto at = [first](auto& channel) { return channel.begin() + static_cast<long>(first); };
    std::fill_n(at(hits_.s), tile.width, std::numeric_limits<double>::infinity());
    std::fill_n(at(hits_.position), tile.width, Vec3{0.0});
    std::fill_n(at(hits_.normal), tile.width, Vec3{0.0});
    std::fill_n(at(hits_.primitive), tile.width, Hits::kMiss);
  });
}

void MemorySink::store(const PacketBlock& block, const RayPacket& rays, const TraceList& list,
                       const PacketHits& hits) {
  for_each_pixel(block, hits_.width_px, [&](uint32_t lane, size_t pixel) {
    const bool hit = (hits.hits >> lane & 1) != 0;
    hits_.s[pixel] = hit ? frame_.base_s + hits.t[lane] : std::numeric_limits<double>::infinity();
    hits_.position[pixel] = hit ? position_of(frame_, rays, hits, lane) : Vec3{0.0};
    hits_.normal[pixel] = hit ? lane_of(hits.normal, lane) : Vec3{0.0};
    hits_.primitive[pixel] =
        hit ? list.list->primitive[hits.index[lane]] & kPrimitiveBits : Hits::kMiss;
  });
}

SparseSink::SparseSink(const FrameRays& frame, SparseHits& hits) : frame_(frame), hits_(hits) {
  const size_t pixels = size_t{frame.view.width_px} * frame.view.height_px;
  hits.s = std::make_unique_for_overwrite<double[]>(pixels);
  hits.position = std::make_unique_for_overwrite<Vec3[]>(pixels);
  hits.normal = std::make_unique_for_overwrite<Vec3[]>(pixels);
  hits.primitive.assign(pixels, Hits::kMiss);
}

void SparseSink::store(const PacketBlock& block, const RayPacket& rays, const TraceList& list,
                       const PacketHits& hits) {
  for_each_pixel(block, frame_.view.width_px, [&](uint32_t lane, size_t pixel) {
    if ((hits.hits >> lane & 1) == 0) return;
    hits_.s[pixel] = frame_.base_s + hits.t[lane];
    hits_.position[pixel] = position_of(frame_, rays, hits, lane);
    hits_.normal[pixel] = lane_of(hits.normal, lane);
    hits_.primitive[pixel] = list.list->primitive[hits.index[lane]] & kPrimitiveBits;
  });
}

ImageSink::ImageSink(const FrameRays& frame, const FrameSettings& settings, const Box& solid_bounds,
                     Image& image)
    : frame_(frame),
      measured_(settings.measured_channels),
      measures_all_(settings.measured_channels && !settings.depth_and_id_only),
      shade_(shade_settings(settings, frame.view, solid_bounds)),
      image_(image) {
  const uint32_t rows = settings.background_below ? frame.view.height_px : 1;
  for (uint32_t y = 0; y < rows; ++y) {
    background_.push_back(background_pixel(settings, y, rows));
  }
  image.width_px = frame.view.width_px;
  image.height_px = frame.view.height_px;
  const size_t pixels = size_t{image.width_px} * image.height_px;
  const size_t measured = measured_ ? pixels : 0;
  image.rgb.resize(pixels);
  image.z.resize(measured);
  image.normal.resize(measures_all_ ? pixels : 0);
  image.position.resize(measures_all_ ? pixels : 0);
  image.id.resize(measured);
}

void ImageSink::clear(const Tile& tile) {
  Rgb8* const top = &image_.rgb[size_t{tile.y} * image_.width_px + tile.x];
  std::fill_n(top, tile.width, background(tile.y));
  for (uint32_t y = 1; y < tile.height; ++y) {
    Rgb8* const row = top + size_t{y} * image_.width_px;
    if (background_.size() > 1) {
      std::fill_n(row, tile.width, background(tile.y + y));
    } else {  // many bytes at a time
      std::copy_n(top, tile.width, row);
    }
  }
  if (!measured_) return;
  for_each_row(tile, image_.width_px, [&](size_t first) {
    const auto at = [first](auto& channel) { return channel.begin() + static_cast<long>(first); };
    std::fill_n(at(image_.z), tile.width, std::numeric_limits<float>::infinity());
    std::fill_n(at(image_.id), tile.width, kNoPrimitive);
    if (!measures_all_) return;
    std::fill_n(at(image_.normal), tile.width, glm::vec3{0.0f});
    std::fill_n(at(image_.position), tile.width, glm::vec3{0.0f});
  });
}

void ImageSink::store(const PacketBlock& block, const RayPacket& rays, const TraceList& list,
                      const PacketHits& hits) {
  PacketColors colors;
  if (hits.hits != 0) shade_packet(shade_, frame_, rays, list, hits, colors);
  PacketPixels pixels;
  round_colors(colors, hits.hits, background_.front(), pixels);
  copy_pixels(pixels, block, image_.width_px, image_.rgb);
  if (background_.size() > 1) {
    for_each_pixel(block, image_.width_px, [&](uint32_t lane, size_t pixel) {
      if ((hits.hits >> lane & 1) != 0) return;
      image_.rgb[pixel] = background(static_cast<uint32_t>(pixel / image_.width_px));
    });
  }
  if (measured_) store_channels(block, rays, list, hits);
}

void ImageSink::store_channels(const PacketBlock& block, const RayPacket& rays,
                               const TraceList& list, const PacketHits& hits) {
  for_each_pixel(block, image_.width_px, [&](uint32_t lane, size_t pixel) {
    const bool hit = (hits.hits >> lane & 1) != 0;
    const uint32_t test = hit ? hits.index[lane] : 0;
    image_.z[pixel] = hit ? static_cast<float>(frame_.base_s + hits.t[lane])
                          : std::numeric_limits<float>::infinity();
    image_.id[pixel] =
        hit ? list.primitives[list.list->primitive[test] & kPrimitiveBits].id : kNoPrimitive;
    if (!measures_all_) return;
    image_.normal[pixel] = hit ? glm::vec3(lane_of(hits.normal, lane)) : glm::vec3{0.0f};
    image_.position[pixel] =
        hit ? glm::vec3(position_of(frame_, rays, hits, lane)) : glm::vec3{0.0f};
  });
}

}  // namespace csgcore
