// Tests the reader of DXF drawings. What OpenSCAD 2021.01 makes of the same files was looked at.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

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

std::string section(const std::string& name, const std::string& entities) {
  return "0\nSECTION\n2\n" + name + "\n" + entities + "0\nENDSEC\n";
}
std::string file_of(const std::string& entities) {
  return section("ENTITIES", entities) + "0\nEOF\n";
}
std::string group(int code, double value) {
  return std::to_string(code) + "\n" + std::to_string(value) + "\n";
}
std::string line(const Vec2& a, const Vec2& b, const std::string& layer = "0") {
  return "0\nLINE\n8\n" + layer + "\n" + group(10, a.x) + group(20, a.y) + group(11, b.x) +
         group(21, b.y);
}
/// Lines from point to point, and back to the first one.
std::string ring(const std::vector<Vec2>& points, const std::string& layer = "0") {
  std::string text;
  for (size_t i = 0; i < points.size(); ++i) {
    text += line(points[i], points[(i + 1) % points.size()], layer);
  }
  return text;
}
std::string circle(const Vec2& center, double radius) {
  return "0\nCIRCLE\n8\n0\n" + group(10, center.x) + group(20, center.y) + group(40, radius);
}
std::string arc(const Vec2& center, double radius, double start, double end) {
  return "0\nARC\n8\n0\n" + group(10, center.x) + group(20, center.y) + group(40, radius) +
         group(50, start) + group(51, end);
}

Drawing read(const std::string& text, const DxfSettings& settings = {}) {
  return read_dxf(text, "a.dxf", settings);
}
double area(const std::string& text, const DxfSettings& settings = {}) {
  return area_of_union(read(text, settings).figures);
}
std::vector<std::string> problems(const std::string& text, const DxfSettings& settings = {}) {
  std::vector<std::string> result;
  for (const DrawingProblem& problem : read(text, settings).problems) {
    result.push_back(problem.what);
  }
  return result;
}

DxfSettings faceted(double fn) {
  DxfSettings settings;
  settings.is_faceted = true;
  settings.facets.fn = fn;
  return settings;
}

const std::vector<Vec2> kTriangle{{0, 0}, {10, 0}, {10, 10}};

TEST(Dxf, JoinsLinesInAnyOrder) {
  const std::string shuffled =
      line({10, 10}, {10, 0}) + line({0, 0}, {10, 0}) + line({0, 0}, {10, 10});
  EXPECT_NEAR(area(file_of(shuffled)), 50, 1e-7);
  EXPECT_NEAR(area(file_of(ring(kTriangle) + ring({{2, 1}, {9, 1}, {9, 8}}))), 50 - 24.5, 1e-7);
}

TEST(Dxf, ClosesOpenChains) {
  EXPECT_NEAR(area(file_of(line({0, 0}, {10, 0}) + line({10, 0}, {10, 10}))), 50, 1e-7);
  // A tail is an open chain, which takes the ring's lines with it.
  EXPECT_NEAR(area(file_of(line({20, 20}, {10, 0}) + ring({{0, 0}, {10, 0}, {5, 5}}))), 25, 1e-7);
  EXPECT_THAT(read(file_of(line({0, 0}, {10, 0}))).figures, IsEmpty());
}

TEST(Dxf, LosesAnEndOfWhatIsTakenForClosed) {
  // The first edge is there twice: OpenSCAD draws the triangle of the other corners.
  const std::vector<Vec2> square{{0, 0}, {10, 0}, {10, 10}, {0, 10}};
  EXPECT_NEAR(area(file_of(line(square[0], square[1]) + ring(square))), 50, 1e-7);
  EXPECT_NEAR(area(file_of(ring(square) + line(square[1], square[0]))), 100, 1e-7);
  EXPECT_THAT(read(file_of(line({0, 0}, {10, 0}) + ring({{0, 0}, {10, 0}, {5, 5}}))).figures,
              IsEmpty());
}

