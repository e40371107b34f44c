// Tests the layers of a picture, by every renderer: what shines through, what hides what, and the
// colours of faces (frontend/OPENSCAD.md, "Translucency"). The designs stand under an eye that
// looks down along -z, so that every face that is seen has the same light.
#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "frontend/camera.hpp"
#include "frontend/error.hpp"
#include "frontend/importer.hpp"
#include "frontend/parser.hpp"
#include "frontend/render.hpp"
#include "frontend/render_settings.hpp"

namespace frontend {
namespace {

using csgcore::Image;
using csgcore::Vec3;

struct Way {
  RendererKind renderer;
  Technique technique;
};

using Color = std::array<double, 3>;  // 0…255

constexpr Color kPaper{255, 255, 229}, kFront{249, 215, 44}, kBack{157, 203, 81};
constexpr Color kRed{255, 0, 0}, kBlue{0, 0, 255};
constexpr Color kBackground{180, 180, 180}, kHighlight{255, 81, 81};
constexpr double kHalf = 128 / 255.0;  // the alpha of `%` and `#` parts

/// A face that looks at the eye, or away from it.
Color lit(const Color& color) {
  const double shade = 0.2 + 1 / std::sqrt(3);
  return {std::min(255.0, shade * color[0]), std::min(255.0, shade * color[1]),
          std::min(255.0, shade * color[2])};
}

Color over(const Color& below, const Color& above, double alpha) {
  Color result;
  for (size_t i = 0; i < 3; ++i) result[i] = below[i] + alpha * (above[i] - below[i]);
  return result;
}

std::string moved(double x, double y, double z, const std::string& text) {
  return "multmatrix([[1,0,0," + std::to_string(x) + "],[0,1,0," + std::to_string(y) + "],[0,0,1," +
         std::to_string(z) + "],[0,0,0,1]]) {" + text + "}";
}

const std::string kCube = "cube(size = 10, center = true);";
const std::string kSmallCube = "cube(size = 4, center = true);";
const std::string kTall = "cube(size = [4, 4, 40], center = true);";  // goes through kCube

std::string colored(const std::string& color, const std::string& text) {
  return "color(" + color + ") {" + text + "}";
}

class Layers : public testing::TestWithParam<Way> {
 protected:
  Layers() {
    settings_.scheme = color_schemes().front();
    settings_.renderer = GetParam().renderer;
    settings_.technique = GetParam().technique;
  }

  void SetUp() override {
    try {
      draw(kCube);
    } catch (const Error&) {
      GTEST_SKIP() << "no OpenGL";
    }
  }

  Image draw(const std::string& text, double eye_height = 100) {
    const ImportedDesign design = import_design(parse(text, "a.csg"), import_);
    CameraOptions camera;
    camera.width_px = camera.height_px = 33;  // with a pixel in the middle
    camera.projection = csgcore::Projection::kPerspective;
    camera.camera = Camera{};
    camera.camera->target = Vec3(0, 0, eye_height - 1);
    camera.camera->rotation_deg = Vec3(0);
    camera.camera->distance = 1;
    return render(design.scene, make_view(*camera.camera, camera), settings_, stats_);
  }

  /// What the middle of the picture shows.
  void expect_middle(const std::string& text, const Color& wanted, double eye_height = 100) {
    const Image image = draw(text, eye_height);
    const auto& pixel = image.rgb[16 * 33 + 16];
    for (size_t i = 0; i < 3; ++i) {
      EXPECT_NEAR(pixel[i], wanted[i], 2) << text << " channel " << i;  // rounded layer by layer
    }
  }

