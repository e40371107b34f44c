// Receivers of traced packets, which store them as pictures or as hits in memory.
#pragma once

#include <memory>
#include <vector>

#include "csgcore/image.hpp"
#include "packets/packet.hpp"
#include "packets/shading.hpp"
#include "rays/packet_blocks.hpp"

namespace csgcore {

/// Receives the hits of packets. All threads call it, but each pixel is passed once.
class HitSink {
 public:
  virtual ~HitSink() = default;
  /// Stores misses in all pixels of the tile.
  virtual void clear(const Tile& tile) = 0;
  /// Stores the block's pixels. Lanes without a hit are misses.
  virtual void store(const PacketBlock& block, const RayPacket& rays, const TraceList& list,
                     const PacketHits& hits) = 0;
};

/// Stores hits in a Hits object.
class MemorySink final : public HitSink {
 public:
  MemorySink(const FrameRays& frame, Hits& hits);
  void clear(const Tile& tile) override;
  void store(const PacketBlock& block, const RayPacket& rays, const TraceList& list,
             const PacketHits& hits) override;

 private:
  const FrameRays& frame_;
  Hits& hits_;
};

/// What each pixel's centre sees, as Hits has it, but undefined at a miss except for `primitive`.
/// Memory of pixels that show nothing is never touched, which is most of the cost of small solids.
struct SparseHits {
  std::unique_ptr<double[]> s;
  std::unique_ptr<Vec3[]> position, normal;
  std::vector<uint32_t> primitive;
};

/// Stores hits in a SparseHits object.
class SparseSink final : public HitSink {
 public:
  SparseSink(const FrameRays& frame, SparseHits& hits);
  void clear(const Tile&) override {}
  void store(const PacketBlock& block, const RayPacket& rays, const TraceList& list,
             const PacketHits& hits) override;

 private:
  const FrameRays& frame_;
  SparseHits& hits_;
};

/// Shades hits into an Image.
class ImageSink final : public HitSink {
 public:
  ImageSink(const FrameRays& frame, const FrameSettings& settings, const Box& solid_bounds,
            Image& image);
  void clear(const Tile& tile) override;
  void store(const PacketBlock& block, const RayPacket& rays, const TraceList& list,
             const PacketHits& hits) override;
  const ShadeSettings& shade() const { return shade_; }
  /// The colour of a row of the picture where nothing is hit.
  Rgb8 background(uint32_t y) const { return background_[background_.size() > 1 ? y : 0]; }

 private:
  void store_channels(const PacketBlock& block, const RayPacket& rays, const TraceList& list,
                      const PacketHits& hits);

  const FrameRays& frame_;
  bool measured_, measures_all_;
  ShadeSettings shade_;
  std::vector<Rgb8> background_;  // of each row, or of all
  Image& image_;
};

}  // namespace csgcore
