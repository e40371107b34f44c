// How wrong a picture is.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <vector>

#include "csgcore/tracer.hpp"

namespace measure {

/// Row-major from the top left corner.
struct Picture {
  uint32_t width_px = 0;
  uint32_t height_px = 0;
  std::vector<std::array<uint8_t, 3>> rgb;
};

/// Of a PNG. Throws std::runtime_error.
Picture read_picture(const std::filesystem::path& file);

/// Each pixel the mean of factor × factor pixels, whose picture's sides are multiples of it.
Picture averaged(const Picture& picture, uint32_t factor);

/// A channel that is further off than this is seen to be: what tests/plugins, too, lets a picture
/// be off by.
constexpr int kColourTolerance = 24;

/// Of a picture against the exact one; none where it cannot be had.
struct PictureErrors {
  std::optional<uint64_t> wrong;  // pixels whose centre shows another primitive, or hit for miss
  std::optional<uint64_t> silhouette;  // of these, those of a hit for a miss, or a miss for a hit
  /// Along the view axis, as a share of the model's size, of the pixels that are hits in both.
  std::optional<double> depth_worst, depth_mean;
  std::optional<uint64_t> colour_wrong;  // pixels with a channel off by more than kColourTolerance
  /// Root of the mean square over pixels and channels, in levels of 255, against the exact picture
  /// that was antialiased by kSupersampling² rays a pixel.
  std::optional<double> colour_rms;
};
constexpr uint32_t kSupersampling = 8;

/// Null where there is none.
void to_json(nlohmann::json& json, const PictureErrors& errors);

/// Fills the first four. Pictures of the same size; `seen` without depths (s) has no depth error.
/// `size` is the model's, > 0.
void compare_hits(const csgcore::Hits& seen, const csgcore::Hits& exact, double size,
                  PictureErrors& errors);

/// Fills the last two.
void compare_colours(const Picture& picture, const Picture& exact, const Picture& antialiased,
                     PictureErrors& errors);
/// `colour_wrong` alone. Throws std::runtime_error if the sizes differ.
uint64_t differing_pixels(const Picture& a, const Picture& b);

}  // namespace measure
