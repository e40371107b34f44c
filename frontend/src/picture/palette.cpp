#include "picture/palette.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <span>

namespace frontend {
namespace {

using Rgb8 = std::array<uint8_t, 3>;

constexpr size_t kMostColors = 256;

struct CountedColor {
  Rgb8 color;
  uint8_t group;
  uint64_t pixels;
};

std::vector<CountedColor> colors_of(const csgcore::Image& image) {
  std::vector<Rgb8> sorted = image.rgb;
  std::ranges::sort(sorted);
  std::vector<CountedColor> colors;
  for (const Rgb8& color : sorted) {
    if (colors.empty() || colors.back().color != color) colors.push_back({color, 0, 0});
    ++colors.back().pixels;
  }
  return colors;
}

/// Colours that become one.
struct Group {
  explicit Group(std::span<CountedColor> those) : colors(those) {
    std::array<double, 3> sums{}, squares{};
    double pixels = 0;
    for (const CountedColor& one : colors) {
      const auto count = static_cast<double>(one.pixels);
      pixels += count;
      for (size_t i = 0; i < 3; ++i) {
        sums[i] += count * one.color[i];
        squares[i] += count * one.color[i] * one.color[i];
      }
    }
    for (size_t i = 0; i < 3; ++i) {
      mean[i] = sums[i] / pixels;
      const double error_of_channel = squares[i] - sums[i] * mean[i];
      if (error_of_channel <= error) continue;
      error = error_of_channel;
      channel = i;
    }
  }

  /// Precondition: error > 0.
  std::array<Group, 2> divided() const {
    const auto upper = std::partition(colors.begin(), colors.end(), [this](const auto& one) {
      return one.color[channel] <= mean[channel];
    });
    const auto lower_size = static_cast<size_t>(upper - colors.begin());
    return {Group(colors.first(lower_size)), Group(colors.subspan(lower_size))};
  }

  std::span<CountedColor> colors;
  std::array<double, 3> mean{};
  double error = 0;    // sum of the squares, of the channel in which they differ most
  size_t channel = 0;  // that channel
};

}  // namespace

PalettePicture with_palette(const csgcore::Image& image) {
  std::vector<CountedColor> colors = colors_of(image);
  std::vector<Group> groups{Group(colors)};
  while (groups.size() < kMostColors) {
    const auto worst = std::ranges::max_element(groups, {}, &Group::error);
    if (!(worst->error > 0.25)) break;  // rounding: the colours of the group are one
    const auto [lower, upper] = worst->divided();
    *worst = lower;
    groups.push_back(upper);
  }
  PalettePicture result;
  for (size_t group = 0; group < groups.size(); ++group) {
    for (CountedColor& one : groups[group].colors) one.group = static_cast<uint8_t>(group);
    Rgb8& color = result.colors.emplace_back();
    for (size_t i = 0; i < 3; ++i) {
      color[i] = static_cast<uint8_t>(std::lround(groups[group].mean[i]));
    }
  }
  std::ranges::sort(colors, {}, &CountedColor::color);
  result.pixels.reserve(image.rgb.size());
  auto found = colors.begin();
  for (const Rgb8& color : image.rgb) {
    if (found->color != color) {
      found = std::ranges::lower_bound(colors, color, {}, &CountedColor::color);
    }
    result.pixels.push_back(found->group);
  }
  return result;
}

}  // namespace frontend
