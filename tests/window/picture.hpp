// Pictures that tests compare: parts of the screen, and files.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace window_test {

struct Area {
  uint32_t x = 0, y = 0, width = 0, height = 0;
};

/// A picture, row-major from the top left corner.
struct Picture {
  uint32_t width = 0;
  uint32_t height = 0;
  std::vector<std::array<uint8_t, 3>> rgb;
  bool operator==(const Picture&) const = default;

  const std::array<uint8_t, 3>& at(uint32_t x, uint32_t y) const {
    return rgb[std::size_t{y} * width + x];
  }
};

/// Precondition: the area lies within the picture.
Picture part(const Picture& picture, const Area& area);

/// Returns the number of pixels that differ. In pictures of different sizes all do.
std::size_t different_pixels(const Picture& a, const Picture& b);

/// Reads a PNG. Throws std::runtime_error if it is none.
Picture read_png(const std::string& path);

/// Reads an xwd file of 24 bits, in which Xvfb keeps its screen. Throws std::runtime_error if it is
/// none.
Picture read_xwd(const std::string& path);

}  // namespace window_test