TEST(Dxf, SnapsEndsToAGrid) {
  constexpr double kCell = 1.0 / 1024;
  const Rectangle box = bounds_of(
      read(file_of(ring({{0.6 * kCell, 0}, {10, 0}, {10, 10 + 0.4 * kCell}}))).figures.front());
  EXPECT_EQ(box.min.x, kCell);
  EXPECT_EQ(box.max.y, 10);
  // A cell beside one that is occupied.
  const Drawing gap = read(file_of(line({0, 0}, {10, 0}) + line({10, 1.4 * kCell}, {10, 10}) +
                                   line({10, 10}, {0, 0}) + line({30, 0}, {31, 0})));
  EXPECT_NEAR(area_of_union(gap.figures), 50, 1e-7);
}

TEST(Dxf, KeepsCurvesUnlessFacetsAreWanted) {
  EXPECT_NEAR(area(file_of(circle({5, 5}, 3))), kPi * 9, kPi * 9 * kChordsShare);
  EXPECT_FALSE(is_polygonal(read(file_of(circle({5, 5}, 3))).figures.front()));
  const Drawing square = read(file_of(circle({5, 5}, 3)), faceted(4));
  EXPECT_TRUE(is_polygonal(square.figures.front()));
  EXPECT_NEAR(area_of_union(square.figures), 18, 1e-7);
  // A half disc: the arc runs from 270° on, and the line closes it.
  const std::string half = file_of(arc({0, 0}, 2, 270, 90) + line({0, 2}, {0, -2}));
  EXPECT_NEAR(area(half), 2 * kPi, 2 * kPi * kChordsShare);
  EXPECT_NEAR(area(half, faceted(4)), 4, 1e-7);
  EXPECT_NEAR(bounds_of(read(half).figures.front()).min.x, 0, 1e-12);
}

TEST(Dxf, ReadsEllipses) {
  constexpr double kShare = 1e-4;  // that chords of a curve leave out
  const std::string text = "0\nELLIPSE\n8\n0\n" + group(10, 5) + group(20, 5) + group(11, 10) +
                           group(21, 0) + group(40, 0.5) + group(41, 0);
  EXPECT_NEAR(area(file_of(text + group(42, 6.283185))), 50 * kPi, 50 * kPi * kShare);
  EXPECT_NEAR(area(file_of(text + group(42, 3.14159265))), 25 * kPi, 25 * kPi * kShare);
  EXPECT_THAT(chords_of(read(file_of(text + group(42, 6.283185)), faceted(8)).figures.front()),
              ElementsAre(SizeIs(8)));
}

TEST(Dxf, ReadsPolylinesWithoutBulges) {
  const std::string points = group(10, 0) + group(20, 0) + group(42, 1) + group(10, 10) +
                             group(20, 0) + group(10, 10) + group(20, 10);
  EXPECT_NEAR(area(file_of("0\nLWPOLYLINE\n8\n0\n70\n1\n" + points)), 50, 1e-7);
}

TEST(Dxf, InsertsBlocks) {
  const std::string blocks =
      section("BLOCKS", "0\nBLOCK\n8\n0\n2\na\n10\n1\n20\n2\n" + ring(kTriangle) +
                            "0\nENDBLK\n0\nBLOCK\n2\nb\n" + "0\nINSERT\n2\na\n10\n0\n20\n0\n" +
                            "0\nINSERT\n2\na\n10\n50\n20\n0\n41\n2\n0\nENDBLK\n");
  const std::string insert = "0\nINSERT\n8\nL\n2\nb\n10\n100\n20\n0\n50\n90\n";
  const Drawing drawing = read(blocks + file_of(insert), {.layer = "L"});
  EXPECT_NEAR(area_of_union(drawing.figures), 150, 1e-6);
  Rectangle box;
  for (const Figure& figure : drawing.figures) box.merge(bounds_of(figure));
  EXPECT_EQ(box.min, Vec2(90, 0));
  EXPECT_EQ(box.max, Vec2(100, 70));
  EXPECT_THAT(read(blocks + file_of(insert), {.layer = "0"}).figures, IsEmpty());
}

