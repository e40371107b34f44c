// Tests how the faces of a section plane are drawn, on pictures that show nothing else.
#include "section_hatch.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

namespace window {
namespace {

using csgcore::Image;
using csgcore::Vec3;
using Color = std::array<uint8_t, 3>;

constexpr uint32_t kSide_px = 120;
constexpr SectionPlane kPlane{true, {0, 0, 1}, false, 0};

/// Looks down along -z; a pixel is a quarter of a unit. `right` is where its middle is.
csgcore::View view_at(double right) {
  csgcore::View view;
  view.projection = csgcore::Projection::kOrthographic;
  view.eye = {right, 0, 50};
  view.forward = {0, 0, -1};
  view.right = {1, 0, 0};
  view.up = {0, 1, 0};
  view.half_height = kSide_px / 8.0;
  view.width_px = view.height_px = kSide_px;
  return view;
}

/// Faces 0 and 1 meet at x = 0, and end one unit before the picture's border if `right` is 0.
Image picture(double right, const Color& color) {
  Image image;
  image.width_px = image.height_px = kSide_px;
  image.rgb.assign(kSide_px * kSide_px, color);
  image.id.assign(image.rgb.size(), 7);
  for (uint32_t y = 4; y + 4 < kSide_px; ++y) {
    for (uint32_t x = 0; x < kSide_px; ++x) {
      const double at = right + (x + 0.5 - kSide_px / 2.0) / 4;
      if (std::abs(at) < 14) image.id[y * kSide_px + x] = kFirstSectionFace + (at > 0);
    }
  }
  return image;
}

constexpr Color kLight{200, 180, 60}, kDark{40, 0, 0};
constexpr uint32_t kTwoParts[] = {0, 1};

Image drawn(double right, const Color& color = kLight,
            std::span<const uint32_t> parts = kTwoParts) {
  Image image = picture(right, color);
  draw_section_faces(image, view_at(right), kPlane, parts, hatch_spacing(view_at(right), 1));
  return image;
}

const Color& at(const Image& image, uint32_t x, uint32_t y) { return image.rgb[y * kSide_px + x]; }

TEST(SectionHatch, LinesRunInAnotherDirectionInEachPart) {
  const Image image = drawn(0);
  // Those of part 0 rise to the right, those of part 1 fall: the picture repeats along them.
  size_t equal[2][2] = {}, all = 0;
  for (uint32_t y = 10; y < 110; ++y) {
    for (uint32_t x = 10; x < 45; ++x) {
      ++all;
      for (uint32_t part = 0; part < 2; ++part) {
        const Color& here = at(image, x + 62 * part, y);
        equal[part][0] += here == at(image, x + 62 * part + 1, y - 1);
        equal[part][1] += here == at(image, x + 62 * part + 1, y + 1);
      }
    }
  }
  EXPECT_EQ(equal[0][0], all);
  EXPECT_EQ(equal[1][1], all);
  EXPECT_LT(equal[0][1], all * 9 / 10);
  EXPECT_LT(equal[1][0], all * 9 / 10);
}

TEST(SectionHatch, LinesStayWhereTheyAreInTheWorld) {
  const Image before = drawn(0), after = drawn(5);  // by 20 pixels
  for (uint32_t y = 0; y < kSide_px; ++y) {
    for (uint32_t x = 20; x < kSide_px - 1; ++x) {
      const Color& moved = at(after, x - 20, y);
      for (size_t i = 0; i < 3; ++i) EXPECT_NEAR(moved[i], at(before, x, y)[i], 1) << x << ' ' << y;
    }
  }
}

TEST(SectionHatch, PartsHaveOutlinesAndFacesOfOnePartNone) {
  const Image image = drawn(0);
  const auto is_outline = [&](const Image& of, uint32_t x) { return at(of, x, 60)[0] < 40; };
  EXPECT_TRUE(is_outline(image, 59) && is_outline(image, 60)) << "where the two meet";
  EXPECT_TRUE(is_outline(image, 4) && is_outline(image, 115)) << "where they end";
  EXPECT_FALSE(is_outline(image, 3) || is_outline(image, 5) || is_outline(image, 58));
  constexpr uint32_t kOne[] = {3, 3};
  const Image one = drawn(0, kLight, kOne);
  EXPECT_FALSE(is_outline(one, 59) || is_outline(one, 60));
  EXPECT_TRUE(is_outline(one, 4));
}

TEST(SectionHatch, IsSeenOnDarkFacesAndLeavesTheRest) {
  const Image image = drawn(0, kDark);
  EXPECT_GT(at(image, 60, 60)[0], 200);
  for (uint32_t y = 0; y < kSide_px; ++y) {
    for (uint32_t x = 0; x < kSide_px; ++x) {
      if (x < 4 || y < 4) {
        EXPECT_EQ(at(image, x, y), kDark);
      }
      EXPECT_GE(at(image, x, y)[0], kDark[0]);
    }
  }
}

TEST(SectionHatch, LinesAreAsFaintAsTheFaceThatTheyAreOn) {
  const Image opaque = drawn(0);
  Image image = picture(0, kLight);
  image.shares.emplace();
  for (uint32_t i = 0; i < image.id.size(); ++i) {
    if (image.id[i] != 7) image.shares->push_back({i, image.id[i], 0.25f});
    image.shares->push_back({i, csgcore::kNoPrimitive, 0.5f});
  }
  image.id.assign(image.id.size(), 7);  // what is behind it all
  draw_section_faces(image, view_at(0), kPlane, kTwoParts, hatch_spacing(view_at(0), 1));
  for (size_t i = 0; i < image.rgb.size(); ++i) {
    ASSERT_NEAR(image.rgb[i][0], kLight[0] + (opaque.rgb[i][0] - kLight[0]) / 4.0, 1) << i;
  }
}

/// Coarse pictures and planes that are seen from far away are no moiré.
TEST(SectionHatch, LinesThatAreTooFineAreAnEvenShade) {
  Image image = picture(0, kLight);
  draw_section_faces(image, view_at(0), kPlane, kTwoParts, 0.02);
  const Color& inside = at(image, 30, 30);
  EXPECT_LT(inside[0], kLight[0]);
  for (uint32_t y = 10; y < 110; ++y) {
    for (uint32_t x = 10; x < 50; ++x) EXPECT_EQ(at(image, x, y), inside);
  }
}

TEST(SectionHatch, TheSpacingIsAPowerOfTwoOfAFewPixels) {
  for (const double zoom : {0.001, 0.7, 1.0, 3.3, 1e6}) {
    csgcore::View view = view_at(0);
    view.half_height *= zoom;
    const double spacing = hatch_spacing(view, 1);
    EXPECT_EQ(std::exp2(std::round(std::log2(spacing))), spacing);
    EXPECT_GE(spacing / (0.25 * zoom), 6);
    EXPECT_LE(spacing / (0.25 * zoom), 13);
  }
}

}  // namespace
}  // namespace window
