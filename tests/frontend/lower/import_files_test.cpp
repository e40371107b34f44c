// Tests import() and surface().
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "csgcore/canonical_primitive.hpp"
#include "csgcore/polyhedron.hpp"
#include "csgcore/triangle_mesh.hpp"
#include "lower/imported_text.hpp"
#include "temporary_folder.hpp"

namespace frontend {
namespace {

using csgcore::Primitive;
using csgcore::Shape;
using csgcore::Vec3;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

/// A tetrahedron, and the same with its first corner at x.
std::string off_from(const std::string& x) {
  return "OFF 4 4 0\n" + x + " 0 0\n3 0 0\n0 4 0\n0 0 5\n3 2 1 0\n3 1 3 0\n3 3 2 0\n3 2 3 1\n";
}
/// The tetrahedron with a dent.
const std::string kDented =
    "OFF 5 6 0\n0 0 0\n3 0 0\n0 4 0\n0 0 5\n.5 .5 .5\n"
    "3 2 1 0\n3 1 3 0\n3 3 2 0\n3 2 3 4\n3 3 1 4\n3 1 2 4\n";

class ImporterFiles : public testing::Test {
 protected:
  ImportedDesign import(const std::string& text) {
    return import_text(text, {.folder = folder.path()});
  }
  std::vector<std::string> warnings(const std::string& text) {
    std::vector<std::string> texts;
    for (const Warning& warning : import(text).warnings) texts.push_back(warning.text);
    return texts;
  }
  TemporaryFolder folder;
};

TEST_F(ImporterFiles, AreCenteredByTheRulesOf2026) {
  folder.write("a.off", off_from("0"));
  folder.write("a.obj", "v 0 0 0\nv 3 0 0\nv 0 4 0\nv 0 0 5\nf 3 2 1\nf 2 4 1\nf 4 3 1\nf 2 3 4\n");
  folder.write("a.dxf",
               "0\nSECTION\n2\nENTITIES\n0\nCIRCLE\n10\n7\n20\n9\n40\n2\n0\nENDSEC\n0\nEOF\n");
  for (const char* const file : {"a.off", "a.obj"}) {
    const ImportedDesign design = import(std::string("import(\"") + file + "\", center = true);");
    EXPECT_THAT(design.warnings, IsEmpty());
    expect_box(design.view_box, Vec3(-1.5, -2, -2.5), Vec3(1.5, 2, 2.5), 1e-12);
    const ImportedDesign other = import(std::string("import(\"") + file + "\", center = false);");
    expect_box(other.view_box, Vec3(0, 0, 0), Vec3(3, 4, 5), 1e-12);
  }
  EXPECT_THAT(warnings("import(\"a.obj\");"), ElementsAre(HasSubstr("Unsupported file format")))
      << "2021.01 does not know it, and writes no center";
  const csgcore::Box box = import("import(\"a.dxf\", center = true);").view_box;
  EXPECT_NEAR(box.center().x, 0, 1e-9);
  EXPECT_NEAR(box.center().y, 0, 1e-9);
}

TEST_F(ImporterFiles, AreReadByTheLanguagesRules) {
  folder.write("a.obj", "v 0 0 0\nv 3 0 0\nv 0 4 0\nv 0 0 5\nf 3 2 1\nf 2 4 1\nf 4 3 1\nf 2 3 4\n");
  folder.write("a.svg",
               "<svg><defs><rect id=\"r\" width=\"3\" height=\"2\"/></defs>"
               "<use href=\"#r\"/><rect id=\"s\" x=\"9\" width=\"1\" height=\"1\"/></svg>");
  const auto box = [&](const std::string& text) {
    return import_text(text,
                       {.language = language::LanguageVersion::k2026, .folder = folder.path()})
        .view_box;
  };
  expect_box(box("import(\"a.obj\");"), Vec3(0, 0, 0), Vec3(3, 4, 5), 1e-12);
  expect_box(box("linear_extrude(1) { import(\"a.svg\"); }"), Vec3(0, -2, 0), Vec3(10, 0, 1), 1e-9);
  expect_box(box("linear_extrude(1) { import(\"a.svg\", id = \"s\"); }"), Vec3(9, -1, 0),
             Vec3(10, 0, 1), 1e-9);
  expect_box(box("linear_extrude(1) { import(\"a.svg\", id = \"r\"); }"), Vec3(0, -2, 0),
             Vec3(3, 0, 1), 1e-9);
  expect_box(import("linear_extrude(1) { import(\"a.svg\"); }").view_box, Vec3(9, -1, 0),
             Vec3(10, 0, 1), 1e-9);
}

TEST_F(ImporterFiles, Of2026CloseGapsOfTheGrid) {
  const auto facet = [](const std::string& a, const std::string& b, const std::string& c) {
    return "facet normal 0 0 0\nouter loop\nvertex " + a + "\nvertex " + b + "\nvertex " + c +
           "\nendloop\nendfacet\n";
  };
  const auto write = [&](const std::string& top) {
    folder.write("a.stl", "solid\n" + facet("0 0 0", "0 1 0", "1 0 0") +
                              facet("0 0 0", "1 0 0", "0 0 1") + facet("0 0 0", "0 0 1", "0 1 0") +
                              facet("1 0 0", "0 1 0", top) + "endsolid\n");
  };
  const auto warnings_in = [&](language::LanguageVersion language) {
    return import_text("import(\"a.stl\");", {.language = language, .folder = folder.path()})
        .warnings;
  };
  for (const char* const near : {"0 0 1.0000001", "9e-7 0 1", "0 -9e-7 1.0000015"}) {
    write(near);
    EXPECT_THAT(warnings_in(language::LanguageVersion::k2026), IsEmpty()) << near;
    EXPECT_THAT(warnings_in(language::LanguageVersion::k2021), SizeIs(1)) << near;
  }
  write("0 0 1.000004");
  EXPECT_THAT(warnings_in(language::LanguageVersion::k2026), SizeIs(1));
}

TEST_F(ImporterFiles, HaveColorsWhereNoColorStandsAbove) {
  constexpr language::LanguageVersion k2026 = language::LanguageVersion::k2026;
  const std::string corner = "OFF\n4 4 0\n0 0 0\n3 0 0\n0 4 0\n0 0 5\n";
  folder.write("red.off",
               corner + "3 2 1 0 255 0 0\n3 1 3 0 255 0 0\n3 3 2 0 255 0 0\n3 2 3 1 255 0 0\n");
  folder.write("two.off", corner + "3 2 1 0 255 0 0\n3 1 3 0\n3 3 2 0 0 255 0\n3 2 3 1\n");
  const auto primitive = [&](const std::string& text, ImportOptions options) {
    options.folder = folder.path();
    return import_text(text, options).scene.primitives.at(0);
  };
  const csgcore::Color red{1, 0, 0, 1}, blue{0, 0, 1, 1};
  const Primitive whole = primitive("import(\"red.off\");", {.language = k2026});
  EXPECT_EQ(whole.color, red);
  EXPECT_TRUE(whole.polyhedron()) << "one colour costs no mesh";
  EXPECT_EQ(primitive("color([0, 0, 1]) { import(\"red.off\"); }", {.language = k2026}).color,
            blue);
  EXPECT_FALSE(primitive("import(\"red.off\");", {}).color) << "2021.01";
  EXPECT_EQ(
      primitive("import(\"red.off\");", {.language = k2026, .picture = PictureKind::kRendered})
          .color,
      red);
  const Primitive faces = primitive("import(\"two.off\");", {.language = k2026});
  EXPECT_FALSE(faces.color);
  ASSERT_TRUE(faces.mesh());
  ASSERT_EQ(faces.mesh()->colors().size(), 4u);
  const csgcore::TriangleMesh& mesh = *faces.mesh();
  const auto color_at = [&](const Vec3& point) {
    const auto& [center, scale] = mesh.canonical();
    const Vec3 local = point / std::ldexp(1.0, std::ilogb(5.0));  // meshes are of unit size
    return mesh.color_at((local - center) / scale);
  };
  EXPECT_EQ(color_at({1, 1, 0}), red);
  EXPECT_EQ(color_at({0, 1, 1}), (csgcore::Color{0, 1, 0, 1}));
  EXPECT_EQ(color_at({1, 0, 1}), std::nullopt);
  EXPECT_EQ(primitive("color([0, 0, 1]) { import(\"two.off\"); }", {.language = k2026}).color,
            blue);
}

TEST_F(ImporterFiles, AreFoundInTheDesignsFolder) {
  folder.write("a.off", off_from("0"));
  folder.write("B.OFF", kDented);
  const ImportedDesign design = import(
      "import(\"a.off\"); import(convexity = 3, layer = \"x\", file = \"./B.OFF\", origin = [5, "
      "5], "
      "scale = 2);  import(\"" +
      folder / "a.off" + "\");");
  EXPECT_THAT(design.warnings, IsEmpty());
  const std::vector<Primitive>& primitives = design.scene.primitives;
  ASSERT_THAT(primitives, SizeIs(3));
  EXPECT_EQ(primitives[0].shape(), Shape::kPolyhedron);
  ASSERT_EQ(primitives[1].shape(), Shape::kMesh);
  expect_box(csgcore::canonicalize(primitives[1]).bounds, Vec3(0.0), Vec3(3, 4, 5), 1e-15);
  EXPECT_EQ(primitives[1].id, 1u);
  EXPECT_EQ(primitives[2].polyhedron(), primitives[0].polyhedron());
  EXPECT_THAT(design.files, ElementsAre(folder / "B.OFF", folder / "a.off"));
}

TEST_F(ImporterFiles, ShareOneMesh) {
  folder.write("a.off", kDented);
  folder.write("b.off", kDented + "# a comment");
  std::string text = "import(\"b.off\");";
  for (int i = 0; i < 100; ++i) {
    text += "multmatrix([[1,0,0," + std::to_string(9 * i) + "]]) { import(\"a.off\"); }";
  }
  const ImportedDesign design = import(text);
  ASSERT_THAT(design.scene.primitives, SizeIs(101));
  for (const Primitive& primitive : design.scene.primitives) {
    EXPECT_EQ(primitive.mesh(), design.scene.primitives[0].mesh());
  }
}

TEST_F(ImporterFiles, ThatAreMissingAreEmpty) {
  const ImportedDesign design =
      import("sphere();\n import(\"gone.stl\"); import(\"away.stl\"); surface(\"gone.dat\");");
  ASSERT_THAT(design.warnings, SizeIs(3));
  EXPECT_EQ(design.warnings[0].text,
            "a.csg:2:2: warning: import: Can't open import file '" + folder / "gone.stl" +
                "' (check its name; it is relative to the design's folder)");
  EXPECT_EQ(design.warnings[2].text,
            "a.csg:2:42: warning: surface: The file '" + folder / "gone.dat" +
                "' couldn't be opened (check its name; it is relative to the design's folder)");
  EXPECT_THAT(design.files,
              ElementsAre(folder / "away.stl", folder / "gone.dat", folder / "gone.stl"));
  EXPECT_EQ(model_of("difference() { import(\"gone.stl\"); sphere(); }"), "-");
  EXPECT_EQ(model_of("difference() { sphere(); import(\"gone.stl\"); }"), "0");
}

TEST_F(ImporterFiles, ThatAreNoFilesAreNotWaitedFor) {
  ASSERT_EQ(mkfifo((folder / "pipe.stl").c_str(), 0600), 0);
  for (const char* name : {"pipe.stl", ".", "/dev/zero", ""}) {
    EXPECT_THAT(warnings("surface(\"" + std::string(name) + "\");"),
                ElementsAre(HasSubstr("couldn't be opened")))
        << name;
  }
  EXPECT_THAT(warnings("import(\"pipe.stl\");"), ElementsAre(HasSubstr("Can't open")));
}

TEST_F(ImporterFiles, OfOtherKindsAreNotDrawn) {
  EXPECT_THAT(
      warnings("import(\"a.obj\"); import(\"a.obj\");"),
      ElementsAre("a.csg:1:1: warning: import: Unsupported file format while trying to "
                  "import file '\"a.obj\"'; the first of 2 (convert it to .stl, .off, .amf, "
                  ".3mf, .nef3, .svg or .dxf)"));
  EXPECT_EQ(model_of("intersection() { sphere(); import(\"a.obj\"); }"), "-");
}

TEST_F(ImporterFiles, MayBeDrawings) {
  folder.write("a.svg", "<svg><rect width=\"4\" height=\"2\"/></svg>");
  folder.write("b.dxf",
               "0\nSECTION\n2\nENTITIES\n0\nCIRCLE\n8\nL\n10\n5\n20\n0\n40\n2\n0\nENDSEC\n");
  const ImportedDesign plate = import("import(\"a.svg\", center = true);");
  EXPECT_THAT(plate.warnings, IsEmpty());
  EXPECT_EQ(plate.primitive_nodes, 1u);
  ASSERT_THAT(plate.scene.primitives, SizeIs(1));
  expect_box(csgcore::canonicalize(plate.scene.primitives[0]).bounds, Vec3(-2, -1, -0.5),
             Vec3(2, 1, 0.5), 1e-12);
  const ImportedDesign design = import(
      "import(\"a.svg\"); linear_extrude(height = 3) import(\"a.svg\"); "
      "linear_extrude(file = \"b.dxf\", layer = \"L\", height = 3, scale = [2, 2]); "
      "rotate_extrude(file = \"b.dxf\", layer = \"L\", origin = [0, 0], scale = 1); "
      "difference() { cube(1); import(\"b.dxf\", layer = \"M\"); }");
  EXPECT_THAT(design.warnings, IsEmpty());
  EXPECT_EQ(design.primitive_nodes, 6u);
  ASSERT_THAT(design.scene.primitives, SizeIs(5));
  EXPECT_THAT(design.files, ElementsAre(folder / "a.svg", folder / "b.dxf"));
  // The scale acts on the drawing, and on the top.
  const csgcore::Box cone = csgcore::canonicalize(design.scene.primitives[2]).bounds;
  EXPECT_NEAR(cone.max.x, 28, 1e-6);
  EXPECT_NEAR(cone.min.x, 6, 1e-6);
}

TEST_F(ImporterFiles, ThatAreMissingDrawingsAreTold) {
  EXPECT_THAT(warnings("import(\"a.dxf\");"),
              ElementsAre(HasSubstr("Can't open DXF file '" + folder / "a.dxf")));
  EXPECT_THAT(warnings("import(\"a.svg\"); import(\"a.svg\");"),
              ElementsAre(HasSubstr("Can't open file '")));
  EXPECT_THAT(warnings("linear_extrude(file = \"a.svg\");"),
              ElementsAre(HasSubstr("Can't open DXF file '")));
  EXPECT_EQ(model_of("intersection() { sphere(); import(\"a.svg\"); }"), "-");
}

TEST_F(ImporterFiles, SayWhatIsWrongWithThem) {
  folder.write("a.stl", "solid x\nouter loop\nvertex 1 2 x\n");
  folder.write("a.amf", "none");
  folder.write("b.stl",
               "solid x\nouter loop\nvertex 1 2 3\nvertex 2 2 3\nvertex 5 inf 5\n"
               "endloop\nendfacet\nendsolid x\n");
  EXPECT_THAT(warnings("import(\"a.stl\");"),
              ElementsAre("a.csg:1:1: warning: import: STL line 3, can't parse vertex line 'vertex "
                          "1 2 x' importing file '" +
                          folder / "a.stl" + "' (the file is damaged: export it again)"));
  EXPECT_THAT(warnings("import(\"a.amf\");"), ElementsAre(HasSubstr("Failed to parse file '")));
  EXPECT_THAT(warnings("import(\"b.stl\");"),
              ElementsAre(HasSubstr("1 face of '" + folder / "b.stl" +
                                    "' with coordinates that are not finite is left out")));
  folder.write("c.off", "OFF 3 1 0\n0 0 0 1 0 0 0 1 0\n3 0 1 2\n");
  folder.write("d.off", "OFF 3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  EXPECT_THAT(warnings("import(\"c.off\");"), ElementsAre(HasSubstr("is not in OFF")));
  EXPECT_THAT(warnings("import(\"d.off\");"),
              ElementsAre(HasSubstr("import is not closed: 3 edges of 'd.off' have a face")));
}

TEST_F(ImporterFiles, AreEachToldOf) {
  folder.write("open1.off", "OFF 3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  folder.write("open2.off", "OFF 3 1 0\n0 0 0\n1 0 0\n0 2 0\n3 0 1 2\n");
  EXPECT_THAT(
      warnings("import(\"a.stl\"); import(\"b.stl\"); import(\"a.stl\"); surface(\"a.dat\"); "
               "surface(\"b.png\"); import(\"open1.off\"); import(\"open2.off\"); "
               "import(\"open2.off\");"),
      ElementsAre(
          AllOf(HasSubstr("Can't open import file"), HasSubstr("a.stl'; the first of 2")),
          AllOf(HasSubstr("Can't open import file"), HasSubstr("b.stl' (")),
          HasSubstr("a.dat' couldn't be opened ("), HasSubstr("b.png' couldn't be opened ("),
          HasSubstr("3 edges of 'open1.off' have a face on one side only ("),
          HasSubstr("3 edges of 'open2.off' have a face on one side only; the first of 2")));
}

TEST_F(ImporterFiles, BeyondAllSizesAreLeftOut) {
  for (const std::string number : {"1e100", "1e150", "-1e200", "1e300", "1.7e308"}) {
    folder.write("a.dat", number + " 0\n0 0\n");
    folder.write("a.off", off_from(number));
    folder.write("a.stl", "solid\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 " + number +
                              "\nendloop\nendfacet\nendsolid\n");
    for (const std::string design :
         {"surface(\"a.dat\");", "import(\"a.off\");", "import(\"a.stl\");",
          "hull() { surface(\"a.dat\"); }", "projection(cut = false) { surface(\"a.dat\"); }"}) {
      EXPECT_THAT(warnings(design), ElementsAre(HasSubstr("are too large"))) << number << design;
    }
  }
  folder.write("a.dat", "1e10 0\n0 0\n");
  EXPECT_THAT(warnings("surface(\"a.dat\");"), IsEmpty());
  folder.write("a.dat", "1.7e308 1.7e308\n1.7e308 1.7e308\n");
  EXPECT_THAT(warnings("surface(\"a.dat\");"), SizeIs(1));
}

TEST_F(ImporterFiles, WithoutVolumeAreSheets) {
  folder.write("a.dat", "1 2 3\n");
  const ImportedDesign design = import("surface(\"a.dat\");");
  ASSERT_THAT(design.warnings, SizeIs(1));
  EXPECT_THAT(design.warnings[0].text, HasSubstr("surface: 'a.dat' has no volume"));
  ASSERT_THAT(design.scene.primitives, SizeIs(1));
  EXPECT_FALSE(design.scene.primitives[0].mesh()->is_closed());
}

TEST_F(ImporterFiles, OfHeightsAreSolids) {
  folder.write("a.dat", "1 2\n3 9\n2 2\n");
  const ImportedDesign design = import(
      "surface(\"a.dat\"); surface(file = \"a.dat\", center = true, invert = true, convexity = 5); "
      "surface(\"a.dat\", true);");
  EXPECT_THAT(design.warnings, IsEmpty());
  const std::vector<Primitive>& primitives = design.scene.primitives;
  ASSERT_THAT(primitives, SizeIs(3));
  expect_box(csgcore::canonicalize(primitives[0]).bounds, Vec3(0.0), Vec3(1, 2, 9), 1e-14);
  expect_box(csgcore::canonicalize(primitives[1]).bounds, Vec3(-0.5, -1, 0), Vec3(0.5, 1, 9),
             1e-14);
  EXPECT_EQ(primitives[1].mesh(), primitives[2].mesh());
}

TEST_F(ImporterFiles, ThatFaceInwardsAreMagentaThrownTogether) {
  folder.write("a.off", kDented);
  folder.write("b.off",
               "OFF 4 4 0\n0 0 0\n3 0 0\n0 4 0\n0 0 5\n3 0 1 2\n3 0 3 1\n3 0 2 3\n3 1 3 2\n");
  const ImportedDesign design =
      import_text("import(\"a.off\"); import(\"b.off\");",
                  {.folder = folder.path(), .picture = PictureKind::kThrownTogether});
  EXPECT_FALSE(design.scene.primitives.at(0).color);
  EXPECT_EQ(design.scene.primitives.at(1).color, kSeenFromWithin);
}

}  // namespace
}  // namespace frontend
