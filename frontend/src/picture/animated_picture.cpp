#include "frontend/animated_picture.hpp"

#include <gif_lib.h>
#include <webp/encode.h>
#include <webp/mux.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "frontend/error.hpp"
#include "picture/palette.hpp"

namespace frontend {
namespace {

using csgcore::Image;

[[noreturn]] void throw_refused(const char* format, const std::string& what) {
  throw Error({}, {}, std::string("the ") + format + " cannot be made: " + what,
              "give another format or a smaller --imgsize");
}

/// Returns when a frame begins, in so many parts of a second, rounded for itself: all frames
/// together take their time exactly.
int begin_of(uint32_t frame, double fps, double parts) {
  return static_cast<int>(std::lround(frame * parts / fps));
}

/// Each frame has the 256 colours that suit it best.
class GifEncoder final : public AnimationEncoder {
 public:
  explicit GifEncoder(double fps) : fps_(fps) {
    int error = 0;
    file_ = EGifOpen(&bytes_, append, &error);
    if (file_ == nullptr) throw_error(error);
    EGifSetGifVersion(file_, true);
  }
  GifEncoder(const GifEncoder&) = delete;
  GifEncoder& operator=(const GifEncoder&) = delete;
  ~GifEncoder() override { close(); }

  void add(const Image& image) override {
    if (frame_ == 0) begin(image);
    const PalettePicture picture = with_palette(image);
    std::array<GifColorType, 256> palette{};
    for (size_t i = 0; i < picture.colors.size(); ++i) {
      const auto& [red, green, blue] = picture.colors[i];
      palette[i] = {red, green, blue};
    }
    const std::unique_ptr<ColorMapObject, void (*)(ColorMapObject*)> map(
        GifMakeMapObject(static_cast<int>(palette.size()), palette.data()), GifFreeMapObject);
    if (!map) throw std::bad_alloc();
    put_time();
    check(EGifPutImageDesc(file_, 0, 0, width(image), height(image), false, map.get()));
    std::vector<GifByteType> row(image.width_px);  // which giflib may change
    for (uint32_t y = 0; y < image.height_px; ++y) {
      std::copy_n(picture.pixels.begin() + static_cast<std::ptrdiff_t>(size_t{y} * row.size()),
                  row.size(), row.begin());
      check(EGifPutLine(file_, row.data(), width(image)));
    }
    ++frame_;
  }

  Bytes finish() override {
    const int error = close();
    if (error != 0) throw_error(error);
    return std::move(bytes_);
  }

 private:
  static constexpr uint32_t kMostSide_px = 0xFFFF;

  static int append(GifFileType* file, const GifByteType* data, int size) {
    Bytes& bytes = *static_cast<Bytes*>(file->UserData);
    const auto* const first = reinterpret_cast<const std::byte*>(data);
    bytes.insert(bytes.end(), first, first + size);
    return size;
  }
  static int width(const Image& image) { return static_cast<int>(image.width_px); }
  static int height(const Image& image) { return static_cast<int>(image.height_px); }

  [[noreturn]] static void throw_error(int error) {
    const char* const text = GifErrorString(error);
    throw_refused("GIF", text != nullptr ? text : "unknown error");
  }
  void check(int result) const {
    if (result == GIF_ERROR) throw_error(file_->Error);
  }

  void begin(const Image& image) {
    if (image.width_px > kMostSide_px || image.height_px > kMostSide_px) {
      throw_refused("GIF",
                    "its sides may have " + std::to_string(kMostSide_px) + " pixels at most");
    }
    check(EGifPutScreenDesc(file_, width(image), height(image), 8, 0, nullptr));
    // It is shown again and again.
    constexpr std::array<GifByteType, 3> kEndless{1, 0, 0};
    check(EGifPutExtensionLeader(file_, APPLICATION_EXT_FUNC_CODE));
    check(EGifPutExtensionBlock(file_, 11, "NETSCAPE2.0"));
    check(EGifPutExtensionBlock(file_, static_cast<int>(kEndless.size()), kEndless.data()));
    check(EGifPutExtensionTrailer(file_));
  }

