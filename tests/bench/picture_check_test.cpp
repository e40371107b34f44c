// Tests which pictures count as wrong.
#include <gtest/gtest.h>

#include "bench/measurement.hpp"

namespace bench {
namespace {

using csgcore::Image;

Image picture() {
  Image image;
  image.width_px = 3;
  image.height_px = 2;
  image.rgb.assign(6, {1, 2, 3});
  image.z.assign(6, 1.0f);
  image.normal.assign(6, glm::vec3(0, 0, 1));
  image.position.assign(6, glm::vec3(1, 2, 3));
  image.id.assign(6, 7);
  return image;
}

TEST(PictureCheck, AnotherPrimitiveOrAnotherFaceIsWrong) {
  Image image = picture();
  EXPECT_EQ(wrong_pixels(image, picture()), 0u);
  image.id[0] = csgcore::kNoPrimitive;
  image.normal[4] = glm::vec3(0, 1, 0);
  EXPECT_EQ(wrong_pixels(image, picture()), 2u);
  image.id[4] = 8;  // wrong in two ways, but one pixel
  EXPECT_EQ(wrong_pixels(image, picture()), 2u);
}

TEST(PictureCheck, WhatFloatDoesToANormalIsNotWrong) {
  Image image = picture();
  image.normal[3] = glm::normalize(glm::vec3(0.001, 0, 1));
  EXPECT_EQ(wrong_pixels(image, picture()), 0u);
}

TEST(PictureCheck, TheSameIsEveryChannelBitForBit) {
  EXPECT_TRUE(is_same(picture(), picture()));
  const auto differs = [](auto change) {
    Image image = picture();
    change(image);
    return !is_same(image, picture());
  };
  EXPECT_TRUE(differs([](Image& image) { ++image.rgb[5][2]; }));
  EXPECT_TRUE(differs([](Image& image) { image.z[5] = std::nextafter(1.0f, 2.0f); }));
  EXPECT_TRUE(differs([](Image& image) { image.normal[5].x = 1e-7f; }));
  EXPECT_TRUE(differs([](Image& image) { image.position[5].x = 0; }));
  EXPECT_TRUE(differs([](Image& image) { ++image.id[5]; }));
}

TEST(PictureCheck, FloatExplainsSomePixelsAtEdges) {
  EXPECT_TRUE(float_explains(4, 10));
  EXPECT_FALSE(float_explains(5, 10));
  EXPECT_TRUE(float_explains(50, 100'000));
  EXPECT_FALSE(float_explains(51, 100'000));
}

}  // namespace
}  // namespace bench
