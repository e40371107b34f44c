#include <algorithm>
#include <cmath>
#include <limits>

#include "frontend/picture_file.hpp"

namespace frontend {
namespace {

using Pixel = std::array<uint8_t, 3>;

constexpr double kNearGrey = 255;
constexpr double kFarGrey = 48;  // dark, but not the black of a Starnight background

bool is_hit(float z) { return std::isfinite(z); }

uint8_t to_byte(double value) {
  return static_cast<uint8_t>(std::lround(std::clamp(value, 0.0, 255.0)));
}

void show_depth(csgcore::Image& image) {
  float nearest = std::numeric_limits<float>::infinity();
  float farthest = -nearest;
  for (const float z : image.z) {
    if (!is_hit(z)) continue;
    nearest = std::min(nearest, z);
    farthest = std::max(farthest, z);
  }
  const double range = static_cast<double>(farthest) - nearest;
  for (std::size_t i = 0; i < image.rgb.size(); ++i) {
    if (!is_hit(image.z[i])) continue;
    const double depth = range > 0 ? (static_cast<double>(image.z[i]) - nearest) / range : 0;
    image.rgb[i].fill(to_byte(kNearGrey + depth * (kFarGrey - kNearGrey)));
  }
}

void show_normals(csgcore::Image& image) {
  for (std::size_t i = 0; i < image.rgb.size(); ++i) {
    if (!is_hit(image.z[i])) continue;
    for (int axis = 0; axis < 3; ++axis) {
      image.rgb[i][static_cast<std::size_t>(axis)] = to_byte((image.normal[i][axis] + 1) * 127.5);
    }
  }
}

/// Multiplication by an odd number permutes the numbers below 2^24, so that no two ids below that
/// share a colour. The factor is 2^24 over the golden ratio, made odd, which sends neighbours far
/// apart.
Pixel color_of_id(uint32_t id) {
  constexpr uint32_t kGolden24 = 0x9E3779;
  const uint32_t mixed = (id + 1) * kGolden24;
  return {static_cast<uint8_t>(mixed >> 16), static_cast<uint8_t>(mixed >> 8),
          static_cast<uint8_t>(mixed)};
}

void show_ids(csgcore::Image& image) {
  for (std::size_t i = 0; i < image.rgb.size(); ++i) {
    if (is_hit(image.z[i])) image.rgb[i] = color_of_id(image.id[i]);
  }
}

}  // namespace

void show_channel(csgcore::Image& image, Show show, Rgb background) {
  if (show == Show::kSurface || show == Show::kCells) return;
  std::fill(image.rgb.begin(), image.rgb.end(), Pixel{background.r, background.g, background.b});
  if (show == Show::kDepth) show_depth(image);
  if (show == Show::kNormals) show_normals(image);
  if (show == Show::kId) show_ids(image);
}

}  // namespace frontend
