// Measures how wrong a picture is.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <vector>

#include "csgcore/tracer.hpp"

namespace measure {

/// A picture, row-major from the top left corner.
struct Picture {
  uint32_t width_px = 0;
  uint32_t height_px = 0;
  std::vector<std::array<uint8_t, 3>> rgb;
};

/// Reads a PNG. Throws std::runtime_error.
Picture read_picture(const std::filesystem::path& file);

/// Returns the picture with each pixel the mean of factor × factor pixels. Precondition: its sides
/// are multiples of `factor`.
Picture averaged(const Picture& picture, uint32_t factor);

/// A channel that is further off than this is visibly wrong. tests/plugins uses the same tolerance.
constexpr int kColourTolerance = 24;

/// The errors of a picture compared with the exact one; nothing if one cannot be determined.
struct PictureErrors {
  std::optional<uint64_t> wrong;  // pixels whose centre shows another primitive, or a hit for a
                                  // miss
  std::optional<uint64_t> silhouette;  // those of them with a hit for a miss, or a miss for a hit
  /// Along the view axis, as a share of the model's size, over the pixels that are hits in both.
  std::optional<double> depth_worst, depth_mean;
  std::optional<uint64_t> colour_wrong;  // pixels with a channel off by more than kColourTolerance
  /// Root mean square over pixels and channels, in levels of 255, against the exact picture
  /// antialiased by kSupersampling² rays a pixel.
  std::optional<double> colour_rms;
};
constexpr uint32_t kSupersampling = 8;

/// Writes null for errors that are not known.
void to_json(nlohmann::json& json, const PictureErrors& errors);

/// Fills the first four errors. Both pictures must have the same size; `seen` without depths (s)
/// has no depth error. `size` is the model's, > 0.
void compare_hits(const csgcore::Hits& seen, const csgcore::Hits& exact, double size,
                  PictureErrors& errors);

/// Fills the last two errors.
void compare_colours(const Picture& picture, const Picture& exact, const Picture& antialiased,
                     PictureErrors& errors);
/// Returns `colour_wrong` alone. Throws std::runtime_error if the sizes differ.
uint64_t differing_pixels(const Picture& a, const Picture& b);

}  // namespace measure
