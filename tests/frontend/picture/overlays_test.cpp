// Tests --view against what OpenSCAD 2021.01 draws (read off its PNGs, 512×512, dist 20).
#include "frontend/overlays.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "frontend/importer.hpp"
#include "frontend/parser.hpp"
#include "frontend/render.hpp"

namespace frontend {
namespace {

using csgcore::Image;
using testing::ElementsAre;

constexpr Rgb kAxesColor{10, 20, 30};
constexpr Rgb kCrosshairColor{200, 20, 30};

class Overlay : public testing::Test {
 protected:
  Overlay() {
    camera_.rotation_deg = {0, 0, 0};
    camera_.distance = 20;
  }

  /// `z` is that of every pixel.
  Image draw(float z) {
    Image image;
    image.width_px = options_.width_px;
    image.height_px = options_.height_px;
    image.rgb.assign(image.width_px * image.height_px, {255, 255, 255});
    image.z.assign(image.rgb.size(), z);
    overlay(image);
    return image;
  }
  void overlay(Image& image) {
    ColorScheme scheme{};
    scheme.background = {254, 254, 254};
    scheme.axes = kAxesColor;
    scheme.crosshair = kCrosshairColor;
    draw_overlays(image, make_view(camera_, options_), camera_, overlays_, scheme, design_);
  }

