// The shading of a packet's hits.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "csgcore/frame_settings.hpp"
#include "csgcore/phong.hpp"
#include "csgcore/studio_light.hpp"
#include "packets/trace_list.hpp"
#include "rays/frame_rays.hpp"

namespace csgcore {

/// The settings of shading.
struct ShadeSettings {
  Shading shading = Shading::kOpenScad;
  Vec3 light_world{0.0};  // kOpenScad: shade = 0.2 + |n · light_world|
  PhongLight phong;
  StudioLight studio;
  glm::dvec3 front{1.0}, back{1.0};  // 0…255
  std::optional<glm::dvec3> from_within;
};
ShadeSettings shade_settings(const FrameSettings& settings, const View& view,
                             const Box& solid_bounds);

/// Colours with each channel in [0, 255], not rounded.
struct alignas(64) PacketColors {
  double rgb[3][kPacketRays];
};
void shade_packet(const ShadeSettings& settings, const FrameRays& frame, const RayPacket& rays,
                  const TraceList& list, const PacketHits& hits, PacketColors& colors);

using Rgb8 = std::array<uint8_t, 3>;
struct PacketPixels {
  Rgb8 rgb[kPacketRays];
};
/// Rounds the colours of `lanes`, and gives the colour `others` to all other lanes.
void round_colors(const PacketColors& colors, LaneMask lanes, const Rgb8& others,
                  PacketPixels& pixels);

}  // namespace csgcore
