// The luminance of PNG pictures, which libspng reads.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

namespace frontend {

/// The luminance of a picture, 0 to 255.
struct GrayPicture {
  size_t columns = 0, rows = 0;
  std::vector<double> values;  // row by row from the top
};

bool is_png(std::string_view bytes);

/// Reads a picture of any type and depth, which begins as one (is_png()); transparency is ignored.
/// Returns nothing if it is damaged
/// or has more than `most_pixels`.
std::optional<GrayPicture> read_gray_png(std::string_view bytes, size_t most_pixels);

}  // namespace frontend
