// Tests the edges of OpenSCAD's meshes, which --view=edges draws (as OpenSCAD 2021.01's PNGs show
// them).
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "frontend/importer.hpp"
#include "frontend/overlays.hpp"
#include "frontend/parser.hpp"
#include "frontend/render.hpp"

namespace frontend {
namespace {

using csgcore::Image;

// 100×100 pixels, orthographic, 0.2 units a pixel, seen from above.
class FacetEdges : public testing::Test {
 protected:
  FacetEdges() {
    options_.width_px = options_.height_px = 100;
    options_.projection = csgcore::Projection::kOrthographic;
    camera_.rotation_deg = {0, 0, 0};
    camera_.distance = 10 / std::tan(11.25 * 3.14159265358979 / 180);
  }

  Image draw(const std::string& text, bool keeps_meshes = true) {
    ImportOptions import;
    import.keeps_meshes = keeps_meshes;
    const ImportedDesign design = import_design(parse(text, "a.csg"), import);
    RenderSettings settings;
    settings.measured_channels = true;
    settings.renderer = RendererKind::kCpu;
    RenderStats stats;
    const csgcore::View view = make_view(camera_, options_);
    Image image = render(design.scene, view, settings, stats);
    shaded_ = image.rgb;
    draw_overlays(image, view, camera_, {.edges = true}, settings.scheme, design);
    return image;
  }
  /// Returns a row of the picture with 'e' where an edge is drawn, else '.'.
  std::string row_of(const Image& image, uint32_t y) const {
    std::string row;
    for (std::size_t i = y * 100; i < (y + 1) * 100; ++i) {
      row += image.rgb[i] == shaded_[i] ? '.' : 'e';
    }
    return row;
  }
  /// Returns the columns of the row's pixels at which lines begin.
  std::vector<std::size_t> lines_of(const Image& image, uint32_t y) const {
    const std::string row = '.' + row_of(image, y);
    std::vector<std::size_t> starts;
    for (std::size_t i = 1; i < row.size(); ++i) {
      if (row[i] == 'e' && row[i - 1] == '.') starts.push_back(i - 1);
    }
    return starts;
  }
  static std::array<int, 3> color(const Image& image, std::size_t x, std::size_t y) {
    const auto& c = image.rgb[y * 100 + x];
    return {c[0], c[1], c[2]};
  }

