#include "picture_errors.hpp"

#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "png.hpp"

namespace measure {
namespace {

using csgcore::Hits;

template <typename T>
nlohmann::json or_null(const std::optional<T>& value) {
  return value ? nlohmann::json(*value) : nlohmann::json();
}

void require_same_size(const Picture& a, const Picture& b) {
  if (a.width_px != b.width_px || a.height_px != b.height_px) {
    throw std::runtime_error("pictures of different sizes");
  }
}

}  // namespace

Picture read_picture(const std::filesystem::path& file) {
  const Png png = read_png(file);
  Picture picture{png.width_px, png.height_px, {}};
  for (size_t i = 0; i < png.rgb.size(); i += 3) {
    picture.rgb.push_back({png.rgb[i], png.rgb[i + 1], png.rgb[i + 2]});
  }
  return picture;
}

Picture averaged(const Picture& picture, uint32_t factor) {
  Picture result{picture.width_px / factor, picture.height_px / factor, {}};
  const uint32_t count = factor * factor;
  for (uint32_t y = 0; y < result.height_px; ++y) {
    for (uint32_t x = 0; x < result.width_px; ++x) {
      std::array<uint32_t, 3> sum{};
      for (uint32_t i = 0; i < count; ++i) {
        const size_t row = size_t{y} * factor + i / factor;
        const auto& pixel = picture.rgb[row * picture.width_px + x * factor + i % factor];
        for (size_t c = 0; c < 3; ++c) sum[c] += pixel[c];
      }
      std::array<uint8_t, 3> mean;
      for (size_t c = 0; c < 3; ++c) mean[c] = static_cast<uint8_t>((sum[c] + count / 2) / count);
      result.rgb.push_back(mean);
    }
  }
  return result;
}

void to_json(nlohmann::json& json, const PictureErrors& errors) {
  json = {{"wrong", or_null(errors.wrong)},
          {"silhouette", or_null(errors.silhouette)},
          {"depth_worst", or_null(errors.depth_worst)},
          {"depth_mean", or_null(errors.depth_mean)},
          {"colour_wrong", or_null(errors.colour_wrong)},
          {"colour_rms", or_null(errors.colour_rms)}};
}

void compare_hits(const Hits& seen, const Hits& exact, double size, PictureErrors& errors) {
  if (seen.primitive.size() != exact.primitive.size()) {
    throw std::runtime_error("pictures of different sizes");
  }
  uint64_t wrong = 0, silhouette = 0, both = 0;
  double worst = 0, sum = 0;
  for (size_t i = 0; i < exact.primitive.size(); ++i) {
    const bool is_hit = seen.primitive[i] != Hits::kMiss;
    const bool should_hit = exact.primitive[i] != Hits::kMiss;
    wrong += seen.primitive[i] != exact.primitive[i];
    silhouette += is_hit != should_hit;
    if (!is_hit || !should_hit || seen.s.empty()) continue;
    const double error = std::abs(seen.s[i] - exact.s[i]) / size;
    worst = std::max(worst, error);
    sum += error;
    ++both;
  }
  errors.wrong = wrong;
  errors.silhouette = silhouette;
  if (both > 0) {
    errors.depth_worst = worst;
    errors.depth_mean = sum / static_cast<double>(both);
  }
}

uint64_t differing_pixels(const Picture& a, const Picture& b) {
  require_same_size(a, b);
  uint64_t count = 0;
  for (size_t i = 0; i < a.rgb.size(); ++i) {
    int most = 0;
    for (size_t c = 0; c < 3; ++c) most = std::max(most, std::abs(a.rgb[i][c] - b.rgb[i][c]));
    count += most > kColourTolerance;
  }
  return count;
}

void compare_colours(const Picture& picture, const Picture& exact, const Picture& antialiased,
                     PictureErrors& errors) {
  errors.colour_wrong = differing_pixels(picture, exact);
  require_same_size(picture, antialiased);
  double squares = 0;
  for (size_t i = 0; i < picture.rgb.size(); ++i) {
    for (size_t c = 0; c < 3; ++c) {
      const double difference = picture.rgb[i][c] - antialiased.rgb[i][c];
      squares += difference * difference;
    }
  }
  errors.colour_rms = std::sqrt(squares / (3 * static_cast<double>(picture.rgb.size())));
}

}  // namespace measure
