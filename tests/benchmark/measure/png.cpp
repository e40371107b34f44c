#include "png.hpp"

#include <spng.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <stdexcept>

namespace measure {

Png read_png(const std::filesystem::path& file) {
  const auto check = [&](int result) {
    if (result != 0) throw std::runtime_error(file.string() + ": " + spng_strerror(result));
  };
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> stream(std::fopen(file.c_str(), "rb"),
                                                               std::fclose);
  if (!stream) throw std::runtime_error(file.string() + ": cannot be read");
  const std::unique_ptr<spng_ctx, void (*)(spng_ctx*)> context(spng_ctx_new(0), spng_ctx_free);
  check(spng_set_png_file(context.get(), stream.get()));
  spng_ihdr header{};
  check(spng_get_ihdr(context.get(), &header));
  Png picture{header.width, header.height, {}};
  size_t bytes = 0;
  check(spng_decoded_image_size(context.get(), SPNG_FMT_RGB8, &bytes));
  picture.rgb.resize(bytes);
  check(spng_decode_image(context.get(), picture.rgb.data(), bytes, SPNG_FMT_RGB8, 0));
  return picture;
}

bool is_blank(const Png& picture) {
  constexpr size_t kChannels = 3;
  for (size_t i = kChannels; i < picture.rgb.size(); ++i) {
    if (picture.rgb[i] != picture.rgb[i - kChannels]) return false;
  }
  return true;
}

}  // namespace measure
