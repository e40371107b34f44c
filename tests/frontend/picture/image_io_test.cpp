// Tests PNG and EXR, read back by the libraries' own readers, and the pictures of channels.
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputFile.h>
#include <gmock/gmock.h>
#include <spng.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>

#include "frontend/picture_file.hpp"

namespace frontend {
namespace {

using csgcore::Image;
using testing::ElementsAre;

constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// Every channel differs in every pixel; about a third of the pixels are misses.
Image random_image(uint32_t width, uint32_t height, uint32_t seed = 1) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> number(-1, 1);
  Image image;
  image.width_px = width;
  image.height_px = height;
  for (uint32_t i = 0; i < width * height; ++i) {
    const bool hit = random() % 3 != 0;
    image.rgb.push_back({static_cast<uint8_t>(random()), static_cast<uint8_t>(random()),
                         static_cast<uint8_t>(random())});
    image.z.push_back(hit ? 2 + number(random) : kInfinity);
    const auto vector = [&] {
      return hit ? glm::vec3(number(random), number(random), number(random)) : glm::vec3(0.0f);
    };
    image.normal.push_back(vector());
    image.position.push_back(1000.0f * vector());
    image.id.push_back(hit ? static_cast<uint32_t>(random() % 4000000000u) : csgcore::kNoPrimitive);
  }
  return image;
}

std::vector<std::array<uint8_t, 3>> decode_png(const Bytes& file, spng_ihdr& header) {
  spng_ctx* context = spng_ctx_new(0);
  EXPECT_EQ(spng_set_png_buffer(context, file.data(), file.size()), 0);
  EXPECT_EQ(spng_get_ihdr(context, &header), 0);
  std::vector<std::array<uint8_t, 3>> pixels(header.width * header.height);
  EXPECT_EQ(spng_decode_image(context, pixels.data(), pixels.size() * 3, SPNG_FMT_RGB8, 0), 0);
  spng_ctx_free(context);
  return pixels;
}

class MemoryStream : public Imf::IStream {
 public:
  explicit MemoryStream(const Bytes& bytes) : IStream("memory"), bytes_(bytes) {}
  bool read(char target[], int count) override {
    if (position_ + static_cast<uint64_t>(count) > bytes_.size()) {
      throw std::runtime_error("read past the end");
    }
    std::memcpy(target, bytes_.data() + position_, static_cast<std::size_t>(count));
    position_ += static_cast<uint64_t>(count);
    return position_ < bytes_.size();
  }
  uint64_t tellg() override { return position_; }
  void seekg(uint64_t position) override { position_ = position; }