  void put_time() {
    constexpr double kParts = 100;
    GraphicsControlBlock control{};
    control.TransparentColor = NO_TRANSPARENT_COLOR;
    control.DelayTime = begin_of(frame_ + 1, fps_, kParts) - begin_of(frame_, fps_, kParts);
    std::array<GifByteType, 4> bytes{};
    const size_t size = EGifGCBToExtension(&control, bytes.data());
    check(EGifPutExtension(file_, GRAPHICS_EXT_FUNC_CODE, static_cast<int>(size), bytes.data()));
  }

  /// Returns 0, or what went wrong.
  int close() {
    int error = 0;
    if (file_ == nullptr) return 0;
    const bool is_closed = EGifCloseFile(file_, &error) == GIF_OK;
    file_ = nullptr;
    return is_closed ? 0 : error;
  }

  const double fps_;
  Bytes bytes_;
  GifFileType* file_ = nullptr;
  uint32_t frame_ = 0;
};

/// Without loss.
class WebpEncoder final : public AnimationEncoder {
 public:
  explicit WebpEncoder(double fps) : fps_(fps) {
    // Most of what level 6 finds at a fifth of its time.
    constexpr int kLevel = 2;
    if (WebPConfigInit(&config_) == 0 || WebPConfigLosslessPreset(&config_, kLevel) == 0) {
      throw_refused("WebP", "the library is another version");
    }
  }

  void add(const Image& image) override {
    if (!encoder_) begin(image);
    Picture picture;
    picture.data.use_argb = 1;
    picture.data.width = static_cast<int>(image.width_px);
    picture.data.height = static_cast<int>(image.height_px);
    const int stride = 3 * picture.data.width;
    if (WebPPictureImportRGB(&picture.data, image.rgb.front().data(), stride) == 0) {
      throw std::bad_alloc();
    }
    check(WebPAnimEncoderAdd(encoder_.get(), &picture.data, time(), &config_));
    ++frame_;
  }

  Bytes finish() override {
    check(WebPAnimEncoderAdd(encoder_.get(), nullptr, time(), nullptr));
    WebPData data;
    WebPDataInit(&data);
    check(WebPAnimEncoderAssemble(encoder_.get(), &data));
    const auto* const first = reinterpret_cast<const std::byte*>(data.bytes);
    Bytes bytes(first, first + data.size);
    WebPDataClear(&data);
    return bytes;
  }

 private:
  struct Picture {
    Picture() { WebPPictureInit(&data); }
    ~Picture() { WebPPictureFree(&data); }
    Picture(const Picture&) = delete;
    Picture& operator=(const Picture&) = delete;
    WebPPicture data;
  };
  struct Delete {
    void operator()(WebPAnimEncoder* encoder) const { WebPAnimEncoderDelete(encoder); }
  };

  void begin(const Image& image) {
    constexpr uint32_t kMostSide_px = WEBP_MAX_DIMENSION;
    if (image.width_px > kMostSide_px || image.height_px > kMostSide_px) {
      throw_refused("WebP",
                    "its sides may have " + std::to_string(kMostSide_px) + " pixels at most");
    }
    WebPAnimEncoderOptions options;
    if (WebPAnimEncoderOptionsInit(&options) == 0)
      throw_refused("WebP", "the library is another version");
    encoder_.reset(WebPAnimEncoderNew(static_cast<int>(image.width_px),
                                      static_cast<int>(image.height_px), &options));
    if (!encoder_) throw std::bad_alloc();
  }

  /// Returns the time at which the next frame begins, in ms.
  int time() const { return begin_of(frame_, fps_, 1000); }

  void check(int result) const {
    if (result == 0) throw_refused("WebP", WebPAnimEncoderGetError(encoder_.get()));
  }

  const double fps_;
  WebPConfig config_;
  std::unique_ptr<WebPAnimEncoder, Delete> encoder_;
  uint32_t frame_ = 0;
};

}  // namespace

std::unique_ptr<AnimationEncoder> AnimationEncoder::make(PictureFormat format, double fps) {
  if (format == PictureFormat::kGif) return std::make_unique<GifEncoder>(fps);
  return std::make_unique<WebpEncoder>(fps);
}

Bytes encode_picture(const Image& image, PictureFormat format) {
  if (format == PictureFormat::kPng) return encode_png(image);
  if (format == PictureFormat::kExr) return encode_exr(image);
  const std::unique_ptr<AnimationEncoder> encoder = AnimationEncoder::make(format, kDefaultFps);
  encoder->add(image);
  return encoder->finish();
}

}  // namespace frontend