  Camera camera_;
  CameraOptions options_;
  std::vector<std::array<uint8_t, 3>> shaded_;  // the picture before the edges
};

TEST_F(FacetEdges, FadeOutOnTheFacesBesideThem) {
  // The edge lies between two pixels: half a pixel from the first, one and a half from the next.
  const Image image = draw("cube(size = [10, 10, 2], center = true);");
  EXPECT_EQ(row_of(image, 24), std::string(100, '.')) << "nothing is drawn off the solid";
  EXPECT_EQ(row_of(image, 50),
            std::string(25, '.') + 'e' + std::string(48, '.') + 'e' + std::string(25, '.'));
  const std::array<int, 3> line = {252, 235, 149};  // half way from f9d72c to white
  const auto face = shaded_[50 * 100 + 50];
  const double t = 0.5 / 1.41;
  const double share = 1 - t * t * (3 - 2 * t);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(color(image, 25, 50)[i], face[i] + share * (line[i] - face[i]), 1);
  }
}

TEST_F(FacetEdges, AreWiderAslant) {
  const Image image = draw(
      "multmatrix([[0.70710678,-0.70710678,0,0],[0.70710678,0.70710678,0,0],[0,0,1,0],[0,0,0,1]])"
      " cube(size = [10, 10, 2], center = true);");
  const std::string row = row_of(image, 35);
  const std::size_t first = row.find('e');
  // At 45° the line fades out over 2 · 1.41 pixels of a row. The face begins at 29.14.
  EXPECT_EQ(first, 29u);
  EXPECT_EQ(row.find('.', first), 32u) << row;
}

TEST_F(FacetEdges, OfAPrimitivesFarSideAreHidden) {
  camera_.rotation_deg = {0, 30, 0};
  EXPECT_THAT(lines_of(draw("cube(size = 10, center = true);"), 50), testing::SizeIs(3));
}

TEST_F(FacetEdges, AreThoseOfTheMeshesAndNotOfTheSolid) {
  // A wedge rises through a plate's upper face: no line is drawn where the two meet.
  const char* text =
      "cube(size = [10, 10, 2], center = true);"
      "multmatrix([[0.8,0,0.6,0],[0,1,0,0],[-0.6,0,0.8,0],[0,0,0,1]])"
      " cube(size = [9, 9, 3], center = true);";
  const std::size_t with_crease = lines_of(draw(text, false), 50).size();
  EXPECT_EQ(lines_of(draw(text), 50).size() + 1, with_crease);
}

TEST_F(FacetEdges, DiagonalsCutTheSidesOfConesAndSpheres) {
  // Four sides seen from above: a line from the corner at i = 0 of the top to that at i = 1 of the
  // bottom, and so on.
  const auto lines_above = [&](const char* text) { return lines_of(draw(text), 35).size(); };
  EXPECT_EQ(lines_above("cylinder($fn = 4, h = 2, r1 = 8, r2 = 2, center = true);"), 4u)
      << "two sides of the outline, the upper corner's edge and one diagonal";
  EXPECT_EQ(lines_above("cylinder($fn = 4, h = 2, r1 = 8, r2 = 0, center = true);"), 3u)
      << "a cone's sides are triangles";
}

/// An L, from z = 0 to 2.
const std::string kStep =
    "polyhedron([[0,0,0],[6,0,0],[6,2,0],[2,2,0],[2,6,0],[0,6,0],[0,0,2],[6,0,2],[6,2,2],[2,2,2],"
    "[2,6,2],[0,6,2]], [[0,1,2,3,4,5],[11,10,9,8,7,6],[0,6,7,1],[1,7,8,2],[2,8,9,3],[3,9,10,4],"
    "[4,10,11,5],[5,11,6,0]]);";

TEST_F(FacetEdges, OfAMeshAreThoseOfItsTriangles) {
  // Row 45 is at y = 0.9: the outline, the line from (0, 0) to (2, 2), and that on to (6, 0).
  EXPECT_THAT(lines_of(draw(kStep), 45), testing::ElementsAre(50, 52, 67, 79));
  EXPECT_THAT(lines_of(draw(kStep), 55), testing::IsEmpty());
}

TEST_F(FacetEdges, OfAMeshHaveTheColorOfTheirFace) {
  const auto on_diagonal = [&](const std::string& text) { return color(draw(text), 54, 45); };
  EXPECT_EQ(on_diagonal(kStep), (std::array<int, 3>{252, 235, 150})) << "f9d72c";
  EXPECT_EQ(on_diagonal("difference() { cube([16, 16, 3], center = true); " + kStep + "}"),
            (std::array<int, 3>{206, 229, 168}))
      << "9dcb51";
}

TEST_F(FacetEdges, HaveTheColorOfTheirFace) {
  const Image hole = draw(
      "difference() { cube(size = [16, 16, 2], center = true);"
      " multmatrix([[1,0,0,0],[0,1,0,0],[0,0,1,1],[0,0,0,1]])"
      "  cylinder($fn = 4, h = 1, r1 = 1, r2 = 5, center = true);"
      " color([0, 0, 1, 1]) multmatrix([[1,0,0,7],[0,1,0,0],[0,0,1,1],[0,0,0,1]])"
      "  cylinder($fn = 4, h = 1, r1 = 1, r2 = 5, center = true); }");
  // The bottoms of the two pits are squares with corners 1 from their middle.
  EXPECT_EQ(color(hole, 50, 45), (std::array<int, 3>{206, 229, 168})) << "9dcb51";
  EXPECT_EQ(color(hole, 85, 45), (std::array<int, 3>{128, 128, 255}));
}

TEST_F(FacetEdges, SmoothPrimitivesHaveNone) {
  for (const char* text : {"sphere(r = 5);", "cylinder(h = 2, r1 = 5, r2 = 2, center = true);"}) {
    EXPECT_EQ(draw(text).rgb, draw(text, false).rgb) << text;
  }
  // A ball on a plate: its outline, where the two meet, and the plate's own edges.
  const Image image = draw("cube(size = [14, 14, 1], center = true); sphere(r = 3);");
  EXPECT_EQ(lines_of(image, 50).size(), 4u);
}

TEST_F(FacetEdges, LieOnTheirOwnPrimitiveAlone) {
  // Where two plates are flush, the one that stands last in the file is seen.
  const Image image =
      draw("cube(size = [10, 10, 2], center = true); cube(size = [4, 14, 2], center = true);");
  const std::string side = std::string(25, '.') + 'e' + std::string(14, '.') + 'e';
  EXPECT_EQ(row_of(image, 50),
            side + std::string(18, '.') + std::string(side.rbegin(), side.rend()));
}

TEST_F(FacetEdges, AreHiddenByOtherPrimitives) {
  const Image image = draw(
      "cube(size = [10, 10, 2], center = true);"
      "multmatrix([[1,0,0,0],[0,1,0,5],[0,0,1,2],[0,0,0,1]]) cube(size = [4, 4, 2], center = "
      "true);");
  // The plate's upper edge lies in row 25, under the block from column 40 to 60.
  EXPECT_EQ(row_of(image, 25).substr(25, 50),
            std::string(15, 'e') + 'e' + std::string(18, '.') + 'e' + std::string(15, 'e'));
}

/// Returns the contrast ratio of WCAG 2.2.
double contrast(const std::array<uint8_t, 3>& a, const std::array<uint8_t, 3>& b) {
  const auto luminance = [](const std::array<uint8_t, 3>& color) {
    const auto linear = [](uint8_t value) {
      const double share = value / 255.0;
      return share > 0.04045 ? std::pow((share + 0.055) / 1.055, 2.4) : share / 12.92;
    };
    return 0.2126 * linear(color[0]) + 0.7152 * linear(color[1]) + 0.0722 * linear(color[2]);
  };
  const double of_a = luminance(a) + 0.05, of_b = luminance(b) + 0.05;
  return std::max(of_a, of_b) / std::min(of_a, of_b);
}

TEST_F(FacetEdges, OfTheWindowAreSeenInEverySchemeAndLight) {
  // From the left: a cube that is turned about its vertical axis, a round post and a ball.
  const ImportedDesign design =
      import_design(parse("multmatrix([[0.8,-0.6,0,-6],[0.6,0.8,0,0],[0,0,1,0],[0,0,0,1]])"
                          " cube(size = [4, 4, 6], center = true);"
                          "cylinder(h = 6, r = 2, center = true);"
                          "multmatrix([[1,0,0,6],[0,1,0,0],[0,0,1,0],[0,0,0,1]]) sphere(r = 2);",
                          "a.csg"),
                    {.keeps_meshes = true});
  camera_.rotation_deg = {70, 0, 0};
  const csgcore::View view = make_view(camera_, options_);
  for (const ColorScheme& scheme : color_schemes()) {
    for (const Shading shading : {Shading::kOpenScad, Shading::kPhong, Shading::kStudio}) {
      SCOPED_TRACE(std::string(scheme.name) + ", " + std::to_string(static_cast<int>(shading)));
      RenderSettings settings;
      settings.measured_channels = true;
      settings.renderer = RendererKind::kCpu;
      settings.scheme = scheme;
      settings.shading = shading;
      settings.studio = {.shadows = 1, .occlusion = 1, .edges = 0, .directions = 64};
      RenderStats stats;
      Image image = render(design.scene, view, settings, stats);
      const auto below = image.rgb;
      Overlays overlays{.edges = true, .edge_color = EdgeColor::kContrast};
      draw_overlays(image, view, camera_, overlays, scheme, design);
      const auto is_clear = [&](std::size_t i) { return contrast(image.rgb[i], below[i]) >= 3; };
      std::string middle;
      for (std::size_t i = 50 * 100; i < 51 * 100; ++i) middle += is_clear(i) ? 'e' : '.';
      std::size_t lines = middle[0] == 'e';
      for (std::size_t i = 1; i < 100; ++i) lines += middle[i] == 'e' && middle[i - 1] == '.';
      EXPECT_EQ(lines, 7u) << middle << ": the cube has three edges, the others two outlines each";
    }
  }
}

}  // namespace
}  // namespace frontend
