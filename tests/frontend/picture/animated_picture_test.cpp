// Tests GIF and WebP, read back by the libraries' own readers.
#include "frontend/animated_picture.hpp"

#include <gif_lib.h>
#include <gtest/gtest.h>
#include <webp/demux.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <random>
#include <vector>

#include "frontend/error.hpp"

namespace frontend {
namespace {

using csgcore::Image;
using Pixels = std::vector<std::array<uint8_t, 3>>;

struct Read {
  int width = 0, height = 0, loops = 0;
  std::vector<Pixels> frames;
  std::vector<int> ends_ms;  // of the frames
};

Read read_webp(const Bytes& bytes) {
  const WebPData data{reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size()};
  WebPAnimDecoder* const decoder = WebPAnimDecoderNew(&data, nullptr);
  if (decoder == nullptr) return {};
  WebPAnimInfo info;
  WebPAnimDecoderGetInfo(decoder, &info);
  Read read{static_cast<int>(info.canvas_width),
            static_cast<int>(info.canvas_height),
            static_cast<int>(info.loop_count),
            {},
            {}};
  while (WebPAnimDecoderHasMoreFrames(decoder)) {
    uint8_t* rgba = nullptr;
    int end_ms = 0;
    if (!WebPAnimDecoderGetNext(decoder, &rgba, &end_ms)) break;
    Pixels& pixels = read.frames.emplace_back();
    for (int i = 0; i < read.width * read.height; ++i) {
      pixels.push_back({rgba[4 * i], rgba[4 * i + 1], rgba[4 * i + 2]});
    }
    read.ends_ms.push_back(end_ms);
  }
  WebPAnimDecoderDelete(decoder);
  return read;
}

struct Source {
  const Bytes& bytes;
  size_t position = 0;
};

int give(GifFileType* file, GifByteType* target, int size) {
  Source& source = *static_cast<Source*>(file->UserData);
  const size_t count =
      std::min<size_t>(source.bytes.size() - source.position, static_cast<size_t>(size));
  std::memcpy(target, source.bytes.data() + source.position, count);
  source.position += count;
  return static_cast<int>(count);
}

Read read_gif(const Bytes& bytes) {
  Source source{bytes};
  int error = 0;
  GifFileType* const file = DGifOpen(&source, give, &error);
  if (file == nullptr || DGifSlurp(file) != GIF_OK) return {};
  Read read{file->SWidth, file->SHeight, -1, {}, {}};
  int end_ms = 0;
  for (int i = 0; i < file->ImageCount; ++i) {
    const SavedImage& image = file->SavedImages[i];
    for (int k = 0; k < image.ExtensionBlockCount; ++k) {
      const ExtensionBlock& block = image.ExtensionBlocks[k];
      const bool is_loop =
          block.ByteCount == 11 && std::memcmp(block.Bytes, "NETSCAPE2.0", 11) == 0;
      if (is_loop) read.loops = 0;
    }
    GraphicsControlBlock control;
    DGifSavedExtensionToGCB(file, i, &control);
    end_ms += 10 * control.DelayTime;
    read.ends_ms.push_back(end_ms);
    Pixels& pixels = read.frames.emplace_back();
    for (int k = 0; k < read.width * read.height; ++k) {
      const GifColorType& color = image.ImageDesc.ColorMap->Colors[image.RasterBits[k]];
      pixels.push_back({color.Red, color.Green, color.Blue});
    }
  }
  DGifCloseFile(file, &error);
  return read;
}

Read read(PictureFormat format, const Bytes& bytes) {
  return format == PictureFormat::kGif ? read_gif(bytes) : read_webp(bytes);
}

/// A picture of so many colours, the first of which fills half of it.
Image picture(uint32_t seed, int colors, uint32_t width = 61, uint32_t height = 47) {
  std::mt19937 random(seed);
  Pixels palette;
  for (int i = 0; i < colors; ++i) {
    palette.push_back({static_cast<uint8_t>(random()), static_cast<uint8_t>(random()),
                       static_cast<uint8_t>(random())});
  }
  Image image;
  image.width_px = width;
  image.height_px = height;
  for (uint32_t i = 0; i < width * height; ++i) {
    image.rgb.push_back(palette[i % 2 == 0 ? 0 : random() % palette.size()]);
  }
  return image;
}

Bytes encoded(PictureFormat format, const std::vector<Image>& frames, double fps) {
  const auto encoder = AnimationEncoder::make(format, fps);
  for (const Image& frame : frames) encoder->add(frame);
  return encoder->finish();
}

class AnimatedPicture : public testing::TestWithParam<PictureFormat> {};

TEST_P(AnimatedPicture, HoldsItsFramesInTheirTime) {
  const std::vector<Image> frames = {picture(1, 9), picture(2, 200), picture(3, 256), picture(4, 2),
                                     picture(5, 1)};
  const double fps = 30;  // which neither a 100th nor a 1000th of a second divides
  const Read read = frontend::read(GetParam(), encoded(GetParam(), frames, fps));
  EXPECT_EQ(read.width, 61);
  EXPECT_EQ(read.height, 47);
  EXPECT_EQ(read.loops, 0) << "without an end";
  ASSERT_EQ(read.frames.size(), frames.size());
  for (size_t i = 0; i < frames.size(); ++i) {
    EXPECT_EQ(read.frames[i], frames[i].rgb) << i;
    const double end_ms = 1000 / fps * static_cast<double>(i + 1);
    EXPECT_NEAR(read.ends_ms[i], end_ms, GetParam() == PictureFormat::kGif ? 5 : 0.5) << i;
  }
}

TEST_P(AnimatedPicture, OfOneFrameIsAStill) {
  const Image image = picture(7, 100);
  const Read read = frontend::read(GetParam(), encode_picture(image, GetParam()));
  ASSERT_EQ(read.frames.size(), 1u);
  EXPECT_EQ(read.frames[0], image.rgb);
}

TEST_P(AnimatedPicture, HasTheSameBytesEachTime) {
  const std::vector<Image> frames = {picture(1, 5000), picture(2, 5000)};
  EXPECT_EQ(encoded(GetParam(), frames, 10), encoded(GetParam(), frames, 10));
}

TEST_P(AnimatedPicture, TooLargeOnesAreAnError) {
  const Image wide = picture(1, 3, 70000, 1);
  EXPECT_THROW(encode_picture(wide, GetParam()), Error);
}

INSTANTIATE_TEST_SUITE_P(, AnimatedPicture,
                         testing::Values(PictureFormat::kGif, PictureFormat::kWebp),
                         [](const auto& format) {
                           return format.param == PictureFormat::kGif ? "Gif" : "Webp";
                         });

/// A GIF of more colours is near, and what fills much of it is exact.
TEST(GifPalette, IsThatOfThePicture) {
  Image image = picture(1, 1, 256, 256);
  const auto ground = image.rgb.front();
  for (uint32_t y = 0; y < 128; ++y) {  // a smooth gradient
    for (uint32_t x = 0; x < 256; ++x) {
      image.rgb[y * 256 + x] = {static_cast<uint8_t>(x), static_cast<uint8_t>(200 - x / 2),
                                static_cast<uint8_t>(2 * y)};
    }
  }
  const Read read = read_gif(encode_picture(image, PictureFormat::kGif));
  double sum = 0;
  for (size_t i = 0; i < image.rgb.size(); ++i) {
    for (size_t k = 0; k < 3; ++k) {
      const int off = read.frames[0][i][k] - image.rgb[i][k];
      sum += off * off;
    }
    if (i >= 128 * 256) {
      ASSERT_EQ(read.frames[0][i], ground);
    }
  }
  EXPECT_LT(std::sqrt(sum / (3 * 128 * 256)), 5);
}

TEST(WebpPicture, HasNoLoss) {
  const Image image = picture(1, 50000, 300, 200);
  EXPECT_EQ(read_webp(encode_picture(image, PictureFormat::kWebp)).frames.at(0), image.rgb);
}

}  // namespace
}  // namespace frontend
