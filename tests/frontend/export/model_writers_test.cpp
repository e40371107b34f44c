// Tests the writers of exported files: their bytes, and what scadray's own readers make of them.
#include "export/model_writers.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "drawings/drawing.hpp"
#include "meshes/read_solid_file.hpp"
#include "meshes/zip_archive.hpp"
#include "plane/outlines.hpp"

namespace frontend {
namespace {

using csgcore::TriangleSet;
using csgcore::Vec3;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;
using testing::StartsWith;

/// The third of a unit has no end, in floats or doubles; a zero has its sign.
TriangleSet corner() {
  const auto third = static_cast<float>(1.0 / 3);
  return {{{-0.0, 0, 0}, {2, 0, 0}, {0, 1, 0}, {0, 0, third}},
          {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
}

/// A square with a square hole.
Polygons frame() {
  return {{{10, 0}, {10, 10.5}, {-0.0, 10.5}, {0, 0}}, {{1, 1}, {1, 2}, {7.0 / 3, 2}, {3, 1}}};
}

TEST(ModelWriters, AsciiStl) {
  EXPECT_THAT(ascii_stl_of(corner()), StartsWith("solid OpenSCAD_Model\n"
                                                 "  facet normal 0 0 -1\n"
                                                 "    outer loop\n"
                                                 "      vertex 0 0 0\n"
                                                 "      vertex 0 1 0\n"
                                                 "      vertex 2 0 0\n"
                                                 "    endloop\n"
                                                 "  endfacet\n"
                                                 "  facet normal 0 -1 0\n"
                                                 "    outer loop\n"
                                                 "      vertex 0 0 0\n"
                                                 "      vertex 2 0 0\n"
                                                 "      vertex 0 0 0.33333334\n"));
  EXPECT_TRUE(ascii_stl_of(corner()).ends_with("  endfacet\nendsolid OpenSCAD_Model\n"));
}

TEST(ModelWriters, BinaryStl) {
  const std::string bytes = stl_of(corner());
  EXPECT_THAT(bytes, SizeIs(80 + 4 + 4 * 50));
  EXPECT_EQ(bytes.substr(0, 85),
            "OpenSCAD Model\n" + std::string(65, '\0') + '\4' + std::string(3, '\0') + '\0');
  // The second facet: its normal, (0, 0, 0), (2, 0, 0), (0, 0, 1/3).
  const std::string zero(4, '\0'), minus_one("\x00\x00\x80\xbf", 4), two("\x00\x00\x00\x40", 4),
      third("\xab\xaa\xaa\x3e", 4);
  EXPECT_EQ(bytes.substr(84 + 50, 50), zero + minus_one + zero + zero + zero + zero + two + zero +
                                           zero + zero + zero + third + std::string(2, '\0'));
}

TEST(ModelWriters, TheNormalOfATriangleThatIsALineIsZero) {
  const TriangleSet line{{{0, 0, 0}, {1, 0, 0}, {3, 0, 0}}, {{0, 1, 2}}};
  EXPECT_THAT(ascii_stl_of(line), HasSubstr("facet normal 0 0 0\n"));
  // Products of so small or so large edges are no doubles.
  for (const double size : {1e-38, 1e38}) {
    const TriangleSet triangle{{{0, 0, 0}, {size, 0, 0}, {0, size, 0}}, {{0, 1, 2}}};
    EXPECT_THAT(ascii_stl_of(triangle), HasSubstr("facet normal 0 0 1\n"));
  }
}

TEST(ModelWriters, Off) {
  TriangleSet surface = corner();
  surface.vertices[3].z = 1.0 / 3;
  EXPECT_EQ(off_of(surface),
            "OFF 4 4 0\n"
            "0 0 0 \n"
            "2 0 0 \n"
            "0 1 0 \n"
            "0 0 0.3333333333333333 \n"
            "3 0 2 1\n"
            "3 0 1 3\n"
            "3 0 3 2\n"
            "3 1 2 3\n");
}

TEST(ModelWriters, Obj) {
  EXPECT_EQ(obj_of(corner()),
            "o OpenSCAD_Model\n"
            "v 0 0 0\n"
            "v 2 0 0\n"
            "v 0 1 0\n"
            "v 0 0 0.33333334\n"
            "f 1 3 2\n"
            "f 1 2 4\n"
            "f 1 4 3\n"
            "f 2 3 4\n");
}

TEST(ModelWriters, Amf) {
  const std::string text = amf_of(corner());
  EXPECT_THAT(text, StartsWith("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
                               "<amf unit=\"millimeter\">\n"
                               " <metadata type=\"producer\">scadray</metadata>\n"
                               " <object id=\"0\">\n"
                               "  <mesh>\n"
                               "   <vertices>\n"
                               "    <vertex><coordinates>\n"
                               "     <x>0</x>\n"
                               "     <y>0</y>\n"
                               "     <z>0</z>\n"
                               "    </coordinates></vertex>\n"));
  EXPECT_THAT(text, HasSubstr("     <z>0.33333334</z>\n"
                              "    </coordinates></vertex>\n"
                              "   </vertices>\n"
                              "   <volume>\n"
                              "    <triangle>\n"
                              "     <v1>0</v1>\n"
                              "     <v2>2</v2>\n"
                              "     <v3>1</v3>\n"
                              "    </triangle>\n"));
  EXPECT_TRUE(text.ends_with("    </triangle>\n   </volume>\n  </mesh>\n </object>\n</amf>\n"));
}

/// Returns the model of a 3MF file.
std::string model_in(const std::string& archive) {
  EXPECT_EQ(archive.substr(10, 4), std::string("\0\0\x21\0", 4)) << "the first day of 1980";
  const ZipArchive zip(archive);
  EXPECT_THAT(zip.unpack("[Content_Types].xml").value_or(""), HasSubstr("Extension=\"model\""));
  EXPECT_THAT(zip.unpack("_rels/.rels").value_or(""), HasSubstr("\"/3D/3dmodel.model\""));
  return zip.unpack("3D/3dmodel.model").value_or("");
}

constexpr const char* kModelStart =
    "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
    "<model xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\" "
    "unit=\"millimeter\" xml:lang=\"en-US\">\n"
    "\t<resources>\n";
constexpr const char* kMesh =
    "\t\t\t<mesh>\n"
    "\t\t\t\t<vertices>\n"
    "\t\t\t\t\t<vertex x=\"0\" y=\"0\" z=\"0\" />\n"
    "\t\t\t\t\t<vertex x=\"2\" y=\"0\" z=\"0\" />\n"
    "\t\t\t\t\t<vertex x=\"0\" y=\"1\" z=\"0\" />\n"
    "\t\t\t\t\t<vertex x=\"0\" y=\"0\" z=\"0.33333334\" />\n"
    "\t\t\t\t</vertices>\n"
    "\t\t\t\t<triangles>\n"
    "\t\t\t\t\t<triangle v1=\"0\" v2=\"2\" v3=\"1\" />\n"
    "\t\t\t\t\t<triangle v1=\"0\" v2=\"1\" v3=\"3\" />\n"
    "\t\t\t\t\t<triangle v1=\"0\" v2=\"3\" v3=\"2\" />\n"
    "\t\t\t\t\t<triangle v1=\"1\" v2=\"2\" v3=\"3\" />\n"
    "\t\t\t\t</triangles>\n"
    "\t\t\t</mesh>\n"
    "\t\t</object>\n";

TEST(ModelWriters, ThreeMfOfOnePart) {
  const std::vector<ExportedPart> parts = {{corner(), {}}};
  EXPECT_EQ(model_in(three_mf_of(parts)),
            std::string(kModelStart) +
                "\t\t<object id=\"1\" name=\"OpenSCAD Model\" type=\"model\">\n" + kMesh +
                "\t</resources>\n\t<build>\n\t\t<item objectid=\"1\" />\n\t</build>\n</model>\n");
}

TEST(ModelWriters, ThreeMfOfColours) {
  const std::vector<ExportedPart> parts = {{corner(), {}},
                                           {corner(), csgcore::Color{1, 0.5f, 0, 1}},
                                           {corner(), csgcore::Color{0, 0, 1, 0.25f}}};
  EXPECT_EQ(model_in(three_mf_of(parts)),
            std::string(kModelStart) +
                "\t\t<basematerials id=\"1\">\n"
                "\t\t\t<base name=\"#FF8000FF\" displaycolor=\"#FF8000FF\" />\n"
                "\t\t\t<base name=\"#0000FF40\" displaycolor=\"#0000FF40\" />\n"
                "\t\t</basematerials>\n"
                "\t\t<object id=\"2\" name=\"OpenSCAD Model, part 1\" type=\"model\">\n" +
                kMesh +
                "\t\t<object id=\"3\" name=\"OpenSCAD Model, part 2\" type=\"model\" pid=\"1\" "
                "pindex=\"0\">\n" +
                kMesh +
                "\t\t<object id=\"4\" name=\"OpenSCAD Model, part 3\" type=\"model\" pid=\"1\" "
                "pindex=\"1\">\n" +
                kMesh +
                "\t\t<object id=\"5\" name=\"OpenSCAD Model\" type=\"model\">\n"
                "\t\t\t<components>\n"
                "\t\t\t\t<component objectid=\"2\" />\n"
                "\t\t\t\t<component objectid=\"3\" />\n"
                "\t\t\t\t<component objectid=\"4\" />\n"
                "\t\t\t</components>\n"
                "\t\t</object>\n"
                "\t</resources>\n\t<build>\n\t\t<item objectid=\"5\" />\n\t</build>\n</model>\n");
}

/// All formats of solids, with their readers.
TEST(ModelWriters, OurReadersFindTheSameSurface) {
  TriangleSet surface = corner();
  surface.vertices[1] = {static_cast<float>(1e9 / 7), static_cast<float>(-1e-9 / 7), 16777216};
  const std::vector<ExportedPart> parts = {{surface, csgcore::Color{1, 0, 0, 1}}};
  const auto expect_same = [&](SolidFile file) {
    EXPECT_EQ(file.problem, "");
    tidy(file.faces);
    ASSERT_THAT(file.faces.points, SizeIs(4));
    // A text with a float's digits is another double, but the same float.
    std::vector<glm::vec3> points(file.faces.points.begin(), file.faces.points.end());
    for (const Vec3& vertex : surface.vertices) {
      EXPECT_THAT(points, testing::Contains(glm::vec3(vertex)));
    }
    EXPECT_EQ(file.faces.face_count(), 4u);
  };
  expect_same(read_stl(stl_of(surface), "a.stl"));
  expect_same(read_stl(ascii_stl_of(surface), "a.stl"));
  expect_same(read_off(off_of(surface), "a.off"));
  expect_same(read_amf(amf_of(surface), "a.amf"));
  expect_same(read_3mf(three_mf_of(parts), "a.3mf"));
}

TEST(ModelWriters, AnArchiveOfMuchTextIsReadBack) {
  TriangleSet surface;
  for (uint32_t i = 0; i < 30000; ++i) surface.vertices.emplace_back(i, i * i % 7919, 1);
  surface.triangles = {{0, 1, 29999}};
  const std::vector<ExportedPart> parts = {{surface, {}}};
  EXPECT_THAT(read_3mf(three_mf_of(parts), "a.3mf").faces.points, SizeIs(30000));
}

TEST(ModelWriters, Svg) {
  EXPECT_EQ(svg_of(frame()),
            "<?xml version=\"1.0\" standalone=\"no\"?>\n"
            "<!DOCTYPE svg PUBLIC \"-//W3C//DTD SVG 1.1//EN\" "
            "\"http://www.w3.org/Graphics/SVG/1.1/DTD/svg11.dtd\">\n"
            "<svg width=\"10mm\" height=\"11mm\" viewBox=\"0 -11 10 11\" "
            "xmlns=\"http://www.w3.org/2000/svg\" version=\"1.1\">\n"
            "<title>OpenSCAD Model</title>\n"
            "<path d=\"\n"
            "M 10,0 L 10,-10.5 L 0,-10.5 L 0,0 z\n"
            "M 1,-1 L 1,-2 L 2.3333333333333335,-2 L 3,-1 z\n"
            "\" stroke=\"black\" fill=\"lightgray\" stroke-width=\"0.5\"/>\n"
            "</svg>\n");
}

TEST(ModelWriters, SvgBreaksItsLinesAsOpenScadDoes) {
  Polygon polygon;
  for (int i = 0; i < 8; ++i) polygon.emplace_back(i, i * i);
  EXPECT_THAT(svg_of({polygon}), HasSubstr("M 0,0 L 1,-1 L 2,-4 L 3,-9 L 4,-16 L 5,-25\n"
                                           " L 6,-36 L 7,-49 z\n"));
}

TEST(ModelWriters, Dxf) {
  EXPECT_EQ(dxf_of({{{0, 0}, {1, 0}, {0, 1.0 / 3}}}),
            "  0\nSECTION\n  2\nBLOCKS\n  0\nENDSEC\n  0\nSECTION\n  2\nENTITIES\n"
            "  0\nLINE\n  8\n0\n 10\n0\n 20\n0\n 11\n1\n 21\n0\n"
            "  0\nLINE\n  8\n0\n 10\n1\n 20\n0\n 11\n0\n 21\n0.3333333333333333\n"
            "  0\nLINE\n  8\n0\n 10\n0\n 20\n0.3333333333333333\n 11\n0\n 21\n0\n"
            "  0\nENDSEC\n  0\nSECTION\n  2\nOBJECTS\n  0\nDICTIONARY\n  0\nENDSEC\n  0\nEOF\n");
}

TEST(ModelWriters, OurReadersFindTheSameOutlines) {
  const auto expect_same = [](const Drawing& drawing, double tolerance) {
    EXPECT_THAT(drawing.problems, IsEmpty());
    double area = 0;
    Rectangle box;
    for (const Figure& figure : drawing.figures) {
      const std::optional<SimplePolygons> polygons = united({&figure, 1});
      for (const Polygon& polygon : *polygons) area += signed_area(polygon);
      box.merge(bounds_of(figure));
    }
    EXPECT_NEAR(area, 105 - 5.0 / 3, tolerance);
    EXPECT_NEAR(box.max.x - box.min.x, 10, tolerance);
    EXPECT_NEAR(box.max.y - box.min.y, 10.5, tolerance);
  };
  constexpr double kGridOfDxf = 1.0 / 1024;
  expect_same(read_dxf(dxf_of(frame()), "a.dxf", {}), 100 * kGridOfDxf);
  expect_same(read_svg(svg_of(frame()), "a.svg", {}), 1e-6);
}

TEST(ModelWriters, Pdf) {
  const std::string text = pdf_of(frame());
  EXPECT_THAT(text, StartsWith("%PDF-1.4\n1 0 obj\n<< /Type /Catalog /Pages 2 0 R >>\nendobj\n"));
  EXPECT_THAT(text, HasSubstr("/MediaBox [0 0 595 842]"));
  // 10 mm from the page's middle are 28.346 points.
  EXPECT_THAT(text, HasSubstr("stream\n0 0 0 RG 1 w 0 J 0 j\n325.846 421 m\n325.846 450.764 l\n"
                              "297.5 450.764 l\n297.5 421 l\nh\n"));
  // Every object stands where the table says.
  const size_t table = text.find("xref\n0 6\n");
  EXPECT_THAT(text, HasSubstr("startxref\n" + std::to_string(table) + "\n"));
  for (size_t i = 1; i < 6; ++i) {
    const size_t row = table + 9 + 20 * i;
    EXPECT_THAT(text.substr(std::stoul(text.substr(row, 10))),
                StartsWith(std::to_string(i) + " 0 obj\n"));
  }
  const size_t begin = text.find("stream\n") + 7, end = text.find("\nendstream");
  EXPECT_THAT(text, HasSubstr("/Length " + std::to_string(end - begin) + " "));
}

TEST(ModelWriters, SettingsOfThreeMf) {
  const std::vector<ExportedPart> parts = {{corner(), csgcore::Color{1, 0.5f, 0, 1}}};
  ExportSettings settings;
  settings.three_mf_unit = "inch";
  settings.three_mf_material = "color";
  settings.three_mf_title = "a & \"b\" <c";
  settings.three_mf_rating = "5";
  const std::string model = model_in(three_mf_of(parts, settings));
  EXPECT_THAT(model, HasSubstr("\" xmlns:m=\"http://schemas.microsoft.com/3dmanufacturing/material/"
                               "2015/02\" unit=\"inch\""));
  EXPECT_THAT(model, HasSubstr("<metadata name=\"Title\">a &amp; &quot;b&quot; &lt;c</metadata>\n"
                               "\t<metadata name=\"Rating\">5</metadata>\n"));
  EXPECT_THAT(model, HasSubstr("<m:colorgroup id=\"1\">\n\t\t\t<m:color color=\"#FF8000FF\" />\n"
                               "\t\t</m:colorgroup>\n"));
  settings.three_mf_meta_data = false;
  EXPECT_THAT(model_in(three_mf_of(parts, settings)), Not(HasSubstr("metadata")));
}

TEST(ModelWriters, SettingsOfDrawings) {
  ExportSettings settings;
  settings.svg = {.fill = false, .stroke_color = "\"red\"", .stroke_width = 0.25};
  EXPECT_THAT(svg_of(frame(), settings),
              HasSubstr("\" stroke=\"&quot;red&quot;\" fill=\"none\" stroke-width=\"0.25\"/>"));
  settings.pdf_paper = "a6";
  settings.pdf_orientation = "landscape";
  settings.pdf = {.fill = true, .fill_color = "#ff0000", .stroke = false, .stroke_width = 25.4};
  settings.pdf_author = "Zo\xC3\xAB (x)";
  settings.pdf_subject = "a\\b";
  const std::string pdf = pdf_of(frame(), settings);
  EXPECT_THAT(pdf, HasSubstr("/MediaBox [0 0 420 298]"));
  EXPECT_THAT(pdf, HasSubstr("stream\n0 0 0 RG 1 0 0 rg 72 w 0 J 0 j\n"));
  EXPECT_THAT(pdf, HasSubstr("h\nf*\nendstream"));
  EXPECT_THAT(pdf, HasSubstr("<< /Title (OpenSCAD Model) /Author (\xEF\xBB\xBFZo\xC3\xAB \\(x\\)) "
                             "/Subject (a\\\\b) /Producer (scadray) >>"));
  settings.pdf_orientation = "auto";
  settings.pdf_meta_data = false;
  EXPECT_THAT(pdf_of(frame(), settings), HasSubstr("/MediaBox [0 0 298 420]"));
  EXPECT_THAT(pdf_of(frame(), settings), HasSubstr("<< /Producer (scadray) >>"));
  EXPECT_THAT(pdf_of({{{0, 0}, {50, 0}, {0, 10}}}, settings), HasSubstr("/MediaBox [0 0 420 298]"));
}

TEST(ModelWriters, PdfOfALargeFigureHasALargePage) {
  EXPECT_THAT(pdf_of({{{0, 0}, {1000, 0}, {0, 10}}}), HasSubstr("/MediaBox [0 0 5726 842]"));
  EXPECT_THAT(pdf_of({{{0, 0}, {1e9, 0}, {0, 10}}}), Not(HasSubstr("e+")));
}

}  // namespace
}  // namespace frontend