 private:
  const Bytes& bytes_;
  uint64_t position_ = 0;
};

template <typename T>
std::vector<T> read_channel(const Bytes& bytes, const char* name, Imf::PixelType type) {
  MemoryStream stream(bytes);
  Imf::InputFile file(stream);
  const auto window = file.header().dataWindow();
  const auto width = static_cast<std::size_t>(window.max.x - window.min.x + 1);
  const auto height = static_cast<std::size_t>(window.max.y - window.min.y + 1);
  std::vector<T> values(width * height);
  Imf::FrameBuffer buffer;
  buffer.insert(
      name, Imf::Slice(type, reinterpret_cast<char*>(values.data()), sizeof(T), sizeof(T) * width));
  file.setFrameBuffer(buffer);
  file.readPixels(window.min.y, window.max.y);
  return values;
}

TEST(Png, DecodesToTheSamePixels) {
  const Image image = random_image(37, 23);
  spng_ihdr header{};
  EXPECT_EQ(decode_png(encode_png(image), header), image.rgb);
  EXPECT_EQ(header.width, 37u);
  EXPECT_EQ(header.height, 23u);
  EXPECT_EQ(header.bit_depth, 8);
  EXPECT_EQ(header.color_type, SPNG_COLOR_TYPE_TRUECOLOR);
}

TEST(Png, SmallestPicture) {
  const Image image = random_image(1, 1);
  spng_ihdr header{};
  EXPECT_EQ(decode_png(encode_png(image), header), image.rgb);
}

std::size_t count_pixel_chunks(const Bytes& file) {
  std::size_t count = 0;
  for (std::size_t at = 8; at < file.size();) {
    std::size_t length = 0;
    for (int i = 0; i < 4; ++i) length = length << 8 | std::to_integer<std::size_t>(file[at++]);
    count += std::memcmp(file.data() + at, "IDAT", 4) == 0;
    at += 4 + length + 4;
  }
  return count;
}

/// Noise does not compress: one picture is longer than a chunk, and the other has rows longer than
/// a batch.
TEST(Png, LargePictures) {
  for (const auto& [width, height] : {std::pair(900u, 800u), std::pair(30000u, 3u)}) {
    const Image image = random_image(width, height);
    const Bytes file = encode_png(image);
    EXPECT_EQ(count_pixel_chunks(file), width == 900 ? 2u : 1u);
    spng_ihdr header{};
    EXPECT_TRUE(decode_png(file, header) == image.rgb) << width;
  }
}

TEST(Png, SameImageGivesTheSameBytes) {
  EXPECT_EQ(encode_png(random_image(64, 64)), encode_png(random_image(64, 64)));
}

TEST(Exr, HasExactlyTheChannelsOfTheDesign) {
  const Bytes bytes = encode_exr(random_image(5, 4));
  MemoryStream stream(bytes);
  const Imf::InputFile file(stream);
  std::vector<std::string> names;
  for (auto i = file.header().channels().begin(); i != file.header().channels().end(); ++i) {
    names.emplace_back(i.name());
    EXPECT_EQ(i.channel().type, names.back() == "id" ? Imf::UINT : Imf::FLOAT) << names.back();
  }
  EXPECT_THAT(names,
              ElementsAre("A", "B", "G", "N.X", "N.Y", "N.Z", "P.X", "P.Y", "P.Z", "R", "Z", "id"));
}

TEST(Exr, ChannelsDecodeToTheSameNumbers) {
  // More rows than a chunk has, and not a multiple of it.
  const Image image = random_image(41, 53);
  const Bytes bytes = encode_exr(image);
  const std::size_t pixels = image.rgb.size();
  const auto floats = [&bytes](const char* name) {
    return read_channel<float>(bytes, name, Imf::FLOAT);
  };
  EXPECT_EQ(floats("Z"), image.z);
  EXPECT_EQ(read_channel<uint32_t>(bytes, "id", Imf::UINT), image.id);
  const auto r = floats("R"), g = floats("G"), b = floats("B"), a = floats("A");
  const auto px = floats("P.X"), py = floats("P.Y"), pz = floats("P.Z");
  const auto nx = floats("N.X"), ny = floats("N.Y"), nz = floats("N.Z");
  ASSERT_EQ(r.size(), pixels);
  for (std::size_t i = 0; i < pixels; ++i) {
    ASSERT_EQ(r[i], image.rgb[i][0] / 255.0f);
    ASSERT_EQ(g[i], image.rgb[i][1] / 255.0f);
    ASSERT_EQ(b[i], image.rgb[i][2] / 255.0f);
    ASSERT_EQ(a[i], std::isinf(image.z[i]) ? 0.0f : 1.0f);
    ASSERT_EQ(glm::vec3(px[i], py[i], pz[i]), image.position[i]);
    ASSERT_EQ(glm::vec3(nx[i], ny[i], nz[i]), image.normal[i]);
  }
}

TEST(Exr, SameImageGivesTheSameBytes) {
  EXPECT_EQ(encode_exr(random_image(64, 64)), encode_exr(random_image(64, 64)));
}

TEST(Exr, SmallestPicture) {
  const Image image = random_image(1, 1, 7);
  EXPECT_EQ(read_channel<float>(encode_exr(image), "Z", Imf::FLOAT), image.z);
}

/// Three pixels: two hits and a miss.
Image two_hits() {
  Image image;
  image.width_px = 3;
  image.height_px = 1;
  image.rgb.assign(3, {1, 2, 3});
  image.z = {10, kInfinity, 30};
  image.normal = {{0, 0, 1}, {0, 0, 0}, {-1, 0, 0}};
  image.position.resize(3);
  image.id = {0, csgcore::kNoPrimitive, 1};
  return image;
}

using Pixel = std::array<uint8_t, 3>;
constexpr Rgb kBackground{9, 8, 7};

TEST(ChannelPicture, SurfaceAndCellsAreLeftAsTheyAre) {
  for (const Show show : {Show::kSurface, Show::kCells}) {
    Image image = two_hits();
    show_channel(image, show, kBackground);
    EXPECT_EQ(image.rgb, two_hits().rgb);
  }
}

TEST(ChannelPicture, DepthIsNearWhiteFarDark) {
  Image image = two_hits();
  show_channel(image, Show::kDepth, kBackground);
  EXPECT_THAT(image.rgb, ElementsAre(Pixel{255, 255, 255}, Pixel{9, 8, 7}, Pixel{48, 48, 48}));
}

TEST(ChannelPicture, DepthOfOneDistanceAndOfNoHit) {
  Image image = two_hits();
  image.z = {10, 10, 10};
  show_channel(image, Show::kDepth, kBackground);
  EXPECT_EQ(image.rgb[2], (Pixel{255, 255, 255}));
  image.z = {kInfinity, kInfinity, kInfinity};
  show_channel(image, Show::kDepth, kBackground);
  EXPECT_EQ(image.rgb[2], (Pixel{9, 8, 7}));
}

TEST(ChannelPicture, NormalsAreHalved) {
  Image image = two_hits();
  show_channel(image, Show::kNormals, kBackground);
  EXPECT_THAT(image.rgb, ElementsAre(Pixel{128, 128, 255}, Pixel{9, 8, 7}, Pixel{0, 128, 128}));
}

TEST(ChannelPicture, EachIdHasAColorOfItsOwn) {
  Image image;
  image.width_px = 1 << 16;
  image.height_px = 1;
  for (uint32_t i = 0; i < image.width_px; ++i) image.id.push_back(i);
  image.z.assign(image.width_px, 1.0f);
  image.rgb.resize(image.width_px);
  show_channel(image, Show::kId, kBackground);
  std::vector<Pixel> colors = image.rgb;
  std::sort(colors.begin(), colors.end());
  EXPECT_EQ(std::unique(colors.begin(), colors.end()), colors.end());
  // Neighbours are visibly different.
  for (std::size_t i = 1; i < 100; ++i) {
    int difference = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      difference += std::abs(image.rgb[i][c] - image.rgb[i - 1][c]);
    }
    EXPECT_GT(difference, 40) << i;
  }
}

}  // namespace
}  // namespace frontend
