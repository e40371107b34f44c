#include "frontend/picture_file.hpp"

namespace frontend {

Bytes encode_picture(const csgcore::Image& image, PictureFormat format) {
  return format == PictureFormat::kPng ? encode_png(image) : encode_exr(image);
}

}  // namespace frontend
