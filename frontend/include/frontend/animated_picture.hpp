// Pictures that hold several frames, which viewers show one after another, again and again.
#pragma once

#include <cstdint>
#include <memory>

#include "csgcore/image.hpp"
#include "frontend/picture_file.hpp"

namespace frontend {

/// Whether files of the format hold all frames of an animation.
constexpr bool is_animated(PictureFormat format) {
  return format == PictureFormat::kGif || format == PictureFormat::kWebp;
}

/// Frames a second. Many viewers slow down GIFs of more.
constexpr double kDefaultFps = 20, kLeastFps = 0.1, kMostFps = 50;

class AnimationEncoder {
 public:
  /// The format is an animated one.
  static std::unique_ptr<AnimationEncoder> make(PictureFormat format, double fps);
  virtual ~AnimationEncoder() = default;
  /// Adds a frame; all have one size. Throws Error if the format cannot have such a picture.
  virtual void add(const csgcore::Image& image) = 0;
  /// Returns the file. Precondition: there is a frame. Nothing can be added after that.
  virtual Bytes finish() = 0;
};

}  // namespace frontend
