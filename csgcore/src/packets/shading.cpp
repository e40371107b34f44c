// Compiled once per instruction set by Highway. Multiplications and additions are never fused:
// every instruction set gives the same bits.
#include "packets/shading.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "base/simd.hpp"
#include "csgcore/triangle_mesh.hpp"

#define HWY_DISABLED_TARGETS CSGCORE_DISABLED_TARGETS
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "packets/shading.cpp"
#include <hwy/foreach_target.h>  // includes this file again for every instruction set
#include <hwy/highway.h>

#include "rays/lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace csgcore {
namespace HWY_NAMESPACE {

/// Returns the shade of OpenSCAD's light: 0.2 + |n · light| (frontend/OPENSCAD.md, "Light and
/// colours").
HWY_INLINE WideV openscad_shade(const ShadeSettings& settings, const PacketHits& hits, int chunk) {
  const Wide d;
  constexpr double kAmbient = 0.2;
  const auto normal = load3(d, hits.normal, first_lane(chunk));
  return hn::Add(hn::Set(d, kAmbient), hn::Abs(dot(d, normal, broadcast(d, settings.light_world))));
}

/// Returns studio_shade() of points that nothing hides.
HWY_INLINE WideV unhindered_studio_shade(const ShadeSettings& settings, const RayPacket& rays,
                                         const PacketHits& hits, int chunk) {
  const Wide d;
  const auto normal = load3(d, hits.normal, first_lane(chunk));
  const WideV towards = dot(d, normal, load3(d, rays.direction, first_lane(chunk)));
  const WideV zero = hn::Zero(d);
  const auto on_viewers_side = [&](const Vec3& light) {
    const WideV cosine = dot(d, normal, broadcast(d, light));
    return hn::Max(zero, hn::IfThenElse(hn::Gt(towards, zero), hn::Neg(cosine), cosine));
  };
  const WideV fill = hn::Mul(hn::Set(d, kStudioFill), on_viewers_side(settings.studio.fill));
  const WideV key = hn::Mul(hn::Set(d, kStudioKey), on_viewers_side(settings.studio.key));
  return hn::Add(hn::Add(hn::Set(d, kStudioAmbient), fill), key);
}

HWY_INLINE void shade_phong(const ShadeSettings& settings, const FrameRays& frame,
                            const RayPacket& rays, LaneMask lanes, const Vec3& base,
                            const PacketHits& hits, PacketColors& colors) {
  for (; lanes != 0; lanes &= lanes - 1) {
    const int lane = std::countr_zero(lanes);
    const auto at = [lane](const double(&v)[3][kPacketRays]) {
      return Vec3{v[0][lane], v[1][lane], v[2][lane]};
    };
    const Vec3 direction = at(rays.direction);
    const Vec3 position = frame.pivot + (at(rays.origin) + hits.t[lane] * direction);
    const Vec3 color =
        phong_color(base / 255.0, position, at(hits.normal), direction, settings.phong);
    for (int channel = 0; channel < 3; ++channel)
      colors.rgb[channel][lane] = 255.0 * color[channel];
  }
}

/// Returns those of `lanes` that show the same test as the lowest of them.
HWY_INLINE LaneMask lanes_of_first(const PacketHits& hits, LaneMask lanes) {
  const uint32_t index = hits.index[std::countr_zero(lanes)];
  LaneMask same = 0;
  for (uint32_t lane = 0; lane < kPacketRays; ++lane) {
    same |= LaneMask{hits.index[lane] == index} << lane;
  }
  return same & lanes;
}

HWY_INLINE bool is_cut_face(const CanonicalPrimitive& primitive, const TraceList& list,
                            uint32_t index) {
  if (primitive.cut_faces == CutFaces::kByTree) return is_complement(list, index);
  return primitive.cut_faces == CutFaces::kAlways;
}

HWY_INLINE const CanonicalPrimitive& primitive_of(const TraceList& list, uint32_t index) {
  return list.primitives[list.list->primitive[index] & kPrimitiveBits];
}

/// Returns the mesh whose faces' colours the primitive shows; null if there is none.
HWY_INLINE const TriangleMesh* colored_mesh(const CanonicalPrimitive& primitive) {
  const TriangleMesh* const mesh = primitive.color ? nullptr : primitive.mesh();
  return mesh == nullptr || mesh->colors().empty() ? nullptr : mesh;
}

/// Returns the colour of the face of the mesh that a lane hits.
HWY_NOINLINE std::optional<Color> face_color(const TriangleMesh& mesh,
                                             const CanonicalPrimitive& primitive,
                                             const FrameRays& frame, const RayPacket& rays,
                                             const PacketHits& hits, int lane) {
  const auto at = [lane](const double(&v)[3][kPacketRays]) {
    return Vec3{v[0][lane], v[1][lane], v[2][lane]};
  };
  const Vec3 offset = frame.pivot - primitive.center;
  const Vec3 point = offset + (at(rays.origin) + hits.t[lane] * at(rays.direction));
  return mesh.color_at(primitive.world_to_canonical * point);
}

HWY_INLINE Vec3 base_color(const ShadeSettings& settings, const TraceList& list, uint32_t index,
                           bool eye_inside, const std::optional<Color>& color) {
  if (eye_inside && settings.from_within) return *settings.from_within;
  const CanonicalPrimitive& primitive = primitive_of(list, index);
  const Vec3& scheme =
      is_cut_face(primitive, list, index) && !eye_inside ? settings.back : settings.front;
  if (!color) return scheme;
  const Color& own = *color;
  return {own.r < 0 ? scheme.r : 255.0 * own.r, own.g < 0 ? scheme.g : 255.0 * own.g,
          own.b < 0 ? scheme.b : 255.0 * own.b};
}

void shade_packet(const ShadeSettings& settings, const FrameRays& frame, const RayPacket& rays,
                  const TraceList& list, const PacketHits& hits, PacketColors& colors) {
  const Wide d;
  PacketV colors_of[3];  // the faces' own colours, by channel
  for (PacketV& channel : colors_of) {
    for (int c = 0; c < kChunks; ++c) channel.chunk[c] = hn::Zero(d);
  }
  for (LaneMask lanes = hits.hits; lanes != 0;) {
    const int first = std::countr_zero(lanes);
    const bool eye_inside = (hits.eye_inside >> first & 1) != 0;
    const CanonicalPrimitive& primitive = primitive_of(list, hits.index[first]);
    const TriangleMesh* const mesh = colored_mesh(primitive);
    const LaneMask same = mesh != nullptr ? LaneMask{1} << first
                                          : lanes_of_first(hits, lanes) &
                                                (eye_inside ? hits.eye_inside : ~hits.eye_inside);
    const Vec3 base = base_color(
        settings, list, hits.index[first], eye_inside,
        mesh != nullptr ? face_color(*mesh, primitive, frame, rays, hits, first) : primitive.color);
    lanes &= ~same;
    if (settings.shading == Shading::kPhong) {
      shade_phong(settings, frame, rays, same, base, hits, colors);
      continue;
    }
    for (int c = 0; c < kChunks; ++c) {
      const WideM own = mask_of(same, c);
      for (int channel = 0; channel < 3; ++channel) {
        WideV& color = colors_of[channel].chunk[c];
        color = hn::IfThenElse(own, hn::Set(d, base[channel]), color);
      }
    }
  }
  if (settings.shading == Shading::kPhong) return;
  for (int c = 0; c < kChunks; ++c) {
    const WideV shade = settings.shading == Shading::kStudio
                            ? unhindered_studio_shade(settings, rays, hits, c)
                            : openscad_shade(settings, hits, c);
    for (int channel = 0; channel < 3; ++channel) {
      const WideV value = hn::Mul(colors_of[channel].chunk[c], shade);
      hn::Store(hn::Min(value, hn::Set(d, 255.0)), d, colors.rgb[channel] + first_lane(c));
    }
  }
}

void round_colors(const PacketColors& colors, LaneMask lanes, const Rgb8& others,
                  PacketPixels& pixels) {
  const Wide d;
  const hn::Rebind<int32_t, Wide> integers;
  alignas(64) int32_t rgb[kPacketRays];  // from the lowest byte on
  for (int c = 0; c < kChunks; ++c) {
    const WideM own = mask_of(lanes, c);
    const auto channel = [&](size_t i) {
      const WideV value = hn::Load(d, colors.rgb[i] + first_lane(c));
      const WideV chosen = hn::IfThenElse(own, value, hn::Set(d, others[i]));
      return hn::DemoteTo(integers, hn::Add(chosen, hn::Set(d, 0.5)));
    };
    const auto green_blue = hn::Or(hn::ShiftLeft<8>(channel(1)), hn::ShiftLeft<16>(channel(2)));
    hn::Store(hn::Or(channel(0), green_blue), integers, rgb + first_lane(c));
  }
  for (size_t lane = 0; lane < kPacketRays; ++lane) {
    const uint32_t bits = static_cast<uint32_t>(rgb[lane]);
    pixels.rgb[lane] = {static_cast<uint8_t>(bits), static_cast<uint8_t>(bits >> 8),
                        static_cast<uint8_t>(bits >> 16)};
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace csgcore
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace csgcore {

CSGCORE_SIMD_EXPORT(shade_packet);
CSGCORE_SIMD_EXPORT(round_colors);

void shade_packet(const ShadeSettings& settings, const FrameRays& frame, const RayPacket& rays,
                  const TraceList& list, const PacketHits& hits, PacketColors& colors) {
  CSGCORE_SIMD(shade_packet)(settings, frame, rays, list, hits, colors);
}

void round_colors(const PacketColors& colors, LaneMask lanes, const Rgb8& others,
                  PacketPixels& pixels) {
  CSGCORE_SIMD(round_colors)(colors, lanes, others, pixels);
}

ShadeSettings shade_settings(const FrameSettings& settings, const View& view,
                             const Box& solid_bounds) {
  ShadeSettings shade;
  shade.shading = settings.shading;
  // The direction of OpenSCAD's light is (−1, 1, 1)/√3 in eye space.
  shade.light_world = (-view.right + view.up - view.forward) / std::sqrt(3.0);
  shade.phong = phong_light(view, settings.scene_box.empty() ? solid_bounds : settings.scene_box);
  shade.studio = studio_light(view);
  shade.front = 255.0 * Vec3(settings.front);
  shade.back = 255.0 * Vec3(settings.back);
  if (settings.from_within) shade.from_within = 255.0 * Vec3(*settings.from_within);
  return shade;
}

}  // namespace csgcore
#endif  // HWY_ONCE
