// Tests cube() and polyhedron().
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "csgcore/canonical_primitive.hpp"
#include "csgcore/polyhedron.hpp"
#include "csgcore/triangle_mesh.hpp"
#include "lower/imported_text.hpp"

namespace frontend {
namespace {

using csgcore::Primitive;
using csgcore::Vec3;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

TEST(ImporterCube, TakesEverySpellingOfItsSize) {
  const auto expect_cube = [](const std::string& text, const Vec3& min, const Vec3& max) {
    SCOPED_TRACE(text);
    expect_box(box_of(only_primitive(text)), min, max, 0);
  };
  expect_cube("cube(size = [2, 3.5, 4], center = false);", Vec3(0.0), Vec3(2, 3.5, 4));
  expect_cube("cube(size = [2, 3.5, 4], center = true);", Vec3(-1, -1.75, -2), Vec3(1, 1.75, 2));
  expect_cube("cube([1, 2, 3], true);", Vec3(-0.5, -1, -1.5), Vec3(0.5, 1, 1.5));
  expect_cube("cube(3);", Vec3(0.0), Vec3(3.0));
  expect_cube("cube(size = undef, center = undef);", Vec3(0.0), Vec3(1.0));
  expect_cube("cube();", Vec3(0.0), Vec3(1.0));
  expect_cube("multmatrix([[0,-1,0,5],[2,0,0,0],[0,0,1,0],[0,0,0,1]]) { cube([1, 2, 3]); }",
              Vec3(3, 0, 0), Vec3(5, 2, 3));
}

TEST(ImporterCube, HasColourAndId) {
  const Primitive cube = import_text("sphere(); color([1, 0, 0]) { cube(); }").scene.primitives[1];
  EXPECT_EQ(cube.id, 1u);
  EXPECT_EQ(cube.color->r, 1);
}

TEST(ImporterCube, SharesOnePolyhedron) {
  const std::vector<Primitive> cubes =
      import_text("cube([1, 2, 3]); multmatrix([[0,1,0,0],[1,0,0,0],[0,0,1,0]]) { cube(7); }")
          .scene.primitives;
  EXPECT_EQ(cubes[0].polyhedron(), cubes[1].polyhedron());
}

TEST(ImporterPolyhedron, IsTakenWhereItIsConvex) {
  const Primitive primitive = only_primitive("polyhedron(" + kCorner + kFaces + ");");
  expect_box(box_of(primitive), Vec3(0.0), Vec3(3, 4, 5), 0);
  EXPECT_EQ(primitive.polyhedron()->half_spaces().size(), 4u);
  const std::string older =
      "polyhedron(" + kCorner + "triangles = [[0,1,2],[0,3,1],[0,2,3],[1,3,2]], convexity = 1);";
  const std::string positional =
      "polyhedron([[0,0],[3,0],[0,4],[0,0,5],[9,9,9]], [[0,1,2],[0,3,1],[0,2,3],[1,3,2]], 2);";
  const std::string careless =
      "polyhedron(" + kCorner + "faces = [[0,1,2],[0,3,1],[0,2,3],[1,3.2,2,-5,77,1e99,nan]]);";
  for (const std::string& text : {older, positional, careless}) {
    EXPECT_EQ(only_primitive(text).polyhedron()->half_spaces().size(), 4u) << text;
    expect_box(box_of(only_primitive(text)), Vec3(0.0), Vec3(3, 4, 5), 0);
  }
}

TEST(ImporterPolyhedron, EqualOnesAreOne) {
  const std::string tetrahedron = "polyhedron(" + kCorner + kFaces + ");";
  const std::vector<Primitive> primitives =
      import_text(tetrahedron + "multmatrix([[1,0,0,9]]) { " + tetrahedron + "}" +
                  "polyhedron(points = [[0,0,0],[3,0,0],[0,4,0],[0,0,5.5]], " + kFaces + ");")
          .scene.primitives;
  EXPECT_EQ(primitives[0].polyhedron(), primitives[1].polyhedron());
  EXPECT_NE(primitives[0].polyhedron(), primitives[2].polyhedron());
}

TEST(ImporterPolyhedron, OfAnySize) {
  for (const char* size : {"1e-90", "1e90"}) {
    const std::string text = "polyhedron(points = [[0,0,0],[" + std::string(size) + ",0,0],[0," +
                             size + ",0],[0,0," + size + "]], " + kFaces + ");";
    const double expected = std::stod(size);
    expect_box(box_of(only_primitive(text)), Vec3(0.0), Vec3(expected), 1e-15 * expected);
  }
}

TEST(ImporterPolyhedron, IsAMeshWhereItIsNotConvex) {
  // An octahedron with one vertex pushed in; it is twice its size in units of the mesh.
  const std::string dented =
      "polyhedron([[2,0,0],[0,2,0],[-2,0,0],[0,-2,0],[0,0,2],[0,0,1]], [[4,1,0],[4,2,1],[4,3,2],"
      "[4,0,3],[0,1,5],[1,2,5],[2,3,5],[3,0,5]]);";
  EXPECT_THAT(warnings_of(dented), IsEmpty());
  const Primitive primitive = only_primitive(dented);
  ASSERT_EQ(primitive.shape(), csgcore::Shape::kMesh);
  EXPECT_TRUE(primitive.mesh()->is_closed());
  EXPECT_EQ(primitive.mesh()->triangles().size(), 8u);
  expect_box(csgcore::canonicalize(primitive).bounds, Vec3(-2, -2, 0), Vec3(2), 1e-15);
  for (const Vec3& vertex : primitive.mesh()->vertices()) EXPECT_LE(vertex.x, 1);
  EXPECT_EQ(primitive.local_to_world.linear[0].x, 2);
  // The same faces share one mesh.
  const std::vector<Primitive> two =
      import_text(dented + "multmatrix([[1,0,0,9]]) { " + dented + " }").scene.primitives;
  EXPECT_EQ(two[0].mesh(), two[1].mesh());
}

TEST(ImporterPolyhedron, CutsFacesIntoTriangles) {
  // An L, extruded.
  std::string points, sides;
  const int outline[6][2] = {{0, 0}, {6, 0}, {6, 2}, {2, 2}, {2, 6}, {0, 6}};
  for (int z = 0; z < 2; ++z) {
    for (const auto& [x, y] : outline) {
      points += "[" + std::to_string(x) + "," + std::to_string(y) + "," + std::to_string(z) + "],";
    }
  }
  for (int i = 0; i < 6; ++i) {
    const int next = (i + 1) % 6;
    sides += ",[" + std::to_string(6 + i) + "," + std::to_string(6 + next) + "," +
             std::to_string(next) + "," + std::to_string(i) + "]";
  }
  const Primitive primitive =
      only_primitive("polyhedron([" + points + "],[[0,1,2,3,4,5],[11,10,9,8,7,6]" + sides + "]);");
  ASSERT_EQ(primitive.shape(), csgcore::Shape::kMesh);
  EXPECT_TRUE(primitive.mesh()->is_closed());
  EXPECT_EQ(primitive.mesh()->triangles().size(), 20u);
  csgcore::CanonicalPrimitive canonical = csgcore::canonicalize(primitive);
  EXPECT_TRUE(csgcore::contains(canonical, Vec3(1, 5, 0.5)));
  EXPECT_FALSE(csgcore::contains(canonical, Vec3(3, 3, 0.5)));
}

TEST(ImporterPolyhedron, IsDrawnOpen) {
  const std::string open = "polyhedron(" + kCorner + "faces = [[0,1,2],[0,3,1],[0,2,3]]);";
  EXPECT_EQ(model_of("difference() { cube(); " + open + open + " }"), "(0-1-2)");
  EXPECT_EQ(warning_of("difference() { cube(); " + open + open + " }"),
            "a.csg:1:24: warning: polyhedron is not closed: 3 edges have a face on one side only; "
            "the first of 2 (it is drawn as thin sheets where a ray passes a hole)");
  const std::string sheet = "polyhedron([[0,0],[1,0],[0,1]], [[0,1,2]]);";
  EXPECT_THAT(warning_of(sheet), HasSubstr("3 edges have a face"));
  EXPECT_EQ(only_primitive(sheet).mesh()->triangles().size(), 1u);
}

/// OpenSCAD draws their faces.
TEST(ImporterPolyhedron, WithoutVolumeIsASheet) {
  const std::string square = "polyhedron([[0,0,0],[9,0,0],[9,9,0],[0,9,0]], ";
  for (const std::string& flat :
       {std::string("polyhedron([[0,0],[1,0],[0,1]], [[0,1,2],[2,1,0]]);"),
        square + "[[0,1,2,3],[3,2,1,0]]);", square + "[[0,1,2],[0,2,3],[3,2,1],[3,1,0]]);",
        // A box whose walls are drawn from both sides.
        std::string("polyhedron([[0,0,0],[9,0,0],[9,9,0],[0,0,9]], "
                    "[[0,1,2],[2,1,0],[0,1,3],[3,1,0],[1,2,3],[3,2,1]]);")}) {
    const csgcore::Primitive sheet = only_primitive(flat);
    ASSERT_EQ(sheet.shape(), csgcore::Shape::kMesh) << flat;
    EXPECT_FALSE(sheet.mesh()->is_closed()) << flat;
    EXPECT_THAT(warning_of(flat), HasSubstr("polyhedron has no volume (it is drawn as a thin"));
  }
  const csgcore::Primitive solid = only_primitive("polyhedron(" + kCorner + kFaces + ");");
  EXPECT_EQ(solid.shape(), csgcore::Shape::kPolyhedron);
  EXPECT_THAT(warnings_of("polyhedron([[0,0,0],[1,0,0],[0,1,0],[0,0,1e200]], " + kFaces + ");"),
              ElementsAre(HasSubstr("it is too large")));
}

TEST(ImporterPrimitives, ThatAMatrixFlattensAreSheets) {
  const std::string flat = "multmatrix([[1,0,0,0],[0,1,0,0],[0,0,0,0],[0,0,0,1]])";
  for (const std::string solid : {"cube(8);", "sphere(8, $fn = 20);", "cylinder(h = 2, r = 3);"}) {
    const csgcore::Primitive sheet = only_primitive(flat + "{" + solid + "}");
    ASSERT_EQ(sheet.shape(), csgcore::Shape::kMesh) << solid;
    EXPECT_FALSE(sheet.mesh()->is_closed()) << solid;
    EXPECT_THAT(warning_of(flat + "{" + solid + "}"), HasSubstr(" has no volume"));
  }
  // Nothing is left of a line.
  EXPECT_EQ(model_of("multmatrix([[1,0,0,0],[0,0,0,0],[0,0,0,0]]) { cube(8); } sphere();"), "1");
}

TEST(ImporterPolyhedron, FoldsWhatIsEqualAlone) {
  EXPECT_THAT(
      warnings_of("polyhedron([[0,0,0]], [[7,8]]); polyhedron([[0,0,0]], [[9]]); "
                  "polyhedron([[0,0,0]], [[9]]);"),
      ElementsAre(HasSubstr("Point index 7 is out of bounds (from faces[0][0]), and is left out; "
                            "the first of 2 ("),
                  HasSubstr("Point index 9 is out of bounds (from faces[0][0]), and is left out; "
                            "the first of 2 (")));
}

TEST(ImporterPolyhedron, FacesMayRunEitherWay) {
  const Primitive wanted = only_primitive("polyhedron(" + kCorner + kFaces + ");");
  for (const char* faces :
       {"[[2,1,0],[1,3,0],[3,2,0],[2,3,1]]", "[[0,1,2],[1,3,0],[0,2,3],[2,3,1]]"}) {
    const std::string text = "polyhedron(" + kCorner + "faces = " + faces + ");";
    EXPECT_THAT(warnings_of(text), IsEmpty());
    const Primitive primitive = only_primitive(text);
    expect_box(box_of(primitive), Vec3(0.0), Vec3(3, 4, 5), 0);
    EXPECT_EQ(primitive.polyhedron()->half_spaces().size(), 4u);
    for (size_t i = 0; i < 4; ++i) {
      const csgcore::HalfSpace& found = primitive.polyhedron()->half_spaces()[i];
      EXPECT_NEAR(found.offset, wanted.polyhedron()->half_spaces()[i].offset, 1e-15);
    }
  }
}

/// OpenSCAD 2021.01 treats them in this way (frontend/OPENSCAD.md, "Polyhedra").
TEST(ImporterPolyhedron, BadIndicesAreLeftOutOrZero) {
  const auto expect_whole = [](const std::string& faces, const std::string& warning) {
    const std::string text = "polyhedron(" + kCorner + "faces = " + faces + ");";
    EXPECT_EQ(warnings_of(text).at(0), "a.csg:1:1: warning: polyhedron: " + warning);
    expect_box(box_of(only_primitive(text)), Vec3(0.0), Vec3(3, 4, 5), 0);
  };
  expect_whole("[[0,1,2,4],[0,3,1],[-1,0,2,3],[1,3,nan,2]]",
               "Point index 4 is out of bounds (from faces[0][3]), and is left out; the first of 3 "
               "(the points are 0 to 3)");
  expect_whole("[[\"a\",1,2],[undef,3,1],[[1],2,3],[1,3,2]]",
               "an index of a face is a string, and counts as 0 (it must be a number)");
  expect_whole("[[0,1,2],[0,3,1],7,[0,2,3],undef,[1,3,2]]",
               "a face is a number, and is left out (it must be a list of indices of points)");
}

TEST(ImporterPolyhedron, ABadPointEndsTheFaces) {
  for (const auto& [point, words] : {std::pair("undef", "undef"),
                                     {"7", "7"},
                                     {"\"a\"", "\"a\""},
                                     {"[]", "[]"},
                                     {"[1]", "[1]"},
                                     {"[1,2,3,4]", "[1, 2, 3, 4]"},
                                     {"[1,\"a\",3]", "[1, \"a\", 3]"},
                                     {"[1,nan,3]", "[1, nan, 3]"},
                                     {"[-inf,2,3]", "[-inf, 2, 3]"},
                                     {"[1,[2],true]", "[1, [...], true]"}}) {
    const std::string points =
        "polyhedron(points = [[0,0,0],[3,0,0],[0,4,0],[0,0,5]," + std::string(point) + "], ";
    // The points from the bad one on are ignored.
    const std::string late = points + "faces = [[0,1,2],[0,3,1],[0,2,3],[1,3,2,4,0],[4,4,9]]);";
    EXPECT_EQ(warning_of(late), "a.csg:1:1: warning: polyhedron: Unable to convert points[4] = " +
                                    std::string(words) +
                                    " to a vec3 of numbers, and the faces from there on are left "
                                    "out (it must be a list of three finite numbers)");
    expect_box(box_of(only_primitive(late)), Vec3(0.0), Vec3(3, 4, 5), 0);
    const std::string early = points + "faces = [[0,1,2],[1,3,2,4,1],[0,2,3],[0,3,1]]);";
    EXPECT_EQ(import_text(early).scene.primitives.at(0).mesh()->triangles().size(), 2u);
    EXPECT_THAT(warnings_of(early), ElementsAre(HasSubstr("Unable to convert points[4]"),
                                                HasSubstr("is not closed: 4 edges")));
    // No face uses the point.
    EXPECT_THAT(warnings_of(points + kFaces + ");"), IsEmpty()) << point;
  }
}

TEST(ImporterPolyhedron, OfManyFacesIsAMesh) {
  // Two apexes and a ring: convex, with n + 2 vertices and 2n faces.
  constexpr int kRing = 2048;
  std::string points = "[0,0,1],[0,0,-1]", faces;
  for (int i = 0; i < kRing; ++i) {
    const double angle = 2 * M_PI * i / kRing;
    const std::string a = std::to_string(2 + i), b = std::to_string(2 + (i + 1) % kRing);
    points += ",[" + std::to_string(std::cos(angle)) + "," + std::to_string(std::sin(angle)) + "]";
    faces += (i == 0 ? "[" : ",[") + b + "," + a + ",0],[" + a + "," + b + ",1]";
  }
  const Primitive primitive = only_primitive("polyhedron([" + points + "],[" + faces + "]);");
  ASSERT_EQ(primitive.shape(), csgcore::Shape::kMesh);
  EXPECT_TRUE(primitive.mesh()->is_closed());
}

TEST(ImporterPolyhedron, HasSheetsOnceThatRunBothWays) {
  const Primitive open =
      only_primitive("polyhedron(" + kCorner + "faces = [[0,1,2],[2,1,0],[0,1,3]]);");
  EXPECT_EQ(open.mesh()->triangles().size(), 2u);
}

TEST(ImporterPolyhedron, ListsThatAreNoneCountAsMissing) {
  EXPECT_THAT(
      warnings_of("polyhedron(points = 3, faces = [[0,1]]);"),
      ElementsAre(
          HasSubstr("points is a number, and counts as missing (it must be a list)"),
          HasSubstr("Point index 0 is out of bounds (from faces[0][0]), and is left out; the "
                    "first of 2 (there are no points)")));
  EXPECT_THAT(warning_of("polyhedron([], true);"), HasSubstr("faces is a boolean"));
  EXPECT_THAT(warning_of("polyhedron([], triangles = true);"), HasSubstr("triangles is a boolean"));
}

TEST(ImporterPrimitives, PolyhedraThatAreTheEmptySetCount) {
  const std::string infinite = "polyhedron([[inf,0,0],[3,0,0],[0,4,0],[0,0,1]], " + kFaces + ");";
  const std::string nan = "polyhedron([[nan,0,0],[3,0,0],[0,4,0],[0,0,1]], " + kFaces + ");";
  const std::string flattened =
      "multmatrix([[inf,0,0,0]]) { polyhedron(" + kCorner + "faces = [[0,1,2]]); }";
  for (const std::string& empty :
       {std::string("cube(0);"), std::string("cube([1, -1, 1]);"),
        std::string("cube([-1, -1, 1]);"), std::string("cube([1, 0, 1], center = true);"),
        std::string("cube(inf);"), std::string("cube([1, nan, 1]);"), std::string("polyhedron();"),
        std::string("polyhedron([[1,2,3]], []);"), infinite, nan, flattened}) {
    EXPECT_EQ(model_of(empty + "sphere();"), "1") << empty;
    EXPECT_EQ(model_of("difference() { " + empty + " sphere(); }"), "-") << empty;
    EXPECT_EQ(import_text(empty).primitive_nodes, 1u) << empty;
  }
}

}  // namespace
}  // namespace frontend
