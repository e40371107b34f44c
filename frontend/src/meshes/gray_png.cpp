#include "meshes/gray_png.hpp"

#include <spng.h>

#include <memory>

namespace frontend {
namespace {

/// The relative luminance of Rec. 709.
double luminance(double red, double green, double blue) {
  return 0.2126 * red + 0.7152 * green + 0.0722 * blue;
}

}  // namespace

bool is_png(std::string_view bytes) { return bytes.starts_with("\x89PNG\r\n\x1A\n"); }

std::optional<GrayPicture> read_gray_png(std::string_view bytes, size_t most_pixels) {
  const std::unique_ptr<spng_ctx, void (*)(spng_ctx*)> context(spng_ctx_new(0), spng_ctx_free);
  spng_ihdr header;
  if (!context || spng_set_png_buffer(context.get(), bytes.data(), bytes.size()) != 0 ||
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