TEST(Dxf, TakesTheLayerTheOriginAndTheScale) {
  const std::string text = file_of(ring(kTriangle, "A") + ring({{20, 0}, {30, 0}, {30, 1}}, "B"));
  EXPECT_NEAR(area(text), 55, 1e-7);
  EXPECT_NEAR(area(text, {.layer = "A"}), 50, 1e-7);
  EXPECT_NEAR(area(text, {.layer = "a"}), 0, 0);
  const Drawing moved = read(text, {.layer = "A", .origin = {1, 2}, .scale = 2});
  EXPECT_EQ(bounds_of(moved.figures.front()).min, Vec2(-2, -4));
  EXPECT_EQ(bounds_of(moved.figures.front()).max, Vec2(18, 16));
  EXPECT_NEAR(area(text, {.scale = -2}), 55, 1e-7);
}

TEST(Dxf, SaysWhatItCannotRead) {
  EXPECT_THAT(problems(file_of("0\nSPLINE\n8\n0\n0\nSPLINE\n8\nA\n0\nTEXT\n0\nDIMENSION\n")),
              ElementsAre("Unsupported DXF Entity 'SPLINE' (2), 'TEXT' (1) in 'a.dxf'"));
  EXPECT_THAT(problems(file_of("0\nSPLINE\n8\n0\n0\nSPLINE\n8\nA\n"), {.layer = "A"}),
              ElementsAre("Unsupported DXF Entity 'SPLINE' (1) in layer 'A' of 'a.dxf'"));
  EXPECT_THAT(problems(file_of("garbage\nfoo\n")), ElementsAre("Illegal ID 'garbage' in 'a.dxf'"));
  // The file may be anybody's.
  EXPECT_THAT(problems("root:x:0:0\nfoo\n"), ElementsAre("'a.dxf' is no DXF"));
  EXPECT_THAT(problems("10\nsecret\n"), ElementsAre("Illegal value '' in 'a.dxf'"));
  EXPECT_THAT(problems(file_of("0\nSPLINE\n10\n1,5\n20\n2\n")),
              ElementsAre("Illegal value '1,5' in 'a.dxf'", HasSubstr("Unsupported")));
  EXPECT_THAT(problems(file_of("0\nLINE\n10\n0\n20\n0\n" + ring(kTriangle))),
              ElementsAre("Not enough input values for LINE. in 'a.dxf'"));
  EXPECT_THAT(problems(file_of(line({0, 0}, {10, 0}) + "0\nLINE\n10\nnan\n20\n0\n11\n0\n21\n0\n")),
              ElementsAre("Range check failed for 'a.dxf'"));
  EXPECT_THAT(problems(""), IsEmpty());
}

TEST(Dxf, DrawsWhatStandsBeforeTheEndOfAFile) {
  const std::string whole = file_of(ring(kTriangle) + ring({{20, 0}, {30, 0}, {30, 1}}) +
                                    circle({0, 0}, 3) + arc({50, 0}, 2, 0, 90));
  const double first = area(whole.substr(0, whole.find("30.0")));
  EXPECT_NEAR(first, 50, 1e-7);
  for (size_t length = 0; length < whole.size(); ++length) read(whole.substr(0, length));
}

TEST(Dxf, DoesNotInsertBlocksWithoutEnd) {
  std::string blocks = "0\nBLOCK\n2\nb0\n" + ring(kTriangle) + "0\nENDBLK\n";
  for (int i = 1; i < 30; ++i) {
    blocks += "0\nBLOCK\n2\nb" + std::to_string(i) + "\n";
    for (int j = 0; j < 40; ++j)
      blocks += "0\nINSERT\n2\nb" + std::to_string(i - 1) + "\n10\n0\n20\n0\n";
    blocks += "0\nENDBLK\n";
  }
  EXPECT_THAT(problems(section("BLOCKS", blocks)), ElementsAre(HasSubstr("are left out")));
}

}  // namespace
}  // namespace frontend
