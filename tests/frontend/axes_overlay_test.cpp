// --view=axes against what OpenSCAD 2021.01 draws (read off its PNGs, 512×512, dist 20).
#include "frontend/axes_overlay.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

namespace frontend {
namespace {

using csgcore::Image;
using testing::ElementsAre;

constexpr Rgb kAxesColor{10, 20, 30};

class AxesOverlay : public testing::Test {
 protected:
  AxesOverlay() {
    camera_.rotation_deg = {0, 0, 0};
    camera_.distance = 20;
  }

  /// `z`: of every pixel.
  Image draw(float z) {
    Image image;
    image.width_px = options_.width_px;
    image.height_px = options_.height_px;
    image.rgb.assign(image.width_px * image.height_px, {255, 255, 255});
    image.z.assign(image.rgb.size(), z);
    draw_axes(image, make_view(camera_, options_), camera_, kAxesColor);
    return image;
  }

  static char letter(const std::array<uint8_t, 3>& c) {
    if (c == std::array<uint8_t, 3>{255, 255, 255}) return '.';
    if (c == std::array<uint8_t, 3>{kAxesColor.r, kAxesColor.g, kAxesColor.b}) return '#';
    if (c == std::array<uint8_t, 3>{255, 0, 0}) return 'r';
    if (c == std::array<uint8_t, 3>{0, 255, 0}) return 'g';
    if (c == std::array<uint8_t, 3>{0, 0, 255}) return 'b';
    return '?';
  }
  static std::string row(const Image& image, uint32_t y, uint32_t from, uint32_t to) {
    std::string text;
    for (uint32_t x = from; x < to; ++x) text += letter(image.rgb[y * image.width_px + x]);
    return text;
  }
  static std::string column(const Image& image, uint32_t x, uint32_t from, uint32_t to) {
    std::string text;
    for (uint32_t y = from; y < to; ++y) text += letter(image.rgb[y * image.width_px + x]);
    return text;
  }

  Camera camera_;
  CameraOptions options_;
  static constexpr float kMiss = std::numeric_limits<float>::infinity();
};

TEST_F(AxesOverlay, PositiveHalvesAreSolidAndNegativeOnesStippled) {
  const Image image = draw(kMiss);
  EXPECT_EQ(row(image, 256, 238, 276), "###...###...###.." + std::string(21, '#'))
      << "the stipple starts with 3 pixels off at the origin";
  EXPECT_EQ(column(image, 255, 246, 272), "###########..###...###...#");
  EXPECT_EQ(row(image, 256, 504, 512), "########") << "up to the edge";
}

TEST_F(AxesOverlay, GnomonInTheCornerHasColorsAndLetters) {
  const Image image = draw(kMiss);
  EXPECT_EQ(row(image, 460, 48, 90), "...#" + std::string(27, 'r') + ".....##....");
  std::vector<std::string> rows;
  for (uint32_t y = 424; y < 434; ++y) rows.push_back(row(image, y, 47, 55));
  EXPECT_THAT(rows, ElementsAre(".#....#.", "..#..#..", "...##...", "...#....", "..#.....",
                                ".#......", "........", "........", "........", "....g..."));
  EXPECT_EQ(row(image, 458, 47, 90), ".######" + std::string(28, '.') + "#....#..");
  EXPECT_EQ(row(image, 464, 47, 55), ".######.");
}

TEST_F(AxesOverlay, ModelHidesTheAxesButNotTheGnomon) {
  const Image hidden = draw(15);  // the axes' plane is 20 away
  EXPECT_EQ(row(hidden, 256, 300, 310), "..........");
  EXPECT_EQ(row(hidden, 460, 52, 60), "rrrrrrrr");
  const Image behind = draw(25);
  EXPECT_EQ(row(behind, 256, 300, 310), "##########");
  const Image coincident = draw(20);
  EXPECT_EQ(row(coincident, 256, 300, 310), "##########");
}

TEST_F(AxesOverlay, AnAxisComesOutOfTheModelWhereItDoes) {
  // From the front, x to the right: the model's depth is 20 on the left half, 10 on the right.
  camera_.rotation_deg = {90, 0, 0};
  Image image = draw(kMiss);
  for (uint32_t y = 0; y < image.height_px; ++y) {
    for (uint32_t x = 0; x < image.width_px; ++x) {
      image.rgb[y * image.width_px + x] = {255, 255, 255};
      image.z[y * image.width_px + x] = x < 400 ? 21.0f : 10.0f;
    }
  }
  draw_axes(image, make_view(camera_, options_), camera_, kAxesColor);
  EXPECT_EQ(row(image, 256, 395, 405), "#####.....");
}

TEST_F(AxesOverlay, DepthIsRightAlongAnObliqueAxis) {
  // The x axis comes towards the eye, to the right: at x it is 20 − x·cos 45° from the eye's plane.
  camera_.rotation_deg = {0, 45, 0};
  for (const auto projection :
       {csgcore::Projection::kPerspective, csgcore::Projection::kOrthographic}) {
    options_.projection = projection;
    const double along = 3 * std::sqrt(0.5);  // the model's depth cuts the axis at x = 3
    const Image image = draw(static_cast<float>(20 - along));
    double offset = along / make_view(camera_, options_).half_height;
    if (projection == csgcore::Projection::kPerspective) offset /= 20 - along;
    const auto cut = static_cast<uint32_t>(256 + offset * 256);
    EXPECT_EQ(row(image, 256, cut - 4, cut - 1), "...");
    EXPECT_EQ(row(image, 256, cut + 1, cut + 4), "###");
  }
}

TEST_F(AxesOverlay, FarAwayAndTinyCamerasEnd) {
  // Seen from the side, 10^9 away: an axis begins up to 10^300 pixels outside of the picture.
  for (const csgcore::Vec3& rotation : {csgcore::Vec3(0, 0, 0), csgcore::Vec3(10, 20, 30)}) {
    for (const csgcore::Vec3& target : {csgcore::Vec3(1e9, 0, 0), csgcore::Vec3(-1e9, 2e9, 3e9)}) {
      for (const double distance : {1e-300, 1e-9, 1e-5, 1e-4, 1e-2, 1.0, 1e300}) {
        camera_.rotation_deg = rotation;
        camera_.target = target;
        camera_.distance = distance;
        EXPECT_EQ(draw(kMiss).rgb.size(), 512u * 512u);
      }
    }
  }
  options_.width_px = options_.height_px = 1;
  draw(kMiss);
}

}  // namespace
}  // namespace frontend
