// Tests the readers of imported files, on files that files/make_files has written.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <limits>
#include <random>

#include "csgcore/triangle_mesh.hpp"
#include "export/zip_writer.hpp"
#include "frontend/files.hpp"
#include "meshes/height_map.hpp"
#include "meshes/read_solid_file.hpp"
#include "meshes/zip_archive.hpp"
#include "temporary_folder.hpp"

namespace frontend {
namespace {

using ::testing::DoubleNear;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::Pointwise;
using ::testing::SizeIs;

std::string content_of(const std::string& name) {
  return std::string(read_file(std::string(SCADRAY_MESH_FILES) + "/" + name).view());
}

using Reader = SolidFile (*)(std::string_view bytes, const std::string& name);
struct Case {
  const char* name;
  Reader read;
};
constexpr Case kSteps[] = {{"step.stl", read_stl},        {"step_text.stl", read_stl},
                           {"step.off", read_off},        {"step.amf", read_amf},
                           {"step_zipped.amf", read_amf}, {"step.3mf", read_3mf}};
constexpr const char* kPictures[] = {"gray8.png", "gray4.png", "gray16.png",  "alpha.png",
                                     "rgb.png",   "rgba.png",  "palette.png", "interlaced.png"};

/// A mesh of what a file has; null if it is empty.
std::unique_ptr<csgcore::TriangleMesh> mesh_of(FaceSet faces) {
  tidy(faces);
  if (faces.face_count() == 0) return nullptr;
  std::vector<csgcore::TriangleMesh::Triangle> triangles = triangles_of(faces);
  return std::make_unique<csgcore::TriangleMesh>(std::move(faces.points), std::move(triangles));
}

TEST(MeshFiles, HoldTheSameStepInEveryFormat) {
  for (const Case& format : kSteps) {
    SCOPED_TRACE(format.name);
    SolidFile file = format.read(content_of(format.name), format.name);
    EXPECT_EQ(file.problem, "");
    tidy(file.faces);
    EXPECT_THAT(file.faces.points, SizeIs(12));
    EXPECT_NEAR(enclosed_volume(file.faces), 12, 1e-12);
    const auto mesh = mesh_of(std::move(file.faces));
    EXPECT_THAT(mesh->triangles(), SizeIs(20));
    EXPECT_TRUE(mesh->is_closed());
  }
}

TEST(MeshFiles, ObjHasPointsAndFaces) {
  const std::string points = "# a tetrahedron\nv 0 0 0 1\nv 3 0 0\r\n v 0 4 0\nvn 0 0 1\nv 0 0 5\n";
  const SolidFile file =
      read_obj(points + "f 3/1 2/1 1/1\nf 2//1 4//1 1//1\nf 4 3 1\nf -3 -2 -1", "a.obj");
  EXPECT_EQ(file.problem, "");
  EXPECT_NEAR(enclosed_volume(file.faces), 10, 1e-12);
  EXPECT_EQ(file.faces.face_count(), 4u);
  const SolidFile wrong = read_obj(points + "f 3 2 1 5\nv 1 x 0\nf 2 4 1\n", "a.obj");
  EXPECT_EQ(wrong.problem, "Index out of range in 'f 3 2 1 5', line 7 of 'a.obj'");
  EXPECT_THAT(wrong.faces.corners, ElementsAre(2, 1, 0, 1, 3, 0));
  EXPECT_EQ(read_obj("v 1 x 0", "a.obj").problem, "Unrecognized Line 'v 1 x 0', line 1 of 'a.obj'");
}

/// A package whose model has a tetrahedron of volume 10, as object 1, and what else is given.
std::string package_3mf(const std::string& objects, const std::string& build) {
  const std::string model =
      "<m:model xmlns:m=\"x\"><m:resources><m:object id=\"1\"><m:mesh><m:vertices>"
      "<m:vertex x=\"0\" y=\"0\" z=\"0\"/><m:vertex x=\"3\" y=\"0\" z=\"0\"/>"
      "<m:vertex x=\"0\" y=\"4\" z=\"0\"/><m:vertex x=\"0\" y=\"0\" z=\"5\"/></m:vertices>"
      "<m:triangles><m:triangle v1=\"2\" v2=\"1\" v3=\"0\"/><m:triangle v1=\"1\" v2=\"3\" "
      "v3=\"0\"/>"
      "<m:triangle v1=\"3\" v2=\"2\" v3=\"0\"/><m:triangle v1=\"1\" v2=\"2\" "
      "v3=\"3\"/></m:triangles>"
      "</m:mesh></m:object>" +
      objects + "</m:resources><m:build>" + build + "</m:build></m:model>";
  return zip_of(std::vector<ZippedFile>{{"3D/3dmodel.model", model}});
}

TEST(MeshFiles, BuiltOf3mfHasItemsAndComponentsUnderTheirTransformations) {
  const std::string pair =
      "<m:object id=\"2\"><m:components><m:component objectid=\"1\"/>"
      "<m:component objectid=\"1\" transform=\"-1 0 0 0 1 0 0 0 1 -10 0 "
      "0\"/></m:components></m:object>";
  const auto read = [](const std::string& bytes) { return read_built_3mf(bytes, "a.3mf"); };
  SolidFile file = read(package_3mf(
      pair,
      "<m:item objectid=\"2\" transform=\"2 0 0 0 1 0 0 0 1 0 100 0\"/><m:item objectid=\"1\"/>"));
  EXPECT_EQ(file.problem, "");
  EXPECT_EQ(file.faces.face_count(), 12u);
  EXPECT_NEAR(enclosed_volume(file.faces), 10 + 2 * (10 + 10), 1e-9);
  // x is mirrored and moved by the component, and then doubled by the item, which moves y.
  EXPECT_THAT(file.faces.points, testing::Contains(csgcore::Vec3(-26, 100, 0)));
  EXPECT_EQ(read_3mf(package_3mf(pair, ""), "a.3mf").faces.face_count(), 4u) << "without a build";
  EXPECT_EQ(read(package_3mf(pair, "")).faces.face_count(), 0u);
  EXPECT_EQ(read(package_3mf("", "<m:item objectid=\"7\"/>")).problem,
            "Could not read file 'a.3mf'");
  // An object of itself, and one that doubles itself 40 times.
  std::string doubled;
  for (int i = 2; i < 42; ++i) {
    const std::string part = "<m:component objectid=\"" + std::to_string(i - 1) + "\"/>";
    doubled += "<m:object id=\"" + std::to_string(i) + "\"><m:components>" + part + part +
               "</m:components></m:object>";
  }
  EXPECT_NE(read(package_3mf(doubled, "<m:item objectid=\"41\"/>")).problem, "");
  const std::string own =
      "<m:object id=\"2\"><m:components><m:component objectid=\"2\"/></m:components></m:object>";
  EXPECT_NE(read(package_3mf(own, "<m:item objectid=\"2\"/>")).problem, "");
}

/// Writes each face's colour in 255ths, "-" where it has none.
std::vector<std::string> colors_of(const FaceSet& faces) {
  std::vector<std::string> texts;
  for (const std::optional<csgcore::Color>& color : faces.colors) {
    std::string& text = texts.emplace_back(color ? "" : "-");
    if (!color) continue;
    for (const float channel : {color->r, color->g, color->b, color->a}) {
      text += (text.empty() ? "" : " ") + std::to_string(static_cast<int>(255 * channel + 0.01f));
    }
  }
  return texts;
}

// What OpenSCAD 2025.07.18 makes of the same files was looked at.
TEST(MeshFiles, Of3mfHaveColors) {
  const std::string model =
      "<model><resources><basematerials id=\"9\"><base displaycolor=\"#FF0000\"/>"
      "<base displaycolor=\"#00FF0080\"/></basematerials><m:colorgroup id=\"8\">"
      "<m:color color=\"#0000ff\"/><m:color color=\"#FFFF0040\"/><m:color "
      "color=\"blue\"/></m:colorgroup>"
      "<object id=\"1\" pid=\"8\" pindex=\"1\"><mesh><vertices><vertex x=\"0\"/><vertex x=\"3\"/>"
      "<vertex y=\"4\"/><vertex z=\"5\"/></vertices><triangles>";
  std::string triangles;
  for (const char* const given :
       {"", "p1=\"0\"", "pid=\"9\" p1=\"1\"", "pid=\"9\" p1=\"7\"", "pid=\"8\" p1=\"2\"",
        "pid=\"8\" p1=\"0\" p2=\"1\" p3=\"1\"", "pid=\"8\" p1=\"0\" p2=\"1\"",
        "pid=\"9\" p1=\"0\" p2=\"1\" p3=\"1\"", "pid=\"5\" p1=\"0\""}) {
    triangles += "<triangle v1=\"0\" v2=\"1\" v3=\"2\" " + std::string(given) + "/>";
  }
  const std::string end =
      "</triangles></mesh></object></resources><build><item objectid=\"1\"/></build></model>";
  const std::string package =
      zip_of(std::vector<ZippedFile>{{"3D/3dmodel.model", model + triangles + end}});
  EXPECT_THAT(colors_of(read_built_3mf(package, "a.3mf").faces),
              testing::ElementsAre("255 255 0 64", "255 255 0 64", "0 255 0 255", "-", "-",
                                   "170 170 85 127", "85 85 170 191", "255 0 0 255", "-"));
  EXPECT_THAT(read_3mf(package, "a.3mf").faces.colors, testing::IsEmpty());
}

TEST(MeshFiles, Of3mfMayHaveObjectsInOtherModels) {
  const std::string other =
      "<model><resources><object id=\"1\"><mesh><vertices><vertex x=\"0\"/><vertex x=\"3\"/>"
      "<vertex y=\"4\"/><vertex z=\"5\"/></vertices><triangles><triangle v1=\"2\" v2=\"1\" "
      "v3=\"0\"/>"
      "</triangles></mesh></object></resources></model>";
  const auto package = [&](const std::string& path) {
    const std::string main = "<model><resources><object id=\"1\"><components><component p:path=\"" +
                             path +
                             "\" objectid=\"1\" transform=\"1 0 0 0 1 0 0 0 1 5 0 "
                             "0\"/></components></object></resources>"
                             "<build><item objectid=\"1\"/><item p:path=\"" +
                             path + "\" objectid=\"1\"/></build></model>";
    return zip_of(
        std::vector<ZippedFile>{{"3D/3dmodel.model", main}, {"3D/Objects/o.model", other}});
  };
  const SolidFile file = read_built_3mf(package("/3D/Objects/o.model"), "a.3mf");
  EXPECT_EQ(file.problem, "");
  EXPECT_EQ(file.faces.face_count(), 2u);
  EXPECT_THAT(file.faces.points, testing::Contains(csgcore::Vec3(8, 0, 0)));
  EXPECT_NE(read_built_3mf(package("/3D/no.model"), "a.3mf").problem, "");
}

TEST(Off, HasColorsBehindItsCorners) {
  const std::string text =
      "OFF\n4 8 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1 255 0 0\n3 0 1 3 0 0.5 1.0 0.25 # half\n"
      "3 0 3 2 1 1 1.\n3 1 2 3 5\n3 1 2 3\n3 1 2 3 300 0 0 9 9\n3 1 2 3 -1 0 0\n3 1 2 3 # 1 2 3\n";
  const SolidFile file = read_colored_off(text, "a.off");
  EXPECT_EQ(file.problem, "");
  EXPECT_THAT(colors_of(file.faces),
              testing::ElementsAre("255 0 0 255", "0 127 255 63", "1 1 255 255", "-", "-",
                                   "255 0 0 9", "-", "-"));
  EXPECT_THAT(read_off(text, "a.off").faces.colors, testing::IsEmpty());
}

TEST(Off, By2026LosesCornersWithoutAPoint) {
  const std::string text = "OFF\n4 2 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n4 0 2 9 1\n3 0 1 3\n";
  const SolidFile file = read_colored_off(text, "a.off");
  EXPECT_THAT(file.problem, testing::HasSubstr("ignored bad face vertex index: '9'"));
  EXPECT_THAT(file.faces.corners, testing::ElementsAre(0, 2, 1, 0, 1, 3));
  EXPECT_EQ(read_off(text, "a.off").faces.face_count(), 0u) << "2021.01";
}

TEST(FaceSets, KeepTheColorsOfTheirFaces) {
  FaceSet faces = read_colored_off(
                      "OFF\n5 3 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 1 0\n2 0 1 255 0 0\n"
                      "4 0 1 2 3 0 255 0\n3 0 2 4 0 0 255\n",
                      "a.off")
                      .faces;
  EXPECT_EQ(tidy(faces), 0u);
  EXPECT_THAT(colors_of(faces), testing::ElementsAre("0 255 0 255", "0 0 255 255"));
  std::vector<std::optional<csgcore::Color>> colors;
  EXPECT_EQ(triangles_of(faces, colors).size(), 3u);
  ASSERT_EQ(colors.size(), 3u);
  EXPECT_EQ(colors[1], faces.colors[0]);
  EXPECT_EQ(colors[2], faces.colors[1]);
  EXPECT_FALSE(take_common_color(faces));
  faces.colors[0] = faces.colors[1];
  EXPECT_EQ(take_common_color(faces)->b, 1);
  EXPECT_THAT(faces.colors, testing::IsEmpty());
}

TEST(MeshFiles, AnotherFormatIsNone) {
  EXPECT_EQ(read_stl("garbage", "a.stl").problem, "'a.stl' is no STL: nothing is read");
  EXPECT_EQ(read_off("garbage", "a.off").problem, "The file 'a.off' is not in OFF");
  EXPECT_EQ(read_amf("garbage", "a.amf").problem, "Failed to parse file 'a.amf'");
  EXPECT_EQ(read_3mf("garbage", "a.3mf").problem, "Could not read file 'a.3mf'");
  for (const Case& format : kSteps) {
    EXPECT_EQ(format.read("", "a").faces.face_count(), 0u);
    for (const Case& other : kSteps) {
      if (format.read == other.read) continue;
      EXPECT_EQ(format.read(content_of(other.name), "a").faces.face_count(), 0u)
          << format.name << " as " << other.name;
    }
  }
}

/// A block of 10 by 10 by 10 with a hole through it from x = 2 to 5 and from y = 2 to 6.1, which
/// OpenSCAD cuts to a multiple of 2^-20.
TEST(Nef3, HasFacesWithHolesAndFractions) {
  SolidFile file = read_nef3(content_of("frame.nef3"), "frame.nef3");
  EXPECT_EQ(file.problem, "");
  tidy(file.faces);
  EXPECT_THAT(file.faces.points, SizeIs(16));
  EXPECT_NEAR(enclosed_volume(file.faces), 1000 - 3 * (6396313 / 1048576.0 - 2) * 10, 1e-9);
  const auto mesh = mesh_of(std::move(file.faces));
  EXPECT_THAT(mesh->triangles(), SizeIs(4 * 2 + 4 * 2 + 2 * 8));
  EXPECT_TRUE(mesh->is_closed());
}

TEST(Nef3, OfLongNumbersIsExact) {
  const std::string text = content_of("frame.nef3");
  const std::string from = "| 10 10 10 1 }";
  // 1/3 and 3, each with 40 digits.
  const std::string thirds = "| " + std::string(40, '1') + ' ' + std::string(40, '9') + ' ' +
                             std::string(40, '6') + ' ' + std::string(40, '3') + " }";
  std::string changed = text;
  changed.replace(changed.find(from), from.size(), thirds);
  const SolidFile file = read_nef3(changed, "a.nef3");
  ASSERT_GT(file.faces.points.size(), 1u);
  EXPECT_EQ(file.faces.points[1], csgcore::Vec3(1.0 / 3, 3, 2));
}

TEST(Nef3, ThatIsDamagedIsEmpty) {
  const std::string text = content_of("frame.nef3");
  EXPECT_EQ(read_nef3("garbage", "a.nef3").problem, "Failure trying to import 'a.nef3'");
  std::mt19937 random(26);
  for (int i = 0; i < 1000; ++i) {
    std::string damaged = text;
    const size_t place = random() % text.size();
    if (i % 2 == 0) {
      damaged.resize(place);
    } else {
      damaged[place] = "0123456789-{},| \nx"[random() % 18];
    }
    const SolidFile file = read_nef3(damaged, "a.nef3");  // no crash, whatever it is
    const bool is_cut_off = i % 2 == 0 && place + 1 < text.find("/*");
    EXPECT_TRUE(!is_cut_off || !file.problem.empty()) << place;
  }
}

TEST(Stl, IsTextByItsFirstWordAndBinaryByItsLength) {
  const std::string binary = content_of("step.stl");
  EXPECT_EQ(read_stl(binary + "x", "a").faces.face_count(), 0u);
  EXPECT_EQ(read_stl(" " + content_of("step_text.stl"), "a").faces.face_count(), 0u);
  std::string more = binary;
  more[80] = static_cast<char>(more[80] + 1);
  EXPECT_EQ(read_stl(more, "a").faces.face_count(), 0u);
}

/// OpenSCAD reads nothing of them, and says nothing.
TEST(Stl, SaysWhyItHasNoFacets) {
  const auto problem = [](const std::string& bytes) { return read_stl(bytes, "a").problem; };
  const std::string binary = content_of("step.stl"), text = content_of("step_text.stl");
  EXPECT_EQ(problem(""), "'a' is empty");
  EXPECT_EQ(problem("solid x\nendsolid x\n"), "'a' has no facets");
  EXPECT_EQ(problem(std::string(84, '\0')), "'a' has no facets");
  EXPECT_EQ(problem("\xEF\xBB\xBF" + text), "'a' begins with a byte order mark: nothing is read");
  EXPECT_EQ(problem("\n " + text), "'a' begins with blanks before \"solid\": nothing is read");
  EXPECT_EQ(problem(binary.substr(0, 300)),
            "'a' is cut off, or miscounted: it counts 20 facets, and has 4: nothing is read");
  EXPECT_EQ(problem("solid" + binary.substr(5, 300)),
            "'a' is cut off, or miscounted: it counts 20 facets, and has 4: nothing is read");
  EXPECT_EQ(problem(binary + "abcd"),
            "'a' is miscounted: it counts 20 facets, and has 4 bytes behind them: nothing is read");
  EXPECT_EQ(problem(std::string(50, '\0')), "'a' is cut off: nothing is read");
  // What stands before the end is drawn.
  const SolidFile cut = read_stl(text.substr(0, text.rfind("endloop")), "a");
  EXPECT_EQ(cut.problem, "'a' is cut off: no endfacet ends the last facet");
  EXPECT_EQ(cut.faces.face_count(), 20u);
}

/// What OpenSCAD takes for no number, each reader has in words of its own.
TEST(MeshFiles, HaveNoNumberBeyondTheLargestDouble) {
  const auto put = [](const std::string& name, const std::string& from, const std::string& to) {
    std::string bytes = content_of(name);
    const size_t place = bytes.find(from);
    EXPECT_NE(place, std::string::npos) << name;
    return bytes.replace(place, from.size(), to);
  };
  for (const std::string number : {"1e400", "-2e309", "1e999999999999999999999"}) {
    const std::string off = put("step.off", "OFF", "OFF 1 0 0\n0 0 " + number + "\nOFF");
    EXPECT_THAT(read_off(off, "a").problem, "The file 'a' is not in OFF") << number;
    EXPECT_NE(read_stl("solid\nouter loop\nvertex 0 0 " + number + "\n", "a").problem, "");
    EXPECT_NE(read_amf("<amf><object><mesh><vertices><vertex><coordinates><x>" + number +
                           "</x></coordinates></vertex></vertices></mesh></object></amf>",
                       "a")
                  .problem,
              "");
    const HeightMap map = read_height_map("1 2\n3 " + number + "\n5 6\n", "a", false);
    EXPECT_NE(map.problem, "");
    EXPECT_EQ(map.heights, (std::vector<double>{1, 2, 3, 0}));
  }
  EXPECT_EQ(read_height_map("1e-400 2\n", "a", false).problem, "");
}

/// OpenSCAD 2021.01 says the same of these files.
TEST(Stl, TextIsReadByItsLines) {
  const auto text_of = [](const std::string& lines) { return "solid x\nouter loop\n" + lines; };
  const auto faces_of = [&](const std::string& lines) {
    return read_stl(text_of(lines), "f").faces.face_count();
  };
  EXPECT_EQ(faces_of("vertex 0 0 0\n\tvertex\t1 +1 1e0 # more\r\nxvertex 0 1 -.5\n"), 1u);
  // Without a third number, or a third line, a facet is lost.
  EXPECT_EQ(faces_of("vertex 0 0 0\nvertex 1 1\nvertex 0 1 0\nouter loop\nvertex 1 1 1"), 0u);
  EXPECT_EQ(read_stl(text_of("vertex 1 1\nendfacet\n"), "f").problem, "'f' has no facets");
  EXPECT_EQ(faces_of("VERTEX 0 0 0\nvertex 1 1 2\nvertexes 0 1 0\nvertex 1 1 1"), 0u);
  EXPECT_EQ(read_stl(text_of("vertex 0 0 0\n vertex 1 0 z9\n"), "f").problem,
            "STL line 4, can't parse vertex line 'vertex 1 0 z9' importing file 'f'");
  const std::string whole = "vertex 0 0 0\nvertex 1 1 2\nvertex 0 1 0\n";
  const SolidFile extra = read_stl(text_of(whole + "outer loop\n" + whole + "vertex 5 5 5\n"), "f");
  EXPECT_EQ(extra.problem, "STL line 10, extra vertex line 'vertex 5 5 5' importing file 'f'");
  EXPECT_EQ(extra.faces.face_count(), 0u);
}

/// OpenSCAD 2021.01 takes such files, and leaves out such ones.
TEST(Amf, IsAllOrNothing) {
  const std::string whole = content_of("step.amf");
  const auto faces_with = [&](const std::string& old, const std::string& text) {
    std::string changed = whole;
    changed.replace(whole.find(old), old.size(), text);
    return read_amf(changed, "f").faces.face_count();
  };
  EXPECT_EQ(faces_with("<x>4</x>", "<x></x>"), 20u);
  EXPECT_EQ(faces_with("<x>4</x>", "<x>a</x>"), 0u);
  EXPECT_EQ(faces_with("<x>4</x>", "<x> 4</x>"), 0u);
  EXPECT_EQ(faces_with("<v1>6</v1>", "<v1>x</v1>"), 0u);
  EXPECT_EQ(faces_with("<v1>6</v1>", "<v1>12</v1>"), 19u);
  EXPECT_EQ(faces_with("</volume>", "</volum>"), 0u);
  EXPECT_EQ(faces_with("</amf>", ""), 0u);
}

TEST(Off, HasNoFacesWithoutTheirPoints) {
  const std::string points = "OFF 3 1 0\n0 0 0\n1 0 0\n0 1 0\n";
  EXPECT_EQ(read_off(points + "3 0 1 2\n", "f").faces.face_count(), 1u);
  for (const char* face : {"3 0 1 3\n", "3 0 1 -1\n", "4000000000 0 1 2\n", "3 0 1\n", ""}) {
    EXPECT_EQ(read_off(points + face, "f").faces.face_count(), 0u) << face;
  }
  EXPECT_EQ(read_off("OFF 4000000000 4000000000 0\n0 0 0\n", "f").faces.face_count(), 0u);
}

/// OpenSCAD 2021.01 writes these triangles to an STL.
TEST(FaceSets, AreCutAsTheyAreSeenFromOutside) {
  const auto has_diagonal = [](const std::vector<csgcore::Vec3>& points, uint32_t a, uint32_t b) {
    FaceSet faces{points, {0, 1, 2, 3}, {4}};
    size_t found = 0;
    for (const csgcore::TriangleMesh::Triangle& triangle : triangles_of(faces)) {
      found += std::ranges::count(triangle, a) + std::ranges::count(triangle, b) == 2 ? 1 : 0;
    }
    return found == 2;
  };
  EXPECT_TRUE(has_diagonal({{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}}, 1, 3)) << "upwards";
  EXPECT_TRUE(has_diagonal({{0, 4, 0}, {4, 4, 0}, {4, 0, 0}, {0, 0, 0}}, 1, 3)) << "downwards";
  EXPECT_TRUE(has_diagonal({{0, 0, 0}, {0, 4, 0}, {0, 4, 4}, {0, 0, 4}}, 1, 3)) << "along x";
  EXPECT_TRUE(has_diagonal({{0, 0, 0}, {0, 0, 4}, {4, 0, 4}, {4, 0, 0}}, 1, 3)) << "along y";
  EXPECT_TRUE(has_diagonal({{0, 0, 0}, {9, 1, 1}, {90, 2, 0}, {9, 1, -3}}, 1, 3)) << "aslant";
  // Its Newell sum is nearest to x, and the triangle of its furthest corners to z.
  EXPECT_TRUE(has_diagonal({{-3.48892, 5.42115, 6},
                            {-4.21311, 5.51058, 3},
                            {-1.87866, -4.21311, 3},
                            {1.05099, -3.48892, 6}},
                           0, 2))
      << "between axes";
  EXPECT_TRUE(has_diagonal({{0, 0, 0}, {4, 4, 0}, {4, 0, 0}, {0, 4, 0}}, 0, 2)) << "crossed";
}

TEST(FaceSets, LoseWhatIsNoFace) {
  const double inf = std::numeric_limits<double>::infinity();
  FaceSet faces;
  faces.points = {{0, 0, 0}, {1, 0, 0}, {-0.0, 0, 0}, {0, 1, 0}, {9, 9, 9}, {inf, 0, 0}};
  for (const std::vector<uint32_t>& face : {std::vector<uint32_t>{0, 1, 2, 3},
                                            {0, 1, 3, 2},
                                            {0, 2, 1},
                                            {0, 1, 5},
                                            {},
                                            {1, 1, 3, 0, 0}}) {
    faces.corners.insert(faces.corners.end(), face.begin(), face.end());
    faces.end_face();
  }
  EXPECT_EQ(tidy(faces), 1u);
  EXPECT_THAT(faces.points,
              ElementsAre(csgcore::Vec3(0.0), csgcore::Vec3(1, 0, 0), csgcore::Vec3(0, 1, 0)));
  EXPECT_THAT(faces.corners, ElementsAre(0, 1, 0, 2, 0, 1, 2, 1, 2, 0));
  EXPECT_THAT(faces.ends, ElementsAre(4, 7, 10));
}

TEST(HeightMaps, AreReadFromNumbers) {
  const HeightMap map = read_height_map(content_of("heights.dat"), "f", false);
  EXPECT_EQ(map.problem, "");
  EXPECT_EQ(map.columns, 3u);
  EXPECT_THAT(map.heights, ElementsAre(1, 2, 3, 4, 5, 0, 6, 7, 8));
  EXPECT_EQ(map.base, 0);
  EXPECT_EQ(read_height_map("-3 5\n", "f", true).base, -4);
  const HeightMap bad = read_height_map("1 2 3\n4 x 6\n7 8 9\n", "f", false);
  EXPECT_EQ(bad.problem,
            "Illegal value in 'f': bad lexical cast: source type value could not be interpreted as "
            "target");
  EXPECT_THAT(bad.heights, ElementsAre(1, 2, 3, 4, 0, 0));
}

/// As OpenSCAD 2021.01 makes them.
TEST(HeightMaps, EndWhereAWordIsNoNumber) {
  const HeightMap trailing = read_height_map("1 2\n3 4\nEND\n", "f", false);
  EXPECT_NE(trailing.problem, "");
  EXPECT_EQ(trailing.rows, 2u);
  EXPECT_EQ(trailing.base, 0);
  const HeightMap first = read_height_map("1 2\nx 3\n5 6\n", "f", false);
  EXPECT_EQ(first.rows, 1u);
  EXPECT_EQ(first.heights, (std::vector<double>{1, 2}));
  const HeightMap second = read_height_map("1 2\n3 4\n5 6 7 x\n8 9\n", "f", false);
  EXPECT_EQ(second.rows, 3u);
  EXPECT_EQ(second.heights, (std::vector<double>{1, 2, 0, 3, 4, 0, 5, 6, 7}));
  EXPECT_EQ(read_height_map("END\n", "f", false).rows, 0u);
}

/// The bytes of a zlib stream that unpacks to 258 zeros `count` times: matches of length 258.
std::string zeros(size_t count) {
  std::string result = "\x78\x9C";
  uint32_t bits = 0;
  int used = 0;
  const auto put = [&](uint32_t value, int size) {
    bits |= value << used;
    for (used += size; used >= 8; used -= 8, bits >>= 8) result += static_cast<char>(bits);
  };
  put(3, 3);     // one block, of fixed codes
  put(0x0C, 8);  // the literal 0: 00110000
  for (size_t i = 0; i < count; ++i) {
    put(0xA3, 8);  // length 258: 11000101
    put(0, 5);     // distance 1
  }
  put(0, 7);  // the end
  put(0, 8);
  return result;
}

std::string png_chunk(const std::string& type, const std::string& data) {
  const auto big_endian = [](uint32_t number) {
    std::string bytes;
    for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(number >> shift);
    return bytes;
  };
  uint32_t crc = ~0u;
  for (const char c : type + data) {
    crc ^= static_cast<unsigned char>(c);
    for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ (crc & 1 ? 0xEDB88320u : 0);
  }
  return big_endian(static_cast<uint32_t>(data.size())) + type + data + big_endian(~crc);
}

long peak_kb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss;
}

TEST(HeightMaps, UnpackNothingBesideThePicture) {
  const std::string plain = content_of("gray8.png");
  const size_t header = 8 + 12 + 13;
  const std::vector<double> heights = read_height_map(plain, "f", false).heights;
  const long before = peak_kb();
  constexpr size_t kMatches = 800'000;  // 200 MB
  const std::string packed = zeros(kMatches);
  for (const std::string& chunk : {png_chunk("iCCP", std::string("a\0\0", 3) + packed),
                                   png_chunk("zTXt", std::string("a\0\0", 3) + packed)}) {
    std::string bytes = plain;
    bytes.insert(header, chunk);
    const HeightMap map = read_height_map(bytes, "f", false);
    EXPECT_EQ(map.problem, "");
    EXPECT_EQ(map.heights, heights);
  }
  EXPECT_LT(peak_kb() - before, 50'000);
}

TEST(HeightMaps, ArePicturesOfAnyType) {
  for (const char* name : kPictures) {
    SCOPED_TRACE(name);
    const HeightMap map = read_height_map(content_of(name), "f", false);
    EXPECT_EQ(map.problem, "");
    EXPECT_EQ(map.columns, 3u);
    // The last row of the picture comes first.
    EXPECT_THAT(map.heights,
                Pointwise(DoubleNear(1e-12), {20., 80 / 3., 100 / 3., 0., 20 / 3., 40 / 3.}));
    EXPECT_EQ(map.base, -1);
    const HeightMap inverted = read_height_map(content_of(name), "f", true);
    EXPECT_NEAR(inverted.at(0, 1), 100.0 / 255, 1e-12);
    EXPECT_NEAR(inverted.at(2, 0), 100.0 / 255 * -84, 1e-12);
  }
}

TEST(HeightMaps, ArePicturesOfPaethsFilter) {
  const std::optional<GrayPicture> picture = read_gray_png(content_of("paeth.png"), kMostCells);
  ASSERT_TRUE(picture);
  for (int y = 0; y < 24; ++y) {
    for (int x = 0; x < 24; ++x) {
      EXPECT_DOUBLE_EQ(picture->values[static_cast<size_t>(24 * y + x)],
                       (37 * x * x + 91 * y * y + 13 * x * y) % 256);
    }
  }
}

TEST(HeightMaps, BoundASolid) {
  const HeightMap map = read_height_map(content_of("heights.dat"), "f", false);
  FaceSet faces = solid_below(map, true);
  tidy(faces);
  EXPECT_NEAR(enclosed_volume(faces),
              1.0 / 4 * ((1 + 2 + 4 + 5) + (2 + 3 + 5 + 0) + (4 + 5 + 6 + 7) + (5 + 0 + 7 + 8)),
              1e-12);
  const auto mesh = mesh_of(std::move(faces));
  EXPECT_TRUE(mesh->is_closed());
  csgcore::Box box;
  for (const csgcore::Vec3& vertex : mesh->vertices()) box.merge(vertex);
  EXPECT_EQ(box.min, csgcore::Vec3(-1, -1, 0));
  EXPECT_EQ(box.max, csgcore::Vec3(1, 1, 8));
  for (const char* few : {"", "1", "#", "1 2", "1\n2"}) {
    mesh_of(solid_below(read_height_map(few, "f", false), false));
  }
}

TEST(HeightMaps, AreOfBoundedSize) {
  std::string wide = "1";
  for (int i = 1; i < 2048; ++i) wide += " 1";
  std::string tall;
  for (int i = 0; i < 2048; ++i) tall += "1\n";
  EXPECT_EQ(read_height_map(wide + "\n" + tall, "f", false).problem,
            "The file 'f' has too many heights");
  EXPECT_FALSE(read_gray_png(content_of("gray8.png"), 5));
  EXPECT_TRUE(read_gray_png(content_of("gray8.png"), 6));
}

/// OpenSCAD writes ZIP64 headers, whatever the size, and the archive of any other program is read.
TEST(ZipArchives, AreThoseThatOpenScadWrites) {
  const TemporaryFolder folder;
  const std::string design = folder.write("a.scad", "difference() { cube(9); cube(4); }");
  for (const char* const suffix : {".3mf", ".amf"}) {
    const std::string file = folder / ("a" + std::string(suffix));
    const std::string command =
        "HOME=" + folder.path() + " openscad -o " + file + " " + design + " 2> /dev/null";
    ASSERT_EQ(std::system(command.c_str()), 0);
    const std::string bytes(read_file(file).view());
    SolidFile solid = (suffix == std::string(".3mf") ? read_3mf : read_amf)(bytes, "a");
    EXPECT_EQ(solid.problem, "") << suffix;
    tidy(solid.faces);
    EXPECT_NEAR(enclosed_volume(solid.faces), 9 * 9 * 9 - 4 * 4 * 4, 1e-9) << suffix;
  }
}

TEST(ZipArchives, MayBeCutOffAnywhere) {
  const std::string bytes = content_of("step.3mf");
  ASSERT_EQ(read_3mf(bytes, "a").problem, "");
  for (size_t size = 0; size < bytes.size(); ++size) {
    EXPECT_NE(read_3mf(bytes.substr(0, size), "a").problem, "");
  }
  EXPECT_EQ(read_3mf("something before it" + bytes, "a").problem, "");
}

TEST(ZipArchives, UnpackNoMoreThanTheySay) {
  const std::string bytes = content_of("step_zipped.amf");
  const std::string whole = content_of("step.amf");
  EXPECT_EQ(ZipArchive(bytes).unpack_first(), whole);
  EXPECT_FALSE(ZipArchive(bytes).unpack("another"));
  EXPECT_FALSE(ZipArchive("").unpack_first());
  // The archive's directory comes last, and holds the unpacked size at this place.
  const size_t size_at = bytes.rfind("PK\x01\x02") + 24;
  for (const uint64_t size : {whole.size() - 1, whole.size() + 1, size_t{0xFFFFFFF0}}) {
    std::string lying = bytes;
    for (size_t i = 0; i < 4; ++i) lying[size_at + i] = static_cast<char>(size >> (8 * i));
    EXPECT_FALSE(ZipArchive(lying).unpack_first()) << size;
  }
  // A wrong checksum, in the file's own header and in the directory.
  std::string other = bytes;
  for (const size_t at : {size_t{14}, size_at - 8}) other[at] = static_cast<char>(other[at] + 1);
  EXPECT_FALSE(ZipArchive(other).unpack_first());
}

/// No damage may crash a reader or keep it busy.
TEST(MeshFiles, MayBeDamaged) {
  std::mt19937 random(1);
  const auto damage = [&](const std::string& whole, const std::function<void(std::string)>& read) {
    for (int round = 0; round < 300; ++round) {
      std::string bytes = whole;
      if (round % 3 == 0) bytes.resize(random() % bytes.size());
      for (int flips = round % 4; flips > 0 && !bytes.empty(); --flips) {
        bytes[random() % bytes.size()] = static_cast<char>(random());
      }
      if (round % 5 == 0 && bytes.size() > 8) bytes.insert(random() % bytes.size(), bytes, 0, 8);
      read(std::move(bytes));
    }
  };
  for (const Case& format : kSteps) {
    damage(content_of(format.name), [&](const std::string& bytes) {
      mesh_of(format.read(bytes, "f").faces);
      if (format.read == read_off) mesh_of(read_stl("solid" + bytes, "f").faces);
    });
  }
  for (const char* name : kPictures) {
    damage(content_of(name), [](const std::string& bytes) {
      mesh_of(solid_below(read_height_map(bytes, "f", false), false));
    });
  }
  damage(content_of("heights.dat"), [](const std::string& bytes) {
    mesh_of(solid_below(read_height_map(bytes, "f", false), false));
  });
}

}  // namespace
}  // namespace frontend