  static char letter(const std::array<uint8_t, 3>& c) {
    if (c == std::array<uint8_t, 3>{255, 255, 255}) return '.';
    if (c == std::array<uint8_t, 3>{kAxesColor.r, kAxesColor.g, kAxesColor.b}) return '#';
    if (c == std::array<uint8_t, 3>{200, 20, 30}) return 'x';
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
  Overlays overlays_{.axes = true};
  ImportedDesign design_;
  static constexpr float kMiss = std::numeric_limits<float>::infinity();
};

TEST_F(Overlay, PositiveHalvesAreSolidAndNegativeOnesStippled) {
  const Image image = draw(kMiss);
  EXPECT_EQ(row(image, 256, 238, 276), "###...###...###.." + std::string(21, '#'))
      << "the stipple starts with 3 pixels off at the origin";
  EXPECT_EQ(column(image, 255, 246, 272), "###########..###...###...#");
  EXPECT_EQ(row(image, 256, 504, 512), "########") << "up to the edge";
}

TEST_F(Overlay, AxesReachAsFarAsTheDesignSays) {
  // The y axis goes away from the eye, towards its vanishing point.
  camera_.rotation_deg = {70, 0, 20};
  const auto pixels = [&] {
    const Image image = draw(kMiss);
    std::string all;
    for (uint32_t y = 0; y < image.height_px; ++y) all += row(image, y, 0, image.width_px);
    return std::count(all.begin(), all.end(), '#');
  };
  const auto near = pixels();
  design_.axes_reach = 100;
  EXPECT_GT(pixels(), near + 20);
}

TEST_F(Overlay, GnomonInTheCornerHasColorsAndLetters) {
  const Image image = draw(kMiss);
  EXPECT_EQ(row(image, 460, 48, 90), "...#" + std::string(27, 'r') + ".....##....");
  std::vector<std::string> rows;
  for (uint32_t y = 424; y < 434; ++y) rows.push_back(row(image, y, 47, 55));
  EXPECT_THAT(rows, ElementsAre(".#....#.", "..#..#..", "...##...", "...#....", "..#.....",
                                ".#......", "........", "........", "........", "....g..."));
  EXPECT_EQ(row(image, 458, 47, 90), ".######" + std::string(28, '.') + "#....#..");
  EXPECT_EQ(row(image, 464, 47, 55), ".######.");
}

TEST_F(Overlay, ModelHidesTheAxesButNotTheGnomon) {
  const Image hidden = draw(15);  // the axes' plane is 20 away
  EXPECT_EQ(row(hidden, 256, 300, 310), "..........");
  EXPECT_EQ(row(hidden, 460, 52, 60), "rrrrrrrr");
  const Image behind = draw(25);
  EXPECT_EQ(row(behind, 256, 300, 310), "##########");
  const Image coincident = draw(20);
  EXPECT_EQ(row(coincident, 256, 300, 310), "##########");
}

TEST_F(Overlay, AnAxisComesOutOfTheModelWhereItDoes) {
  // From the front, x to the right: the model's depth is 20 on the left half, 10 on the right.
  camera_.rotation_deg = {90, 0, 0};
  Image image = draw(kMiss);
  for (uint32_t y = 0; y < image.height_px; ++y) {
    for (uint32_t x = 0; x < image.width_px; ++x) {
      image.rgb[y * image.width_px + x] = {255, 255, 255};
      image.z[y * image.width_px + x] = x < 400 ? 21.0f : 10.0f;
    }
  }
  overlay(image);
  EXPECT_EQ(row(image, 256, 395, 405), "#####.....");
}

TEST_F(Overlay, DepthIsRightAlongAnObliqueAxis) {
  // The x axis comes towards the eye, to the right: at x it is at 20 − x·cos 45° from the eye's
  // plane.
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

TEST_F(Overlay, AVerticalAxisStandsInOneColumn) {
  // The axis is between two columns: rounding must not send it now to one, now to the other.
  for (const double tilt_deg : {50, 55, 61, 73}) {
    for (const double turn_deg : {20, 25, 31}) {
      camera_.rotation_deg = {tilt_deg, 0, turn_deg};
      EXPECT_EQ(column(draw(kMiss), 255, 0, 200), std::string(200, '#')) << tilt_deg << turn_deg;
    }
  }
}

TEST_F(Overlay, ScaleMarksAreOnBothHalvesOfAnAxisAndNumbered) {
  overlays_.scales = true;
  const Image image = draw(kMiss);
  // At distance 20 there is a mark at each 1; every tenth has double length, and every other is
  // numbered.
  EXPECT_EQ(column(image, 384, 257, 279), "####################..");
  EXPECT_EQ(column(image, 127, 257, 279), "..###...###...###.....") << "stippled";
  EXPECT_EQ(row(image, 265, 256, 400),
            std::string(64, '.') + '#' + std::string(63, '.') + '#' + std::string(15, '.'));
  std::vector<std::string> two;
  for (uint32_t y = 228; y < 252; y += 3) two.push_back(row(image, y, 377, 393));
  EXPECT_THAT(two, ElementsAre("................", ".............#..", ".............#..",
                               "..############..", "..#.............", "..#.............",
                               "..#.............", "..#............."));
  EXPECT_EQ(row(image, 237, 108, 136), "########.....############...") << "-2, not mirrored";
  EXPECT_EQ(row(image, 244, 108, 136), ".............#..............");
}

TEST_F(Overlay, ScaleMarksOfEverySize) {
  overlays_.scales = true;
  const auto marks = [&](double distance) {
    camera_.distance = distance;
    const std::string under = row(draw(kMiss), 265, 256, 512);
    return std::count(under.begin(), under.end(), '#');
  };
  EXPECT_EQ(marks(10), 1);  // 1
  EXPECT_EQ(marks(20), 3);
  EXPECT_EQ(marks(99), 19);
  EXPECT_EQ(marks(9.9e-5), 19);
  EXPECT_EQ(marks(9.9e20), 19);
  const auto is_numbered = [&](double distance) {
    camera_.distance = distance;
    const Image image = draw(kMiss);
    bool any = false;
    for (uint32_t x = 300; x < 500; ++x) any = any || letter(image.rgb[237 * 512 + x]) == '#';
    return any;
  };
  EXPECT_TRUE(is_numbered(29)) << "2 and 4";
  EXPECT_FALSE(is_numbered(31)) << "10 is outside of the picture";
  for (const double distance : {1e-310, 1e-300, 1e300}) marks(distance);
}

TEST_F(Overlay, ScaleMarksNeedTheAxes) {
  overlays_ = {.scales = true};
  const Image image = draw(kMiss);
  for (const auto& pixel : image.rgb) ASSERT_EQ(letter(pixel), '.');
}

TEST_F(Overlay, CrosshairsStayInTheMiddle) {
  overlays_ = {.crosshairs = true};
  for (const double x : {0, 3}) {
    camera_.target = {x, 0, 0};
    const Image image = draw(kMiss);
    EXPECT_EQ(row(image, 250, 245, 268), ".....x..........x......");
    EXPECT_EQ(row(image, 261, 245, 268), ".....x..........x......");
    // The diagonals of a cube with edges of a quarter of the distance.
    EXPECT_EQ(row(image, 73, 0, 82), std::string(73, '.') + "x........");
    EXPECT_EQ(row(image, 71, 0, 82), std::string(82, '.'));
  }
  EXPECT_EQ(row(draw(15), 255, 250, 260), "..........") << "the model is in front";
}

// 100×100 pixels, orthographic, 0.2 units a pixel, seen from above.
class Edges : public Overlay {
 protected:
  Edges() {
    options_.width_px = options_.height_px = 100;
    options_.projection = csgcore::Projection::kOrthographic;
    camera_.distance = 10 / std::tan(11.25 * 3.14159265358979 / 180);
    overlays_ = {.edges = true};
  }

  /// Returns 'e' where an edge is drawn, else '.'.
  std::vector<std::string> edges_of(const std::string& text) {
    RenderSettings settings;
    settings.measured_channels = true;
    settings.renderer = RendererKind::kCpu;
    RenderStats stats;
    const ImportedDesign design = import_design(parse(text, "a.csg"));
    Image image = render(design.scene, make_view(camera_, options_), settings, stats);
    image.rgb.assign(image.rgb.size(), {0, 0, 0});
    overlay(image);
    std::vector<std::string> rows;
    for (uint32_t y = 0; y < image.height_px; ++y) {
      rows.emplace_back();
      for (uint32_t x = 0; x < image.width_px; ++x) {
        rows.back() += image.rgb[y * image.width_px + x][0] == 0 ? '.' : 'e';
      }
    }
    return rows;
  }
  static std::ptrdiff_t count(const std::string& row) {
    return std::count(row.begin(), row.end(), 'e');
  }
};

TEST_F(Edges, OutlinesAreHalfWayToTheBackground) {
  const std::vector<std::string> rows = edges_of("cube(size = [10, 10, 2], center = true);");
  EXPECT_EQ(rows[24], std::string(100, '.'));
  EXPECT_EQ(rows[25], std::string(25, '.') + std::string(50, 'e') + std::string(25, '.'));
  EXPECT_EQ(rows[50],
            std::string(25, '.') + 'e' + std::string(48, '.') + 'e' + std::string(25, '.'));
  EXPECT_EQ(rows[74], rows[25]);
  EXPECT_EQ(rows[75], rows[24]);
}

TEST_F(Edges, StepsAreOutlinesOfWhatIsInFront) {
  const std::vector<std::string> rows = edges_of(
      "cube(size = [10, 10, 2], center = true);"
      "multmatrix([[1,0,0,0],[0,1,0,0],[0,0,1,0.01],[0,0,0,1]]) cube(size = [4, 4, 2], center = "
      "true);");
  EXPECT_EQ(rows[40], std::string(25, '.') + 'e' + std::string(14, '.') + std::string(20, 'e') +
                          std::string(14, '.') + 'e' + std::string(25, '.'));
  EXPECT_EQ(count(rows[50]), 4);
}

TEST_F(Edges, StepsBetweenParallelFacesAreSeenFromAside) {
  camera_.rotation_deg = {60, 0, 0};
  for (const auto projection :
       {csgcore::Projection::kOrthographic, csgcore::Projection::kPerspective}) {
    options_.projection = projection;
    const std::vector<std::string> rows = edges_of(
        "cube(size = [10, 10, 2], center = true);"
        "multmatrix([[1,0,0,0],[0,1,0,0],[0,0,1,1],[0,0,0,1]])"
        " cube(size = [4, 4, 2], center = true);");
    std::string middle;
    for (const std::string& row : rows) middle += row[50];
    // The plate's far edge, the block's far and near ones and its foot, the plate's near edges.
    EXPECT_EQ(count(middle), 6) << middle;
  }
}

TEST_F(Edges, NoneWhereASurfaceGoesOn) {
  // Two primitives whose faces lie in one plane, and a step too small to be seen.
  const std::vector<std::string> flush = edges_of(
      "cube(size = [10, 10, 2], center = true);"
      "multmatrix([[1,0,0,0],[0,1,0,3],[0,0,1,0],[0,0,0,1]]) cube(size = [4, 14, 2], center = "
      "true);");
  EXPECT_EQ(count(flush[50]), 2);
  // A ball has only its outline, however steep it becomes towards it; so have other round shapes.
  for (const char* round :
       {"sphere(r = 5);", "sphere(r = 0.9);",
        "multmatrix([[8,0,0,0],[0,3,0,0],[0,0,1,0],[0,0,0,1]]) { sphere(r = 1); }",
        "multmatrix([[1,0,0,0],[0,0,1,0],[0,-1,0,0],[0,0,0,1]])"
        " cylinder(h = 30, r = 4, center = true);"}) {
    for (const auto projection :
         {csgcore::Projection::kOrthographic, csgcore::Projection::kPerspective}) {
      options_.projection = projection;
      for (const std::string& row : edges_of(round)) {
        const std::size_t first = row.find('e');
        if (first == row.npos || count(row) <= 2) continue;
        // At its top and bottom the outline runs along the row.
        const std::string outline = row.substr(first, row.rfind('e') + 1 - first);
        EXPECT_EQ(row.find("e.e"), row.npos) << round << outline;
        EXPECT_LE(std::count(outline.begin(), outline.end(), '.') + 2 * count(row), 100) << round;
        const std::size_t gap = outline.find('.');
        if (gap == outline.npos) continue;
        EXPECT_EQ(outline.find('e', gap), outline.find_last_of('.') + 1) << round << outline;
      }
    }
  }
}

TEST_F(Edges, CreasesAreFoundInEitherProjection) {
  // A roof with its ridge along y: only its normal jumps there.
  const std::string roof =
      "multmatrix([[0.70710678,0,0.70710678,0],[0,1,0,0],[-0.70710678,0,0.70710678,0],[0,0,0,1]])"
      " cube(size = [5, 8, 5], center = true);";
  for (const auto projection :
       {csgcore::Projection::kOrthographic, csgcore::Projection::kPerspective}) {
    options_.projection = projection;
    EXPECT_EQ(count(edges_of(roof)[50]), 3);
    // A ball on a plate: two primitives.
    const std::vector<std::string> rows =
        edges_of("cube(size = [14, 14, 1], center = true); sphere(r = 3);");
    EXPECT_EQ(count(rows[50]), 4);
  }
}

TEST_F(Overlay, TheGridLiesOnTheGroundWhereNoSolidIsSeen) {
  // From above, 20 away: the picture is 2 · 20 · tan 11.25° = 7.96 units high.
  overlays_ = {.grid = true};
  EXPECT_EQ(grid_spacing(make_view(camera_, options_), camera_), 1);
  const Image image = draw(kMiss);
  const double unit_px = 512 / (2 * 20 * std::tan(11.25 * 3.14159265358979 / 180));
  const auto brightness = [&](double x, double y) {
    return image.rgb[static_cast<size_t>(y) * 512 + static_cast<size_t>(x)][0];
  };
  // Between the fainter lines, a tenth of a unit apart, but on a line of the other direction.
  for (const double y : {0.05, 1.05, -2.05}) {
    for (const int x : {-2, -1, 0, 1, 2}) {
      const double row = 256 - y * unit_px;
      const double on_line = brightness(256 + x * unit_px, row);
      EXPECT_LT(on_line, brightness(256 + (x + 0.05) * unit_px, row)) << x;
      EXPECT_LT(on_line, brightness(256 + (x + 0.1) * unit_px, row)) << "finer lines are fainter";
      EXPECT_GT(on_line, 255 * 0.7);
    }
  }
  EXPECT_EQ(draw(25).rgb[256 * 512 + 256], (std::array<uint8_t, 3>{255, 255, 255}));
}

TEST_F(Overlay, TheGridIsSeenThroughWhatIsTranslucentAsTheBackgroundIs) {
  overlays_ = {.grid = true};
  const Image open = draw(kMiss), hidden = draw(25);
  Image image = open;
  image.rgb.assign(open.rgb.size(), {90, 90, 90});
  image.z.assign(open.rgb.size(), 25);
  image.shares.emplace();
  for (uint32_t i = 0; i < open.rgb.size(); i += 2) {
    image.shares->push_back({i, 7, 0.5f});
    image.shares->push_back({i, csgcore::kNoPrimitive, 0.25f});
  }
  overlay(image);
  size_t lines = 0;
  for (size_t i = 0; i < open.rgb.size(); ++i) {
    const double wanted = i % 2 == 0 ? (open.rgb[i][0] - 255) / 4.0 : 0;
    lines += wanted < -5;
    ASSERT_NEAR(image.rgb[i][0] - 90, wanted, 1) << i;
  }
  EXPECT_GT(lines, 500u);
}

TEST_F(Overlay, TheGridOfACoarsePictureIsAsBright) {
  overlays_ = {.grid = true};
  const auto mean = [&](double line_px) {
    overlays_.grid_line_px = line_px;
    double sum = 0;
    const Image image = draw(kMiss);
    for (const auto& color : image.rgb) sum += color[0];
    return sum / static_cast<double>(image.rgb.size());
  };
  const double fine = mean(1);
  options_.width_px = options_.height_px = 128;
  EXPECT_NEAR(mean(0.25), fine, 1);
  EXPECT_LT(mean(1), fine - 1);
}

TEST_F(Overlay, TheGridEndsAtTheHorizon) {
  overlays_ = {.grid = true};
  camera_.rotation_deg = {80, 0, 30};
  const Image image = draw(kMiss);
  size_t above = 0, below = 0;
  for (size_t i = 0; i < image.rgb.size(); ++i) {
    (i < image.rgb.size() / 8 ? above : below) += image.rgb[i][0] != 255;
  }
  EXPECT_EQ(above, 0u);
  EXPECT_GT(below, 1000u);
}

TEST_F(Overlay, FarAwayAndTinyCamerasEnd) {
  overlays_ = {.axes = true, .crosshairs = true, .scales = true, .grid = true};
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
