// Tests the reader of SVG drawings. What OpenSCAD 2021.01 makes of the same files was looked at.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "drawings/drawing.hpp"
#include "plane/figure_area.hpp"

namespace frontend {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

std::string svg(const std::string& content, const std::string& attributes = "") {
  return "<svg xmlns=\"http://www.w3.org/2000/svg\" " + attributes + ">" + content + "</svg>";
}
std::string svg_path(const std::string& data) { return svg("<path d=\"" + data + "\"/>"); }

Drawing read_one(const std::string& text, const SvgSettings& settings = {}) {
  return read_svg(text, "a.svg", settings);
}
double filled_area(const std::string& text, const SvgSettings& settings = {}) {
  return area_of_union(read_one(text, settings).figures);
}

testing::AssertionResult has_box(const std::string& text, const Vec2& min, const Vec2& max,
                                 const SvgSettings& settings = {}) {
  Rectangle box;
  for (const Figure& figure : read_one(text, settings).figures) box.merge(bounds_of(figure));
  constexpr double kRounding = 1e-4;  // OpenSCAD's boxes, as they are given here
  const bool is_same =
      glm::length(box.min - min) < kRounding && glm::length(box.max - max) < kRounding;
  return is_same ? testing::AssertionSuccess()
                 : testing::AssertionFailure() << box.min.x << ", " << box.min.y << " to "
                                               << box.max.x << ", " << box.max.y;
}

const std::string kBar = "<rect x=\"1\" y=\"2\" width=\"10\" height=\"5\"/>";
const SvgSettings kFaceted{.is_faceted = true};

TEST(SvgPage, PlacesDrawingsByTheirSize) {
  EXPECT_TRUE(has_box(svg(kBar), {1, -7}, {11, -2}));
  EXPECT_TRUE(has_box(svg(kBar, "width=\"100\" height=\"50\""), {1, 10.6389}, {11, 15.6389}));
  EXPECT_TRUE(has_box(svg(kBar, "height=\"50\""), {1, 6.22917}, {11, 11.22917}, {.dpi = 96}));
  EXPECT_TRUE(has_box(svg(kBar, "height=\"50mm\""), {1, 43}, {11, 48}));
  EXPECT_TRUE(has_box(svg(kBar, "height=\"50 mm\""), {1, -7}, {11, -2}));
}

TEST(SvgPage, ScalesByTheViewBox) {
  EXPECT_TRUE(
      has_box(svg(kBar, "viewBox=\"0 0 20 10\""), {0.352778, 1.058333}, {3.880556, 2.822222}));
  EXPECT_TRUE(has_box(svg(kBar, "width=\"40mm\" viewBox=\"0,0,20,10\""), {16.825, 1.058333},
                      {20.352778, 2.822222}));
  EXPECT_TRUE(
      has_box(svg(kBar, "width=\"100%\" viewBox=\"5 0 20 10\" height=\"50%\""), {-4, 3}, {6, 8}));
  EXPECT_TRUE(has_box(svg(kBar, "width=\"4pc\" height=\"2.5cm\" viewBox=\"0 0 20 10\""),
                      {0.846667, 10.806667}, {9.313333, 15.04}));
  const std::string wide =
      "width=\"40mm\" height=\"10mm\" viewBox=\"0 0 20 10\" preserveAspectRatio=";
  EXPECT_TRUE(has_box(svg(kBar, wide + "\"none\""), {2, 3}, {22, 8}));
  EXPECT_TRUE(has_box(svg(kBar, wide + "\"xMaxYMin meet\""), {21, 3}, {31, 8}));
  EXPECT_TRUE(has_box(svg(kBar, wide + "\"xMinYMin slice\""), {2, -4}, {22, 6}));
  EXPECT_TRUE(has_box(svg(kBar, "viewBox=\"0 0 20\""), {1, -7}, {11, -2}));
}

TEST(SvgPage, CentresDrawings) {
  EXPECT_TRUE(has_box(svg(kBar), {-5, -2.5}, {5, 2.5}, {.is_centered = true}));
  // OpenSCAD's middle is the view box's corner, mirrored.
  EXPECT_TRUE(has_box(svg(kBar, "width=\"40mm\" height=\"20mm\" viewBox=\"5 1 20 10\""), {-20, -7},
                      {0, 3}, {.is_centered = true}));
}

TEST(SvgShapes, AreUnited) {
  EXPECT_NEAR(filled_area(svg(
                  "<rect width=\"10\" height=\"10\"/><rect x=\"5\" width=\"10\" height=\"10\"/>")),
              150, 1e-6);
  EXPECT_NEAR(filled_area(svg("<circle cx=\"1\" cy=\"2\" r=\"3\"/>")), 9 * kPi,
              9 * kPi * kChordsShare);
  EXPECT_TRUE(std::holds_alternative<Disc>(read_one(svg("<circle r=\"3\"/>")).figures.front()));
  EXPECT_THAT(chords_of(read_one(svg("<circle r=\"3\"/>"), kFaceted).figures.front()),
              ElementsAre(SizeIs(40)));
  EXPECT_NEAR(filled_area(svg("<ellipse rx=\"3\" ry=\"2\"/>")), 6 * kPi, 6 * kPi * kChordsShare);
  EXPECT_NEAR(filled_area(svg("<polygon points=\"0,0 10 0 10,10 5\"/>")), 50, 1e-6);
  const double round_corners = (4 - kPi) * 4;
  EXPECT_NEAR(filled_area(svg("<rect width=\"10\" height=\"5\" rx=\"2\"/>")), 50 - round_corners,
              1e-2);
  EXPECT_THAT(read_one(svg("<rect width=\"10mm\" height=\"5\"/><circle/><use href=\"#a\"/><text/>"))
                  .figures,
              IsEmpty());
}

TEST(SvgShapes, OfDefinitionsAreHidden) {
  EXPECT_THAT(read_one(svg("<defs><g>" + kBar + "</g></defs>")).figures, IsEmpty());
  EXPECT_NEAR(filled_area(svg("<defs/><symbol>" + kBar + "</symbol>")), 50, 1e-6);
}

TEST(SvgShapes, AreMovedByGroups) {
  EXPECT_TRUE(has_box(svg("<g transform=\"translate(5,6) scale(2)\">" + kBar + "</g>"), {7, -20},
                      {27, -10}));
  EXPECT_TRUE(has_box(svg("<g transform=\"rotate(90,1,2)\">" + kBar + "</g>"), {-4, -12}, {1, -2}));
  EXPECT_TRUE(has_box(svg("<g transform=\"skewX(45)\">" + kBar + "</g>"), {3, -7}, {18, -2}));
  EXPECT_TRUE(
      has_box(svg("<g transform=\"matrix(1 2 3 4 5 6)\">" + kBar + "</g>"), {12, -56}, {37, -16}));
  EXPECT_TRUE(has_box(svg("<g transform=\"matrix(1 2 3) foo(1) rotate(90 5)\">" + kBar + "</g>"),
                      {1, -7}, {11, -2}));
  EXPECT_TRUE(has_box(svg("<a transform=\"scale(9)\">" + kBar + "</a>", "transform=\"scale(9)\""),
                      {1, -7}, {11, -2}));
  EXPECT_THAT(
      read_one(svg("<g transform=\"rotate(30) scale(1, 0) rotate(20)\">" + kBar + "</g>")).figures,
      IsEmpty());
  const Drawing ellipse = read_one(svg("<circle r=\"1\" transform=\"scale(3, 2)\"/>"));
  EXPECT_NEAR(area_of_union(ellipse.figures), 6 * kPi, 6 * kPi * kChordsShare);
}

TEST(SvgPath, HasLines) {
  EXPECT_NEAR(filled_area(svg_path("M0 0 H10 V10 z")), 50, 1e-6);
  EXPECT_NEAR(filled_area(svg_path("m0 0 10 0 0 10z m20 0 h5 v5z")), 62.5, 1e-6);
  EXPECT_NEAR(filled_area(svg_path("M0,0L10,0L1e1-5.5.5z")), 27.5, 1e-6);
  EXPECT_NEAR(filled_area(svg_path("M0 0 L10 0 L10 10 L0 10z M2 2 L2 8 L8 8 L8 2z")), 64, 1e-6);
  EXPECT_NEAR(filled_area(svg_path("M0 0 L10 0 10 10 X 5 5 L0 10 z")), 75, 1e-6);  // X counts as 0
  EXPECT_THAT(read_one(svg_path("M0 0")).figures, IsEmpty());
}

TEST(SvgPath, HasCurves) {
  EXPECT_NEAR(filled_area(svg_path("M0 0 Q5 10 10 0z")), 100.0 / 3, 1e-2);
  EXPECT_NEAR(filled_area(svg_path("M0 0 C0 10 10 10 10 0z")), 60, 1e-2);
  EXPECT_NEAR(filled_area(svg_path("M0 0 C0 10 10 10 10 0 S20 -10 20 0z")), 120, 1e-2);
  EXPECT_NEAR(filled_area(svg_path("M0 0 Q5 10 10 0 T20 0z")), 200.0 / 3, 1e-2);
  EXPECT_NEAR(filled_area(svg_path("M0 0 A5 5 0 0 0 10 0z")), 12.5 * kPi, 1e-2);
  EXPECT_TRUE(has_box(svg_path("M0 0 A5 5 0 0 0 10 0z"), {0, -5}, {10, 0}));
  EXPECT_TRUE(has_box(svg_path("M0 0 A1 1 0 0 1 10 0z"), {0, 0}, {10, 5}));
  EXPECT_NEAR(filled_area(svg_path("M0 0 A5 5 0 1 1 5 5z")), 25 * (0.75 * kPi + 0.5), 1e-2);
  const Figure faceted = read_one(svg_path("M0 0 A5 5 0 0 0 10 0z"), kFaceted).figures.front();
  EXPECT_THAT(chords_of(faceted), ElementsAre(SizeIs(15)));
}

TEST(SvgPath, HasLinesForArcsWithoutAngles) {
  EXPECT_NEAR(filled_area(svg_path("M0 0 A1e-320 1 0 0 0 10 0 V10z")), 50, 1e-6);
}

TEST(SvgPath, IsStrokedWhereItIsOpen) {
  EXPECT_NEAR(filled_area(svg_path("M0 0 L10 0")), 11, 1e-4);
  EXPECT_NEAR(filled_area(svg_path("M0 0 L10 0 L10 10 L0 0.05")), 50.25, 1e-6);
  // The last part is filled once another one was closed.
  EXPECT_NEAR(filled_area(svg_path("M0 0 L10 0 L10 10z M20 0 L30 0 L30 10")), 100, 1e-6);
}

/// A polyline whose lines nearly all cross each other.
std::string tangle(int points, const std::string& style) {
  std::string list;
  for (int i = 0; i < points; ++i) {
    list += std::to_string(i * 4603 % 9973) + ',' + std::to_string(i * 7001 % 9967) + ' ';
  }
  return svg("<polyline " + style + " points=\"" + list + "\"/>");
}

TEST(SvgStroke, TakesAsLongAsItsPath) {
  const std::string pen = "stroke-width=\"9\" ";
  for (const std::string& style :
       {pen + "stroke-linecap=\"round\" stroke-linejoin=\"round\"",
        pen + "stroke-linecap=\"butt\" stroke-linejoin=\"bevel\"", pen}) {
    for (const bool is_faceted : {false, true}) {
      const Drawing drawing = read_one(tangle(2000, style), {.is_faceted = is_faceted});
      EXPECT_THAT(drawing.problems, IsEmpty()) << style;
      ASSERT_THAT(drawing.figures, SizeIs(1)) << style;
      EXPECT_LT(std::get<Outline>(drawing.figures.front()).loops.front().size(), 20'000u) << style;
      const Drawing left_out = read_one(tangle(9000, style), {.is_faceted = is_faceted});
      EXPECT_THAT(left_out.figures, IsEmpty()) << style;
      ASSERT_THAT(left_out.problems, SizeIs(1)) << style;
      EXPECT_THAT(left_out.problems.front().what, HasSubstr("their edges cross too often"));
    }
  }
}

/// Clipper's, in steps of a grid.
TEST(SvgStroke, IsThatOfTheLibrary) {
  for (const std::string ends : {"butt", "square", "round"}) {
    for (const std::string corners : {"miter", "bevel", "round"}) {
      const std::string style = "stroke-width=\"400\" stroke-linecap=\"" + ends +
                                "\" stroke-linejoin=\"" + corners + "\"";
      const std::string text = tangle(12, style);
      EXPECT_NEAR(filled_area(text) / filled_area(text, kFaceted), 1, 2e-4) << style;
    }
  }
}

TEST(SvgStroke, HasWidthEndsAndCorners) {
  const auto line = [](const std::string& attributes) {
    return svg("<line x1=\"0\" y1=\"0\" x2=\"10\" y2=\"0\" " + attributes + "/>");
  };
  EXPECT_NEAR(filled_area(line("")), 11, 1e-4);
  EXPECT_NEAR(filled_area(line("stroke-width=\"3\" stroke-linecap=\"butt\"")), 30, 1e-4);
  EXPECT_NEAR(filled_area(line("style=\"fill:none;stroke-width:3;stroke-linecap:round\"")),
              30 + 2.25 * kPi, 1e-2);
  EXPECT_NEAR(filled_area(line("stroke-width=\"4\" style=\"stroke-width:3\"")), 56, 1e-4);
  EXPECT_NEAR(filled_area(line("stroke-width=\"3mm\"")), 11, 1e-4);
  const std::string bend = "<polyline points=\"0,0 10,0 10,10\" stroke-width=\"2\"";
  EXPECT_NEAR(filled_area(svg(bend + "/>")), 44, 1e-4);
  EXPECT_NEAR(filled_area(svg(bend + " stroke-linejoin=\"round\"/>")), 43 + kPi / 4, 1e-3);
  EXPECT_LT(filled_area(svg(bend + " stroke-linejoin=\"bevel\"/>")), 43.9);
  // It is drawn before it is scaled.
  EXPECT_NEAR(filled_area(svg("<line x2=\"10\" transform=\"scale(2, 1)\"/>")), 22, 1e-4);
}

TEST(Svg, SaysWhatItCannotRead) {
  const Drawing broken = read_one("<svg>" + kBar);
  EXPECT_THAT(broken.figures, IsEmpty());
  ASSERT_THAT(broken.problems, SizeIs(1));
  EXPECT_EQ(broken.problems.front().what, "Error parsing file 'a.svg'");
  EXPECT_THAT(read_one("").problems, IsEmpty());
  const Drawing part = read_one(svg("<circle cx=\"nan\" r=\"3\"/><line x2=\"1e300\"/>" + kBar));
  EXPECT_NEAR(area_of_union(part.figures), 50, 1e-6);
  ASSERT_THAT(part.problems, SizeIs(1));
  EXPECT_THAT(part.problems.front().what, HasSubstr("Range check failed"));
}

TEST(Svg, IsReadWithoutRecursion) {
  std::string text;
  constexpr int kDepth = 50000;
  for (int i = 0; i < kDepth; ++i) text += "<g>";
  text += kBar;
  for (int i = 0; i < kDepth; ++i) text += "</g>";
  EXPECT_NEAR(filled_area(svg(text)), 50, 1e-6);
}

// By 2026's rules: what OpenSCAD 2025.07.18 makes of the same files was looked at.

SvgSettings of_2026(const char* id = nullptr, const char* layer = nullptr) {
  SvgSettings settings{.language = language::LanguageVersion::k2026};
  if (id != nullptr) settings.id = id;
  if (layer != nullptr) settings.layer = layer;
  return settings;
}

TEST(Svg2026, DrawsUsesOfWhatIsDefinedBefore) {
  const std::string defs =
      "<defs><g transform=\"scale(9)\"><rect id=\"r\" x=\"10\" y=\"10\" width=\"30\" "
      "height=\"20\"/></g><text id=\"t\">x</text></defs>";
  EXPECT_TRUE(
      has_box(svg(defs + "<use href=\"#r\" x=\"5\" y=\"7\"/>"), {15, -37}, {45, -17}, of_2026()));
  EXPECT_TRUE(has_box(svg(defs + "<g transform=\"translate(1, 2)\"><use xlink:href=\"#r\" "
                                 "transform=\"scale(2)\" x=\"5\" y=\"7\"/></g>"),
                      {31, -76}, {91, -36}, of_2026()));
  for (const char* const use : {"<use href=\"#no\"/>", "<use/>", "<use href=\"#t\"/>",
                                "<use href=\"#r\" display=\"none\"/>"}) {
    EXPECT_THAT(read_one(svg(defs + use), of_2026()).figures, IsEmpty()) << use;
    EXPECT_THAT(read_one(svg(defs + use), of_2026()).problems, IsEmpty()) << use;
  }
  EXPECT_THAT(read_one(svg("<use href=\"#r\"/>" + defs), of_2026()).figures, IsEmpty());
  EXPECT_NEAR(
      filled_area(svg("<rect id=\"r\" width=\"3\" height=\"3\"/><use href=\"#r\" x=\"9\"/>"),
                  of_2026()),
      9, 1e-6);
  EXPECT_THAT(read_one(svg(defs + "<use href=\"#r\"/>")).figures, IsEmpty()) << "2021.01";
  const Drawing wrong = read_one(svg(defs + "<use id=\"u\" href=\"r\"/>"), of_2026());
  ASSERT_THAT(wrong.problems, SizeIs(1));
  EXPECT_THAT(wrong.problems[0].what, HasSubstr("Error in element type use with id: u"));
}

TEST(Svg2026, DrawsUsesOfUses) {
  EXPECT_TRUE(has_box(svg("<defs><rect id=\"a\" width=\"1\" height=\"1\"/><g id=\"b\"><use "
                          "href=\"#a\" x=\"10\"/></g></defs><use href=\"#b\" y=\"20\"/>"),
                      {10, -21}, {11, -20}, of_2026()));
  // What uses itself is drawn once.
  EXPECT_NEAR(filled_area(svg("<defs><g id=\"a\"><use href=\"#a\" x=\"5\"/><rect width=\"1\" "
                              "height=\"1\"/></g></defs><use href=\"#a\"/>"),
                          of_2026()),
              1, 1e-6);
  std::string laughs = "<rect id=\"l0\" width=\"1\" height=\"1\"/>";
  for (int level = 1; level < 40; ++level) {
    laughs += "<g id=\"l" + std::to_string(level) + "\">";
    for (int i = 0; i < 10; ++i) laughs += "<use href=\"#l" + std::to_string(level - 1) + "\"/>";
    laughs += "</g>";
  }
  const Drawing drawing =
      read_one(svg("<defs>" + laughs + "</defs><use href=\"#l39\"/>" + kBar), of_2026());
  ASSERT_FALSE(drawing.problems.empty());
  EXPECT_THAT(drawing.problems[0].what, HasSubstr("they draw too much"));
}

TEST(Svg2026, LeavesOutWhatIsNotDisplayed) {
  for (const char* const hidden :
       {"display=\"none\"", "style=\"display:none\"", "style=\"fill:red; display: none;\""}) {
    const std::string bar = "<rect width=\"3\" height=\"3\" " + std::string(hidden) + "/>";
    const std::string group = "<g " + std::string(hidden) + "><g>" + kBar + "</g></g>";
    EXPECT_THAT(read_one(svg(bar + group), of_2026()).figures, IsEmpty()) << hidden;
  }
  EXPECT_NEAR(filled_area(svg("<g display=\"none\">" + kBar + "</g>")), 50, 1e-6) << "2021.01";
  EXPECT_NEAR(filled_area(svg("<g visibility=\"hidden\">" + kBar + "</g>"), of_2026()), 50, 1e-6);
  EXPECT_NEAR(filled_area(svg("<a display=\"none\">" + kBar + "</a>"), of_2026()), 50, 1e-6);
}

TEST(Svg2026, DrawsTheElementsOfAnId) {
  const std::string text =
      svg("<g id=\"g\" transform=\"translate(5,0)\"><rect id=\"a\" width=\"3\" height=\"3\"/>"
          "<g id=\"h\" display=\"none\"><rect id=\"b\" x=\"9\" width=\"2\" height=\"2\"/></g></g>"
          "<rect id=\"a\" x=\"50\" width=\"5\" height=\"1\"/>"
          "<defs><rect id=\"d\" width=\"7\" height=\"1\"/></defs><use id=\"u\" href=\"#d\"/>");
  EXPECT_NEAR(filled_area(text, of_2026("a")), 14, 1e-6);
  EXPECT_NEAR(filled_area(text, of_2026("g")), 9, 1e-6);
  EXPECT_NEAR(filled_area(text, of_2026("h")), 4, 1e-6) << "it is shown if it is asked for";
  EXPECT_TRUE(has_box(text, {14, -2}, {16, 0}, of_2026("b")));
  EXPECT_NEAR(filled_area(text, of_2026("d")), 7, 1e-6);
  EXPECT_NEAR(filled_area(text, of_2026("u")), 7, 1e-6);
  SvgSettings centered = of_2026("b");
  centered.is_centered = true;
  EXPECT_TRUE(has_box(text, {-1, -1}, {1, 1}, centered));
  const Drawing none = read_one(text, of_2026("no"));
  EXPECT_THAT(none.figures, IsEmpty());
  ASSERT_THAT(none.problems, SizeIs(1));
  EXPECT_EQ(none.problems[0].what, "import() filter id = \"no\" did not match anything");
}

TEST(Svg2026, DrawsLayersOfInkscape) {
  const std::string layer = "<g inkscape:groupmode=\"layer\" inkscape:label=";
  const std::string text =
      svg(layer + "\"L1\" display=\"none\"><rect id=\"a\" width=\"3\" height=\"3\"/>" + layer +
          "\"L2\"><rect x=\"9\" width=\"2\" height=\"2\"/></g></g><g inkscape:label=\"L3\">" +
          kBar + "</g><rect id=\"a\" width=\"90\" height=\"9\"/>");
  EXPECT_NEAR(filled_area(text, of_2026(nullptr, "L1")), 13, 1e-6);
  EXPECT_NEAR(filled_area(text, of_2026(nullptr, "L2")), 4, 1e-6);
  EXPECT_NEAR(filled_area(text, of_2026("a", "L1")), 9, 1e-6);
  EXPECT_THAT(read_one(text, of_2026(nullptr, "L3")).figures, IsEmpty()) << "it is no layer";
  const Drawing none = read_one(text, of_2026("a", "L2"));
  ASSERT_THAT(none.problems, SizeIs(1));
  EXPECT_EQ(none.problems[0].what,
            "import() filter id = \"a\", layer = \"L2\" did not match anything");
}

TEST(Svg2026, HasPagesInPercent) {
  EXPECT_TRUE(has_box(svg(kBar, "width=\"50%\" height=\"50 %\" viewBox=\"0 0 100 100\""),
                      {0.176389, 16.404167}, {1.940278, 17.286111}, of_2026()));
  EXPECT_TRUE(has_box(svg(kBar, "width=\"20mm\" height=\"50 mm\""), {1, 43}, {11, 48}, of_2026()));
  // The view box's corner has the same share.
  EXPECT_TRUE(has_box(svg(kBar, "width=\"50%\" height=\"100%\" viewBox=\"5 0 200 100\""),
                      {-0.75, 71.5}, {4.25, 74},
                      {.dpi = 25.4, .language = language::LanguageVersion::k2026}));
}

TEST(Svg2026, HasButtEnds) {
  const std::string line = "<line x1=\"0\" y1=\"0\" x2=\"10\" y2=\"0\" ";
  EXPECT_NEAR(filled_area(svg(line + "/>"), of_2026()), 10, 1e-4);
  EXPECT_NEAR(
      filled_area(svg(line + "style=\"fill:red; stroke-width: 2 ;stroke-linecap: square\"/>"),
                  of_2026()),
      24, 1e-4);
}

TEST(Svg2026, HasChordsByItsSettings) {
  const auto corners = [](const std::string& content, csgcore::FacetSettings facets) {
    SvgSettings settings = of_2026();
    settings.is_faceted = true;
    settings.facets = facets;
    return chords_of(read_one(svg(content), settings).figures.front()).front().size();
  };
  const std::string circle = "<circle r=\"20\"/>", arc = "<path d=\"M10,10 A30,30 0 1 1 60,10z\"/>",
                    curve = "<path d=\"M10,10 C20,40 50,40 60,10z\"/>",
                    bar = "<rect width=\"30\" height=\"20\" rx=\"4\"/>";
  EXPECT_EQ(corners(circle, {.fn = 6}), 40);
  EXPECT_EQ(corners(circle, {.fn = 100}), 100);
  EXPECT_EQ(corners(circle, {.fa = 2, .fs = 1}), 126);
  EXPECT_EQ(corners(curve, {.fn = 6}), 21);
  EXPECT_EQ(corners(curve, {.fn = 24.7}), 25);
  EXPECT_EQ(corners(curve, {.fa = 1, .fs = 0.1}), 21);
  EXPECT_EQ(corners(arc, {.fn = 6}), 18);
  EXPECT_EQ(corners(arc, {}), 22);
  EXPECT_EQ(corners(arc, {.fa = 1, .fs = 1}), 131);
  EXPECT_EQ(corners(bar, {.fn = 100}), 104);
  // A circle's corners begin at the bottom of the page, where x grows.
  SvgSettings settings = of_2026();
  settings.is_faceted = true;
  settings.facets.fn = 50;
  EXPECT_TRUE(has_box(svg(circle), {-19.9605, -20}, {19.9605, 20}, settings));
  settings.facets = {.fn = 1e9};
  EXPECT_THAT(chords_of(read_one(svg(circle + circle), settings).figures.front()).front(),
              SizeIs(testing::Lt(size_t{1} << 20)));
}

TEST(DisjointFigures, AreOneOutlineWhereTheyDoNotMeet) {
  std::vector<Figure> figures;
  for (int i = 0; i < 50; ++i) figures.push_back(Disc{Vec2(3.0 * i, 0), 1});
  std::vector<Figure> result = disjoint_figures(figures);
  EXPECT_THAT(result, SizeIs(1));
  EXPECT_NEAR(area_of_union(result), 50 * kPi, 50 * kPi * kChordsShare);
  figures.push_back(outline_of(Disc{Vec2(0.5, 0), 1}));
  result = disjoint_figures(figures);
  EXPECT_THAT(result, SizeIs(2));
  EXPECT_NEAR(area_of_union(result), area_of_union(figures), 1e-6);
}

TEST(DisjointFigures, AreOneOutlineWhereManyMeet) {
  std::vector<Figure> figures;
  for (int i = 0; i < 50; ++i) {
    Outline ring = outline_of(Disc{Vec2(i, 0), 2});
    // Its hole runs the same way; every other one has none.
    if (i % 2 == 0) ring.loops.push_back(outline_of(Disc{Vec2(i, 0), 1.9}).loops.front());
    figures.push_back(ring);
  }
  const std::vector<Figure> result = disjoint_figures(figures);
  EXPECT_THAT(result, SizeIs(1));
  EXPECT_NEAR(area_of_union(result), area_of_union(figures), 1e-4);
}

TEST(Tangle, IsWhatHasTooManyCrossings) {
  constexpr int kCorners = 300000;
  Polygon circle, scribble;
  for (int i = 0; i < kCorners; ++i) {
    circle.emplace_back(std::cos(2 * kPi * i / kCorners), std::sin(2 * kPi * i / kCorners));
    scribble.emplace_back((i * 7919LL) % kCorners, (i * 104729LL) % kCorners);
  }
  EXPECT_FALSE(is_tangle(outline_of(Polygons{circle})));
  EXPECT_TRUE(is_tangle(outline_of(Polygons{scribble})));
  // Squares that lie over each other, and as many side by side.
  const auto square_at = [](double x, double y) {
    return outline_of(Polygons{{{x, y}, {x + 9, y}, {x + 9, y + 9}, {x, y + 9}}});
  };
  std::vector<Figure> pile, rows;
  for (int i = 0; i < 70000; ++i) {
    pile.push_back(square_at(i % 3, 0));
    rows.push_back(square_at(10 * (i % 265), 10 * (i / 265)));
  }
  const std::vector<Figure> piled = disjoint_figures(std::move(pile));
  ASSERT_EQ(piled.size(), 1u);
  EXPECT_TRUE(is_tangle(piled.front()));
  for (const Figure& figure : disjoint_figures(std::move(rows))) EXPECT_FALSE(is_tangle(figure));
}

}  // namespace
}  // namespace frontend
