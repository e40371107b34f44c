#include "picture.hpp"

#include <spng.h>

#include <algorithm>
#include <fstream>
#include <memory>
#include <sstream>
#include <stdexcept>

namespace window_test {
namespace {

std::string bytes_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error("cannot read " + path);
  std::ostringstream bytes;
  bytes << file.rdbuf();
  return bytes.str();
}

/// The places of the numbers in the head of an xwd file (X11/XWDFile.h): 32 bits each, the highest
/// byte first.
enum XwdHead : std::size_t {
  kXwdHeadSize = 0,
  kXwdWidth = 4,
  kXwdHeight = 5,
  kXwdLowestByteFirst = 7,  // 0: yes
  kXwdBitsPerPixel = 11,
  kXwdBytesPerLine = 12,
  kXwdColors = 19,
  kXwdNumbers = 25
};
constexpr std::size_t kColorSize = 12;

}  // namespace

Picture part(const Picture& picture, const Area& area) {
  Picture result{area.width, area.height, {}};
  for (uint32_t y = area.y; y < area.y + area.height; ++y) {
    const auto row = picture.rgb.begin() + std::size_t{y} * picture.width + area.x;
    result.rgb.insert(result.rgb.end(), row, row + area.width);
  }
  return result;
}

std::size_t different_pixels(const Picture& a, const Picture& b) {
  if (a.width != b.width || a.height != b.height) return std::max(a.rgb.size(), b.rgb.size());
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.rgb.size(); ++i) count += a.rgb[i] != b.rgb[i];
  return count;
}

Picture read_png(const std::string& path) {
  const std::string bytes = bytes_of(path);
  const std::unique_ptr<spng_ctx, void (*)(spng_ctx*)> context(spng_ctx_new(0), spng_ctx_free);
  spng_ihdr header{};
  if (spng_set_png_buffer(context.get(), bytes.data(), bytes.size()) != 0 ||
      spng_get_ihdr(context.get(), &header) != 0) {
    throw std::runtime_error(path + " is no PNG");
  }
  Picture picture{header.width, header.height, {}};
  picture.rgb.resize(std::size_t{header.width} * header.height);
  if (spng_decode_image(context.get(), picture.rgb.data(), picture.rgb.size() * 3, SPNG_FMT_RGB8,
                        0) != 0) {
    throw std::runtime_error(path + " is a broken PNG");
  }
  return picture;
}

Picture read_xwd(const std::string& path) {
  const std::string bytes = bytes_of(path);
  const auto byte = [&](std::size_t at) { return uint32_t{static_cast<uint8_t>(bytes[at])}; };
  const auto number = [&](std::size_t index) {
    const std::size_t at = 4 * index;
    return byte(at) << 24 | byte(at + 1) << 16 | byte(at + 2) << 8 | byte(at + 3);
  };
  if (bytes.size() < 4 * kXwdNumbers || number(kXwdBitsPerPixel) != 32 ||
      number(kXwdLowestByteFirst) != 0) {
    throw std::runtime_error(path + " is no screen of 24 bits");
  }
  const std::size_t start = number(kXwdHeadSize) + number(kXwdColors) * kColorSize;
  const std::size_t line = number(kXwdBytesPerLine);
  Picture picture{number(kXwdWidth), number(kXwdHeight), {}};
  if (bytes.size() < start + line * picture.height) throw std::runtime_error(path + " is short");
  picture.rgb.reserve(std::size_t{picture.width} * picture.height);
  for (uint32_t y = 0; y < picture.height; ++y) {
    for (std::size_t at = start + y * line; at < start + y * line + picture.width * 4; at += 4) {
      picture.rgb.push_back({static_cast<uint8_t>(bytes[at + 2]),
                             static_cast<uint8_t>(bytes[at + 1]), static_cast<uint8_t>(bytes[at])});
    }
  }
  return picture;
}

}  // namespace window_test