  ImportOptions import_;
  RenderSettings settings_;
  RenderStats stats_;
};

const std::string kRedGlass = "[1, 0, 0, 0.5]";

TEST_P(Layers, OneTranslucentLeafHasTwo) {
  const Color once = over(kPaper, lit(kRed), 0.5);
  expect_middle(colored(kRedGlass, kCube), over(once, lit(kRed), 0.5));
}

TEST_P(Layers, ADifferenceHasOne) {
  expect_middle("difference() {" + colored(kRedGlass, kCube) + moved(4, 4, 0, kSmallCube) + "}",
                over(kPaper, lit(kRed), 0.5));
}

TEST_P(Layers, TheColorsAlphaIsTheSchemesColorThere) {
  const Color once = over(kPaper, lit(kFront), 0.25);
  expect_middle(colored("[-1, -1, -1, 0.25]", kCube), over(once, lit(kFront), 0.25));
}

TEST_P(Layers, WhatComesLaterIsHiddenBehindWhatIsTranslucent) {
  const Color glass = over(over(kPaper, lit(kRed), 0.5), lit(kRed), 0.5);
  expect_middle(colored(kRedGlass, kCube) + moved(0, 0, -20, kCube), glass);
}

TEST_P(Layers, WhatComesEarlierShinesThrough) {
  const Color glass = over(over(lit(kFront), lit(kRed), 0.5), lit(kRed), 0.5);
  expect_middle(moved(0, 0, -20, kCube) + colored(kRedGlass, kCube), glass);
}

TEST_P(Layers, WhatIsBehindAnEarlierFaceIsNotDrawn) {
  // The far side of the glass lies within the body.
  expect_middle(moved(0, 0, -2, kCube) + colored(kRedGlass, kCube),
                over(lit(kFront), lit(kRed), 0.5));
  expect_middle(moved(0, 0, 20, kCube) + colored(kRedGlass, kCube), lit(kFront));
}

TEST_P(Layers, ATranslucentCutFaceHasItsOwnAlpha) {
  const std::string hole = colored("[0, 0, 1, 0.25]", moved(0, 0, 4, kSmallCube));
  expect_middle("difference() {" + kCube + hole + "}", over(kPaper, lit(kBlue), 0.25));
}

TEST_P(Layers, AlphaZeroHidesWhatComesLater) {
  const std::string hole = colored("[0, 0, 1, 0]", moved(0, 0, 4, kSmallCube));
  expect_middle("difference() {" + kCube + hole + "}" + moved(0, 0, -20, kCube), kPaper);
  expect_middle(colored("[1, 0, 0, 0]", kCube) + moved(0, 0, -20, kCube), kPaper);
}

TEST_P(Layers, ByDepthAllAreSeenWhateverTheFilesOrder) {
  settings_.translucency = Translucency::kDepth;
  const std::string low = colored(kRedGlass, moved(0, 0, -10, kCube));
  const std::string high = colored("[0, 0, 1, 0.25]", moved(0, 0, 10, kCube));
  const Color red = over(over(kPaper, lit(kRed), 0.5), lit(kRed), 0.5);
  const Color both = over(over(red, lit(kBlue), 0.25), lit(kBlue), 0.25);
  expect_middle(low + high, both);
  expect_middle(high + low, both);
  expect_middle(colored("[1, 1, 1, 0]", moved(0, 0, 30, kCube)) + high + low, both);
  expect_middle(high + kCube + low, over(over(lit(kFront), lit(kBlue), 0.25), lit(kBlue), 0.25));
}

TEST_P(Layers, OfCoincidentFacesTheLaterIsDrawn) {
  const Color red = over(over(kPaper, lit(kRed), 0.5), lit(kRed), 0.5);
  expect_middle(colored(kRedGlass, kCube) + kCube, lit(kFront));
  // The far side of the later one lies behind the near side of the earlier.
  expect_middle(colored(kRedGlass, kCube) + colored("[0, 0, 1, 0.5]", kCube),
                over(red, lit(kBlue), 0.5));
}

TEST_P(Layers, BackgroundPartsHaveTheirGreyOrTheirColor) {
  const Color once = over(kPaper, lit(kBackground), kHalf);
  expect_middle("%" + kCube, over(once, lit(kBackground), kHalf));
  expect_middle("%difference() {" + kCube + moved(4, 4, 0, kSmallCube) + "}", once);
  expect_middle("%" + colored("[1, 0, 0, 1]", kCube), lit(kRed));
  // The cut faces of a `%` part have no colour of the scheme's.
  expect_middle("%difference() {" + kCube + moved(0, 0, 4, kSmallCube) + "}", once);
}

TEST_P(Layers, AHighlightLiesOverItsOwnBody) {
  expect_middle("#" + kCube, over(lit(kFront), lit(kHighlight), kHalf));
  expect_middle("#" + colored("[0, 0, 1, 1]", kCube), over(lit(kBlue), lit(kHighlight), kHalf));
  // Beside a sibling it is translucent only.
  const Color once = over(kPaper, lit(kHighlight), kHalf);
  expect_middle("#" + kCube + moved(100, 0, 0, kCube), over(once, lit(kHighlight), kHalf));
}

TEST_P(Layers, OperandsOfAHighlightHaveItsColorAndThoseOfTheModelTheirOwn) {
  // A plug in a hole is flush with the face around it, which is blended over the plug, too. The
  // model and the `#` part both have this face.
  const std::string plug = moved(0, 0, 2, "cube(size = [2, 2, 4], center = true);");
  const std::string face = colored(kRedGlass, "cube(size = 8, center = true);");
  const std::string glass = "#difference() {" + face + kTall + "}";
  const std::string all = "cube(size = 30, center = true);";
  const Color once = over(lit(kFront), lit(kRed), 0.5);
  expect_middle(plug + "difference() {" + kCube + "difference() {" + all + glass + "}}",
                over(once, lit(kHighlight), kHalf));
}

TEST_P(Layers, BackgroundPartsAreDrawnBeforeHighlights) {
  const Color grey = over(over(kPaper, lit(kBackground), kHalf), lit(kBackground), kHalf);
  const Color red = over(over(grey, lit(kHighlight), kHalf), lit(kHighlight), kHalf);
  expect_middle("#" + moved(0, 0, 20, kCube) + "%" + kCube + moved(100, 0, 0, kCube), red);
  // In front of the highlight, which hides nothing that was drawn before.
  expect_middle("%" + moved(0, 0, 20, kCube) + "#" + kCube + moved(100, 0, 0, kCube), grey);
}

TEST_P(Layers, ACompoundLeafHasNoCutFacesOfItsOwn) {
  const std::string with_hole = "difference() {" + kCube + moved(0, 0, 4, kSmallCube) + "}";
  expect_middle(with_hole, lit(kBack));
  expect_middle("render() {" + with_hole + "}", lit(kFront));
  expect_middle("difference() { " + moved(0, 0, -2, kCube) + "render() { difference() {" + kTall +
                    moved(0, 0, -22, kTall) + "} } }",
                lit(kBack));
  import_.picture = PictureKind::kRendered;
  expect_middle("render() {" + with_hole + "}", lit(kBack));
}

TEST_P(Layers, ChannelsAreMeasuredOfTheModelWhateverIsTranslucent) {
  settings_.measured_channels = true;
  const Image image =
      draw(colored(kRedGlass, kCube) + moved(0, 0, 20, kCube) + "%" + moved(0, 0, 40, kCube));
  EXPECT_NEAR(image.z[16 * 33 + 16], 75, 1e-4);
  EXPECT_EQ(image.id[16 * 33 + 16], 1u);
  EXPECT_EQ(image.id[0], csgcore::kNoPrimitive);
}

TEST_P(Layers, AColorMayBeBrighterThanWhite) {
  expect_middle(colored("[2, 0.5, 0, 1]", kCube), lit({510, 127.5, 0}));
}

TEST_P(Layers, TheThrownTogetherPictureShowsLeavesWhole) {
  import_.picture = PictureKind::kThrownTogether;
  settings_.from_within = Rgb{255, 0, 255};
  expect_middle("difference() {" + kCube + kTall + "}", lit(kBack));
  expect_middle("intersection() {" + kCube + kTall + "}", lit(kFront));
  expect_middle("difference() {" + colored(kRedGlass, kCube) + kSmallCube + "}",
                over(kPaper, lit(kRed), 0.5));
  expect_middle(kCube, lit({255, 0, 255}), 1);  // from within
}

TEST_P(Layers, FromWithinFacesHaveTheFrontColorInAPreview) { expect_middle(kCube, lit(kFront), 1); }

TEST_P(Layers, FromWithinALeafOthersAreSeen) {
  constexpr double kWithin = 4;  // kCube, above kSmallCube
  const std::string blue = colored("[0, 0, 1, 1]", kSmallCube);
  const std::string aside = moved(4, 4, 0, kSmallCube);
  expect_middle(kCube + blue, lit(kBlue), kWithin);
  expect_middle(blue + kCube + aside, lit(kBlue), kWithin);
  expect_middle("difference() { union() {" + kCube + blue + "}" + aside + "}", lit(kBlue), kWithin);
  // From within both, the nearer face is seen.
  expect_middle(colored("[0, 0, 1, 1]", moved(0, 0, 1, kTall)) + kCube, lit(kFront), kWithin);
  // Of coincident faces the later one is.
  expect_middle(kCube + colored("[0, 0, 1, 1]", moved(0, 0, -10, kCube)), lit(kBlue), kWithin);
  // A part that is drawn over them makes no difference.
  expect_middle(kCube + blue + "#" + moved(4, 4, 0, kSmallCube), lit(kBlue), kWithin);
  // A leaf that is made of several solids is seen as a whole.
  settings_.from_within = Rgb{255, 0, 255};
  expect_middle(kCube + kSmallCube, lit(kFront), kWithin);
  expect_middle("render() {" + kCube + kSmallCube + "}" + moved(100, 0, 0, kCube),
                lit({255, 0, 255}), kWithin);
  import_.picture = PictureKind::kRendered;
  expect_middle(kCube + kSmallCube, lit({255, 0, 255}), kWithin);
}

TEST_P(Layers, FromWithinALeafOthersAreSeenThrownTogether) {
  import_.picture = PictureKind::kThrownTogether;
  settings_.from_within = Rgb{255, 0, 255};
  constexpr double kWithin = 4;
  expect_middle(kCube + kSmallCube, lit(kFront), kWithin);
  expect_middle("difference() {" + kCube + kSmallCube + "}", lit(kBack), kWithin);
  expect_middle("difference() {" + kSmallCube + kCube + "}", lit(kFront), kWithin);
  expect_middle("render() {" + kCube + kSmallCube + "}", lit({255, 0, 255}), kWithin);
  // What is opaque is drawn at once, between what is translucent.
  expect_middle(kCube + kSmallCube + colored(kRedGlass, moved(100, 0, 0, kCube)), lit(kFront),
                kWithin);
}

TEST_P(Layers, EdgesOfTranslucentPartsAreSmooth) {
  const std::string glass = colored(kRedGlass, moved(6.3, 0, 0, kCube));
  const auto greens = [&](uint32_t samples) {
    settings_.samples = samples;
    const Image image = draw(glass);
    std::set<uint8_t> result;
    for (size_t x = 0; x < 33; ++x) result.insert(image.rgb[16 * 33 + x][1]);
    return result.size();
  };
  EXPECT_GT(greens(16), greens(1));
  settings_.samples = 16;
  expect_middle(colored(kRedGlass, kCube), over(over(kPaper, lit(kRed), 0.5), lit(kRed), 0.5));
}

TEST_P(Layers, ManyLayersAreDrawnWhereTheyAre) {
  std::string text;
  for (int i = -3; i <= 3; ++i) {
    for (int j = -3; j <= 3; ++j) text += moved(12 * i, 12 * j, 0, colored(kRedGlass, kCube));
  }
  const Image image = draw(text);
  const Color glass = over(over(kPaper, lit(kRed), 0.5), lit(kRed), 0.5);
  EXPECT_NEAR(image.rgb[16 * 33 + 16][1], glass[1], 2);
  EXPECT_NEAR(image.rgb[16 * 33 + 16 + 5][1], kPaper[1], 0) << "between two cubes";
}

/// By pixel, the red light of a picture whose background is black or white, less than the other's.
std::vector<double> share_by_color(const Image& black, const Image& white) {
  std::vector<double> shares;
  for (size_t i = 0; i < black.rgb.size(); ++i) {
    shares.push_back((white.rgb[i][0] - black.rgb[i][0]) / 255.0);
  }
  return shares;
}

TEST_P(Layers, TellWhatIsSeenOfTheBackground) {
  const std::string designs[] = {
      "%" + kCube, moved(3, 2, -20, kCube) + "#" + kCube + "%" + moved(-4, 3, 9, kCube),
      colored("[1, 0, 0, 0.25]", kCube) + moved(0, 4, -20, colored(kRedGlass, kCube)) + kSmallCube,
      colored("[1, 0, 0, 0]", kCube) + moved(4, 4, -20, kCube),
      "difference() {" + kCube + colored(kRedGlass, kTall) + "}"};
  for (const Translucency order : {Translucency::kFile, Translucency::kDepth}) {
    for (const bool is_studio : {false, true}) {
      for (const std::string& design : designs) {
        SCOPED_TRACE(design + (is_studio ? " in the studio" : ""));
        settings_ = {};
        settings_.renderer = GetParam().renderer;
        settings_.technique = GetParam().technique;
        settings_.translucency = order;
        if (is_studio) {
          // Four rays a pixel, and nothing that changes the colours.
          settings_.shading = Shading::kStudio;
          settings_.studio.shadows = settings_.studio.occlusion = 0;
          settings_.studio.edges = 1e-9;
          settings_.samples = 4;
        }
        settings_.scheme.background = {0, 0, 0};
        const Image black = draw(design);
        EXPECT_FALSE(black.shares);
        settings_.scheme.background = {255, 255, 255};
        settings_.shares_from = csgcore::kNoPrimitive;
        const Image white = draw(design);
        ASSERT_TRUE(white.shares);
        std::vector<double> shares(white.rgb.size());
        for (const csgcore::PixelShare& seen : *white.shares) {
          EXPECT_EQ(seen.id, csgcore::kNoPrimitive);
          EXPECT_EQ(shares.at(seen.pixel), 0);
          shares[seen.pixel] = seen.share;
        }
        const std::vector<double> wanted = share_by_color(black, white);
        for (size_t i = 0; i < wanted.size(); ++i) {
          ASSERT_NEAR(shares[i], wanted[i], 3 / 255.0) << i;  // rounded layer by layer
        }
      }
    }
  }
}

TEST_P(Layers, TellWhatIsSeenOfSurfaces) {
  settings_.shares_from = 0;
  for (const Translucency order : {Translucency::kFile, Translucency::kDepth}) {
    settings_.translucency = order;
    const Image image = draw(moved(0, 0, -20, kCube) + "%" + kCube +
                             moved(0, 0, 20, colored("[1, 0, 0, 0.25]", kSmallCube)));
    ASSERT_TRUE(image.shares);
    std::vector<double> sums(image.rgb.size());
    std::vector<double> middle;
    for (const csgcore::PixelShare& seen : *image.shares) {
      sums.at(seen.pixel) += seen.share;
      if (seen.pixel == 16 * 33 + 16) middle.push_back(seen.share);
    }
    EXPECT_THAT(sums, testing::Each(testing::DoubleNear(1, 1e-6)));
    // Both sides of the small cube, both of the `%` part, which the file's order draws behind that
    // not at all, and the solid.
    const double red = 0.75 * 0.75;
    const double grey = order == Translucency::kFile ? 1 : (1 - kHalf) * (1 - kHalf);
    std::vector<double> wanted{1 - red, red * grey};
    if (grey < 1) wanted.push_back(red * (1 - grey));
    EXPECT_THAT(middle, testing::UnorderedPointwise(testing::DoubleNear(1e-6), wanted));
  }
}

std::string name_of(const testing::TestParamInfo<Way>& info) {
  return std::string(info.param.renderer == RendererKind::kGl ? "Gl" : "Cpu") +
         (info.param.technique == Technique::kTiles ? "Tiles" : "Cells");
}

INSTANTIATE_TEST_SUITE_P(, Layers,
                         testing::Values(Way{RendererKind::kCpu, Technique::kTiles},
                                         Way{RendererKind::kCpu, Technique::kCells},
                                         Way{RendererKind::kGl, Technique::kCells},
                                         Way{RendererKind::kGl, Technique::kTiles}),
                         name_of);

}  // namespace
}  // namespace frontend
