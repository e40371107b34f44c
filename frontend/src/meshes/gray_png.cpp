#include "meshes/gray_png.hpp"

#include <spng.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <string>

namespace frontend {
namespace {

/// The relative luminance of Rec. 709.
double luminance(double red, double green, double blue) {
  return 0.2126 * red + 0.7152 * green + 0.0722 * blue;
}

constexpr std::string_view kSignature = "\x89PNG\r\n\x1A\n";

/// Returns the picture without its ancillary chunks, which do not change it: a profile or a comment
/// of a kilobyte may unpack to a gigabyte.
std::string critical_chunks(std::string_view bytes) {
  constexpr size_t kLengthBytes = 4, kTypeBytes = 4, kChecksumBytes = 4;
  std::string result(kSignature);
  bytes.remove_prefix(kSignature.size());
  while (bytes.size() >= kLengthBytes + kTypeBytes) {
    uint64_t size = kLengthBytes + kTypeBytes + kChecksumBytes;
    uint64_t length = 0;
    for (size_t i = 0; i < kLengthBytes; ++i) {
      length = length << 8 | static_cast<unsigned char>(bytes[i]);
    }
    size = std::min<uint64_t>(size + length, bytes.size());
    const char first_of_type = bytes[kLengthBytes];
    if (first_of_type >= 'A' && first_of_type <= 'Z') result += bytes.substr(0, size);
    bytes.remove_prefix(size);
  }
  return result;
}

}  // namespace

bool is_png(std::string_view bytes) { return bytes.starts_with(kSignature); }

std::optional<GrayPicture> read_gray_png(std::string_view bytes, size_t most_pixels) {
  const std::unique_ptr<spng_ctx, void (*)(spng_ctx*)> context(spng_ctx_new(0), spng_ctx_free);
  const std::string chunks = critical_chunks(bytes);
  spng_ihdr header;
  if (!context || spng_set_png_buffer(context.get(), chunks.data(), chunks.size()) != 0 ||
      spng_get_ihdr(context.get(), &header) != 0) {
    return std::nullopt;
  }
  GrayPicture picture{header.width, header.height, {}};
  if (picture.rows > most_pixels / picture.columns) return std::nullopt;
  std::vector<unsigned char> rgb(3 * picture.columns * picture.rows);
  if (spng_decode_image(context.get(), rgb.data(), rgb.size(), SPNG_FMT_RGB8, 0) != 0) {
    return std::nullopt;
  }
  picture.values.reserve(rgb.size() / 3);
  for (size_t i = 0; i < rgb.size(); i += 3) {
    picture.values.push_back(luminance(rgb[i], rgb[i + 1], rgb[i + 2]));
  }
  return picture;
}

}  // namespace frontend
