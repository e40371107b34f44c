// Tests what is exported of a design: its parts, their colours, and what is left out.
#include "frontend/model_export.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <string>
#include <utility>

#include "frontend/importer.hpp"
#include "frontend/parser.hpp"
#include "meshes/read_solid_file.hpp"
#include "meshes/zip_archive.hpp"

namespace frontend {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

/// A design that was read from the text of a .csg.
class Exported {
 public:
  explicit Exported(const std::string& text, double tolerance = 0)
      : tree_(parse(text, "a.csg")),
        design_(import_design(tree_, options_of(tolerance))),
        model_(design_, tree_) {}

  std::string as(ModelFormat format) { return model_.encode(format); }
  /// Returns the message of the Error that as() throws; empty if nothing.
  std::string error(ModelFormat format) {
    try {
      model_.encode(format);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  }
  double volume(ModelFormat format = ModelFormat::kOff) {
    const std::string bytes = as(format);
    SolidFile file = format == ModelFormat::kOff   ? read_off(bytes, "a")
                     : format == ModelFormat::kAmf ? read_amf(bytes, "a")
                     : format == ModelFormat::k3mf ? read_3mf(bytes, "a")
                                                   : read_stl(bytes, "a");
    EXPECT_EQ(file.problem, "");
    return enclosed_volume(file.faces);
  }
  double area() { return model_.figures().value().area; }
  bool is_closed() { return model_.figures().value().is_closed; }
  std::string three_mf() {
    return ZipArchive(as(ModelFormat::k3mf)).unpack("3D/3dmodel.model").value_or("");
  }
  std::vector<std::string> warnings() const {
    std::vector<std::string> texts;
    for (const Warning& warning : model_.warnings()) texts.push_back(warning.text);
    return texts;
  }
  const ImportedDesign& design() const { return design_; }

 private:
  static ImportOptions options_of(double tolerance) {
    ImportOptions options = options_for_export({});
    options.tolerance = tolerance;
    return options;
  }

  DesignTree tree_;
  ImportedDesign design_;
  ModelExport model_;
};

const std::string kCube = "cube(size = [1, 2, 3], center = false);\n";
const std::string kFar = "multmatrix([[1,0,0,9],[0,1,0,0],[0,0,1,0],[0,0,0,1]])";
const std::string kOpen =
    "polyhedron(points = [[0,0,0],[3,0,0],[0,4,0],[0,0,5]], "
    "faces = [[0,1,2],[0,3,1],[0,2,3]], convexity = 1);\n";

TEST(ModelExport, EveryFormatHoldsTheSolid) {
  for (const ModelFormat format : {ModelFormat::kStl, ModelFormat::kAsciiStl, ModelFormat::kOff,
                                   ModelFormat::kAmf, ModelFormat::k3mf}) {
    Exported exported(kCube + kFar + "{" + kCube + "}");
    EXPECT_NEAR(exported.volume(format), 12, 1e-5);
    EXPECT_THAT(exported.warnings(), IsEmpty());
  }
  EXPECT_THAT(Exported(kCube).as(ModelFormat::kObj), HasSubstr("\nv 1 2 3\n"));
}

TEST(ModelExport, RoundSolidsHaveOpenScadsFacets) {
  const std::string text =
      Exported("cylinder($fn = 0, $fa = 12, $fs = 2, h = 1, r1 = 2, r2 = 2, center = false);")
          .as(ModelFormat::kOff);
  EXPECT_THAT(text, testing::StartsWith("OFF 14 24 0\n"));
}

/// Returns how far the corners of a design's surface are from a round one, at most, and how deep
/// the triangles are below it.
std::pair<double, double> distances(const std::string& text, double tolerance,
                                    const std::function<double(const csgcore::Vec3&)>& height) {
  const std::string bytes = Exported(text, tolerance).as(ModelFormat::kOff);
  const FaceSet faces = read_off(bytes, "a").faces;
  double farthest = 0, deepest = 0;
  for (const csgcore::Vec3& point : faces.points) {
    farthest = std::max(farthest, std::abs(height(point)));
  }
  for (size_t i = 0; i < faces.face_count(); ++i) {
    const auto face = faces.face(i);
    const csgcore::Vec3 &a = faces.points[face[0]], &b = faces.points[face[1]],
                        &c = faces.points[face[2]];
    for (const csgcore::Vec3& point : {(a + b + c) / 3.0, (a + b) / 2.0, (b + c) / 2.0}) {
      deepest = std::max(deepest, -height(point));
    }
  }
  return {farthest, deepest};
}

TEST(ModelExport, FacetsAreAsFineAsTheToleranceAsks) {
  const std::string facets = "($fn = 0, $fa = 12, $fs = 2, ", many = "($fn = 200, ";
  const auto ball = [](const csgcore::Vec3& p) { return glm::length(p) - 10; };
  const auto torus = [](const csgcore::Vec3& p) {
    return std::hypot(std::hypot(p.x, p.y) - 10, p.z) - 3;
  };
  const std::string sphere = "sphere" + facets + "r = 10);";
  const std::string scaled =
      "multmatrix([[0,8,0,0],[8,0,0,0],[0,0,8,0],[0,0,0,1]]) sphere" + facets + "r = 1.25);";
  const std::string turned =
      "rotate_extrude(angle = 360, convexity = 2, $fn = 0, $fa = 12, $fs = "
      "2) multmatrix([[1,0,0,10],[0,1,0,0],[0,0,1,0],[0,0,0,1]]) circle" +
      facets + "r = 3);";
  for (const double tolerance : {0.1, 0.01}) {
    for (const auto& [text, height] :
         {std::pair<std::string, std::function<double(const csgcore::Vec3&)>>(sphere, ball),
          {"sphere" + many + "r = 10);", ball},
          {scaled, ball},
          {turned, torus}}) {
      SCOPED_TRACE(text);
      const auto [farthest, deepest] = distances(text, tolerance, height);
      EXPECT_LT(farthest, 1e-9);
      EXPECT_LE(deepest, tolerance);
      EXPECT_GT(deepest, 0.9 * tolerance) << "finer than asked";
    }
  }
}

TEST(ModelExport, APolygonIsNoRoundFaceWhateverTheTolerance) {
  const std::string prism = "cylinder($fn = 6, h = 1, r1 = 2, r2 = 2, center = false);";
  EXPECT_EQ(Exported(prism, 0.001).as(ModelFormat::kOff), Exported(prism).as(ModelFormat::kOff));
}

TEST(ModelExport, BackgroundIsLeftOutAndHighlightsAreNot) {
  EXPECT_NEAR(Exported("%" + kCube + "#" + kFar + "{" + kCube + "}").volume(), 6, 1e-9);
}

TEST(ModelExport, AMirroredSolidIsNotInsideOut) {
  Exported exported("multmatrix([[-1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]]) {" + kCube + "}");
  EXPECT_NEAR(exported.volume(), 6, 1e-9);
}

TEST(ModelExport, AHoleInATurnedExtrusionIsOpen) {
  Exported exported(
      "multmatrix([[1,0,0,0],[0,0.8,-0.6,0],[0,0.6,0.8,0],[0,0,0,1]]) multmatrix([[0.96,-0.28,0,0],"
      "[0.28,0.96,0,0],[0,0,1,0],[0,0,0,1]]) linear_extrude(height = 3, $fn = 0, $fa = 12, $fs = 2)"
      " difference() { square(size = [60, 40], center = false);"
      " multmatrix([[1,0,0,7],[0,1,0,9],[0,0,1,0],[0,0,0,1]]) square(size = [5, 4], center = "
      "false);"
      " multmatrix([[1,0,0,30],[0,1,0,9],[0,0,1,0],[0,0,0,1]]) square(size = [7, 9], center = "
      "false);"
      "}");
  EXPECT_NEAR(exported.volume(), 3 * (2400 - 20 - 63), 1e-6);
  EXPECT_NEAR(exported.area(), 2 * (2400 - 20 - 63) + 3 * (200 + 18 + 32), 1e-6);
}

/// A turn by a right triangle's angle about the x axis, and one about z within it.
const std::string kTurn =
    "multmatrix([[1,0,0,0],[0,0.8,-0.6,0],[0,0.6,0.8,0],[0,0,0,1]]) "
    "multmatrix([[0.96,-0.28,0,5],[0.28,0.96,0,7],[0,0,1,3],[0,0,0,1]])";

std::string cube_at(const std::string& offset, const std::string& size) {
  return "multmatrix([[1,0,0," + offset + "]," + "[0,1,0,1.1],[0,0,1,0],[0,0,0,1]]) cube(size = [" +
         size + "], center = false);";
}

/// Returns the area of the design, which is the same when it is turned.
double turned_area(const std::string& text) {
  const double area = Exported(text).area();
  EXPECT_NEAR(Exported(kTurn + "{" + text + "}").area(), area, 1e-9 * area) << text;
  return area;
}

TEST(ModelExport, ATurnLeavesFlushSolidsFlush) {
  const std::string a = cube_at("0", "2, 2, 2"), b = cube_at("2", "2, 2, 2");
  const std::string plate = cube_at("-1", "6, 6, 2");
  EXPECT_NEAR(turned_area(a + b), 40, 1e-9);
  EXPECT_NEAR(turned_area("difference() {" + plate + a + "}"), 2 * (36 - 4) + 2 * (24 + 4), 1e-9);
  EXPECT_NEAR(turned_area("intersection() {" + plate + "union() {" + a + b + "} }"), 40, 1e-9);
}

TEST(ModelExport, SolidsUnderEqualTurnsAreFlush) {
  const std::string a = kTurn + cube_at("0", "2, 2, 2"), b = kTurn + cube_at("2", "2, 2, 2");
  EXPECT_NEAR(Exported(a + kCube + b).area(), 40 + 22, 1e-9);
  EXPECT_NEAR(
      Exported("difference() {" + kTurn + cube_at("-1", "6, 6, 2") + kCube + b + "}").area(),
      2 * (36 - 4) + 2 * (24 + 4), 1e-9);
}

TEST(ModelExport, TurnsWithinTurnsAreEvaluatedWithin) {
  const std::string spun = "multmatrix([[0.6,-0.8,0,0],[0.8,0.6,0,0],[0,0,1,0],[0,0,0,1]])";
  const std::string a = cube_at("0", "2, 2, 2");
  turned_area("union() {" + a + spun + "{" + a + cube_at("2", "2, 1, 2") + "} }");
  turned_area("difference() {" + spun + "difference() {" + cube_at("-1", "6, 6, 2") + a + "}" + a +
              kTurn + a + "}");
}

TEST(ModelExport, ATurnThatMirrorsKeepsTheInside) {
  const std::string mirror = "multmatrix([[0.28,-0.96,0,0],[-0.96,-0.28,0,0],[0,0,1,0],[0,0,0,1]])";
  Exported exported(mirror + "{" + cube_at("0", "2, 2, 2") + cube_at("2", "2, 2, 2") + "}");
  EXPECT_NEAR(exported.volume(), 16, 1e-9);
  EXPECT_NEAR(exported.area(), 40, 1e-9);
}

TEST(ModelExport, ColorsOfATurnedSolidStayApart) {
  const std::string text = kTurn + "{color([1,0,0,1])" + cube_at("0", "2, 2, 2") +
                           "color([0,0,1,1])" + cube_at("2", "2, 2, 2") + "}";
  const std::string model = Exported(text).three_mf();
  EXPECT_THAT(model, AllOf(HasSubstr("#FF0000"), HasSubstr("#0000FF")));
  EXPECT_NEAR(Exported(text).volume(ModelFormat::k3mf), 16, 1e-5);
}

// All of their faces in one plane would be divided by each other's edges, which takes minutes.
TEST(ModelExport, SolidsWithinOthersAreLeftOut) {
  std::string nested;
  for (int i = 1; i <= 160; ++i) {
    nested += "cylinder($fn = 6, $fa = 12, $fs = 2, h = " + std::to_string(4 + 0.01 * i) +
              ", r1 = 10, r2 = 10, center = false);\n";
  }
  EXPECT_NEAR(Exported(nested).volume(), 5.6 * 150 * std::sqrt(3.0), 1e-6);
  const std::string colored = "color([1, 0, 0, 1]) " + kFar + "{" + kFar + "{" + kCube + "}}";
  EXPECT_NEAR(Exported(nested + colored).volume(ModelFormat::k3mf), 5.6 * 150 * std::sqrt(3.0) + 6,
              1e-4);
  // Each colour is a part of its own, also within another.
  const std::string colors =
      "color([0,0,1,1]) cube(size = [3, 3, 3], center = true);"
      "color([1,0,0,1]) cube(size = [1, 1, 1], center = true);";
  EXPECT_THAT(Exported(colors).three_mf(), AllOf(HasSubstr("#FF0000"), HasSubstr("#0000FF")));
}

// Convex pieces of such a sum have faces that are as thin as rounding.
TEST(ModelExport, ASumOfThreeIsClosed) {
  Exported exported(
      "minkowski(convexity = 0) { difference() { cube(size = [9, 8, 7], center = false);"
      "cylinder($fn = 6, $fa = 12, $fs = 2, h = 9, r1 = 2, r2 = 2, center = false); }"
      "cylinder($fn = 0, $fa = 12, $fs = 2, h = 1, r1 = 1, r2 = 1, center = false);"
      "sphere($fn = 5, $fa = 12, $fs = 2, r = 1); }");
  EXPECT_TRUE(exported.is_closed());
  EXPECT_NEAR(exported.volume(), 1353.5386, 1e-3);
}

TEST(ModelExport, EqualPolyhedraStandWhereTheyArePut) {
  const std::string ball = "sphere($fn = 4, $fa = 12, $fs = 2, r = 1);";
  const double one = Exported(ball).volume();
  EXPECT_NEAR(Exported(ball + "multmatrix([[-2,0,0,9],[0,1,0,0],[0,0,1,0],[0,0,0,1]]) {" + ball +
                       "} multmatrix([[1,0,0,-9],[0,1,0,0],[0,0,1,0],[0,0,0,1]]) {" + ball + "}")
                  .volume(),
              4 * one, 1e-9);
}

TEST(ModelExport, FormatsHoldTheirDimensionAlone) {
  const std::string square = "square(size = [1, 2], center = false);\n";
  EXPECT_EQ(Exported(square).error(ModelFormat::kStl),
            "a.csg: error: Current top level object is not a 3D object.");
  EXPECT_EQ(Exported(kCube).error(ModelFormat::kSvg),
            "a.csg: error: Current top level object is not a 2D object.");
  EXPECT_EQ(Exported("group();").error(ModelFormat::kOff),
            "a.csg: error: Current top level object is empty.");
  EXPECT_EQ(Exported("group();").error(ModelFormat::kDxf),
            "a.csg: error: Current top level object is not a 2D object.");
  EXPECT_EQ(Exported("%" + kCube).error(ModelFormat::k3mf),
            "a.csg: error: Current top level object is empty.");
  EXPECT_THAT(Exported(square).as(ModelFormat::kSvg), HasSubstr("M 1,-2 L 0,-2 L 0,0 L 1,0 z\n"));
  EXPECT_THAT(Exported(square).as(ModelFormat::kDxf), HasSubstr("LINE"));
  EXPECT_THAT(Exported(square).as(ModelFormat::kPdf), HasSubstr("/MediaBox"));
}

TEST(ModelExport, FloatsAreTooCoarseForSomeSolids) {
  const std::string tiny = "cube(size = [1e-9, 1e-9, 1e-9], center = false);";
  Exported exported("multmatrix([[1,0,0,9],[0,1,0,9],[0,0,1,9],[0,0,0,1]]) {" + tiny + "}");
  EXPECT_THAT(exported.error(ModelFormat::kStl), HasSubstr("nothing is left of the solid"));
  EXPECT_THAT(exported.error(ModelFormat::k3mf), HasSubstr("nothing is left of the solid"));
  EXPECT_EQ(exported.error(ModelFormat::kOff), "");
}

TEST(ModelExport, AnOpenSurfaceIsLeftOut) {
  Exported exported(kCube + kOpen);
  EXPECT_NEAR(exported.volume(), 6, 1e-9);
  EXPECT_THAT(exported.warnings(),
              ElementsAre("a.csg:2:1: warning: polyhedron is left out of the file: it is no solid "
                          "(close its surface)"));
}

TEST(ModelExport, AFlatHullIsLeftOutAndCutsNothing) {
  const std::string flat =
      "hull() { polyhedron(points = [[-1, -1, 1], [9, -1, 1], [-1, 9, 1]], "
      "faces = [[0, 1, 2]], convexity = 1); }\n";
  for (const char* const operation : {"union", "difference"}) {
    Exported exported(operation + (" () {\n" + kCube) + flat + "}");
    EXPECT_NEAR(exported.volume(), 6, 1e-9);
    EXPECT_EQ(exported.area(), 22);
    EXPECT_THAT(exported.warnings(),
                ElementsAre(HasSubstr("a.csg:3:1: warning: hull is left out")));
  }
}

TEST(ModelExport, SheetsOfASolidThatIsThereAreNotToldOf) {
  // The sides turn around the axis within one slice: two pyramids whose tops touch.
  Exported exported(
      "linear_extrude(height = 6, center = false, convexity = 1, twist = 180, slices = 1, scale = "
      "[1, 1], $fn = 0, $fa = 12, $fs = 2) { multmatrix([[1,0,0,1],[0,1,0,0],[0,0,1,0],[0,0,0,1]]) "
      "{ square(size = [4, 3], center = false); } }");
  EXPECT_NEAR(exported.volume(), 24, 1e-9);
  EXPECT_THAT(exported.warnings(), IsEmpty());
}

TEST(ModelExport, AnOpenSurfaceAloneIsWrittenAsItIs) {
  Exported exported(kOpen);
  EXPECT_THAT(exported.as(ModelFormat::kOff), testing::StartsWith("OFF 4 3 0\n"));
  EXPECT_THAT(exported.warnings(),
              ElementsAre("a.csg:1:1: warning: polyhedron is written as it is, which is no solid "
                          "(close its surface)"));
}

TEST(ModelExport, ColoursAreMaterialsOfThreeMf) {
  Exported exported("color([1, 0, 0, 1]) {" + kCube + "}" + kFar + "{" + kCube +
                    "} color([1, 0, 0, 1]) " + kFar + kFar + "{" + kCube + "}");
  EXPECT_THAT(exported.three_mf(),
              AllOf(HasSubstr("displaycolor=\"#FF0000FF\""), HasSubstr("part 2\" type=\"model\">"),
                    Not(HasSubstr("part 3"))));
  EXPECT_NEAR(exported.volume(ModelFormat::k3mf), 18, 1e-5);
  EXPECT_NEAR(exported.volume(), 18, 1e-9);
  EXPECT_THAT(exported.design().scene.layers, IsEmpty());
}

TEST(ModelExport, TranslucentColoursMakeNoLayers) {
  Exported exported("color([0, 0, 1, 0.25]) {" + kCube + "}");
  EXPECT_THAT(exported.three_mf(),
              AllOf(HasSubstr("displaycolor=\"#0000FF40\""), Not(HasSubstr("components"))));
  EXPECT_THAT(exported.design().scene.layers, IsEmpty());
}

TEST(ModelExport, TheSameDesignGivesTheSameBytes) {
  const std::string text = "color([1, 0, 0, 1]) {" + kCube + "}" + kFar + "{" + kCube + "}";
  EXPECT_EQ(Exported(text).as(ModelFormat::k3mf), Exported(text).as(ModelFormat::k3mf));
  EXPECT_EQ(Exported(text).as(ModelFormat::kStl), Exported(text).as(ModelFormat::kStl));
}

}  // namespace
}  // namespace frontend
