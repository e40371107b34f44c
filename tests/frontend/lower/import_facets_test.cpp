// Tests OpenSCAD's facets of round primitives.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "csgcore/canonical_primitive.hpp"
#include "csgcore/facets.hpp"
#include "csgcore/polyhedron.hpp"
#include "csgcore/triangle_mesh.hpp"
#include "lower/imported_text.hpp"

namespace frontend {
namespace {

using csgcore::Primitive;
using csgcore::Shape;
using csgcore::Vec3;
using ::testing::ElementsAre;
using ::testing::SizeIs;

/// Returns the number of faces of the only primitive; 0 if it is smooth.
size_t faces_of(const std::string& text, ImportOptions options = {}) {
  const ImportedDesign design = import_text(text, options);
  EXPECT_THAT(design.scene.primitives, SizeIs(1)) << text;
  const Primitive& primitive = design.scene.primitives.at(0);
  return primitive.polyhedron() ? primitive.polyhedron()->half_spaces().size() : 0;
}

TEST(ImporterFacets, OfFewFragmentsAreKept) {
  EXPECT_EQ(faces_of("cylinder($fn = 6);"), 8u);
  EXPECT_EQ(faces_of("cylinder($fn = 8, r1 = 0);"), 9u);
  EXPECT_EQ(faces_of("cylinder($fn = 9);"), 0u);
  EXPECT_EQ(faces_of("cylinder($fn = 8.5);"), 0u);  // $fn counts as written, not truncated
  EXPECT_EQ(faces_of("cylinder($fn = 1);"), 5u);
  EXPECT_EQ(faces_of("sphere($fn = 6);"), 14u);
  for (const char* fn : {"0", "-3", "inf", "nan", "100"}) {
    EXPECT_EQ(faces_of("sphere($fn = " + std::string(fn) + ");"), 0u) << fn;
  }
  EXPECT_EQ(faces_of("cylinder();"), 0u);
}

TEST(ImporterFacets, AsTheOptionsSay) {
  const ImportOptions none{.facets = Facets::kNone};
  const ImportOptions all{.facets = Facets::kAll};
  const ImportOptions few{.few_fragments = 12};
  EXPECT_EQ(faces_of("cylinder($fn = 6);", none), 0u);
  EXPECT_EQ(faces_of("cylinder($fn = 12);", few), 14u);
  EXPECT_EQ(faces_of("cylinder($fn = 13);", few), 0u);
  EXPECT_EQ(faces_of("cylinder($fn = 3);", {.few_fragments = 0}), 0u);
  EXPECT_EQ(faces_of("cylinder($fn = 100);", all), 102u);
  EXPECT_EQ(faces_of("cylinder($fn = 0, $fa = 12, $fs = 2, r = 9);", all), 31u);
  EXPECT_EQ(faces_of("cylinder($fn = inf);", all), 5u);
  // Every primitive is treated as if it had that $fn; cubes have their own faces.
  const ImportOptions forced{.facets = Facets::kAll, .fn = 5};
  EXPECT_EQ(faces_of("cylinder($fn = 100);", forced), 7u);
  EXPECT_EQ(faces_of("cylinder();", forced), 7u);
  EXPECT_EQ(faces_of("cylinder();", {.fn = 5}), 7u);
  EXPECT_EQ(faces_of("cylinder($fn = 5);", {.fn = 50}), 0u);
  EXPECT_EQ(faces_of("cube();", none), 6u);
}

TEST(ImporterFacets, HaveOpenScadsVertices) {
  const auto expect_vertices = [](const std::string& text, const csgcore::Mesh& mesh) {
    const Primitive primitive = only_primitive(text);
    ASSERT_TRUE(primitive.polyhedron()) << text;
    const std::vector<Vec3>& vertices = primitive.polyhedron()->vertices();
    ASSERT_EQ(vertices.size(), mesh.vertices.size()) << text;
    for (size_t i = 0; i < vertices.size(); ++i) {
      const Vec3 vertex = primitive.local_to_world.point(vertices[i]);
      for (int k = 0; k < 3; ++k) EXPECT_NEAR(vertex[k], mesh.vertices[i][k], 1e-14) << text;
    }
  };
  expect_vertices("sphere($fn = 7, r = 3);", csgcore::sphere_mesh(3, 7));
  expect_vertices("cylinder($fn = 6, h = 4, r1 = 3, r2 = 1);",
                  csgcore::frustum_mesh(0, 4, 3, 1, 6));
  expect_vertices("cylinder($fn = 5, h = 4, r1 = 0, r2 = 3, center = true);",
                  csgcore::frustum_mesh(-2, 2, 0, 3, 5));
}

/// An edge lies between two faces, a diagonal within one.
bool is_diagonal(const FacetMesh::Edge& edge, const FacetMesh& mesh) {
  const auto has_both_ends = [&](const std::vector<uint32_t>& face) {
    return std::ranges::count(face, edge.from) + std::ranges::count(face, edge.to) == 2;
  };
  return std::ranges::count_if(mesh.mesh.faces, has_both_ends) == 1;
}

/// The numbers of the edges between faces and of the diagonals.
TEST(ImporterFacets, HaveTheEdgesThatOpenScadDraws) {
  const ImportOptions options{.keeps_meshes = true};
  const auto edges_of = [&](const std::string& text) {
    const ImportedDesign design = import_text(text, options);
    const FacetMesh& mesh = design.meshes.at(design.scene.primitives.at(0).polyhedron());
    size_t diagonals = 0;
    for (const FacetMesh::Edge& edge : mesh.edges) diagonals += is_diagonal(edge, mesh);
    return std::to_string(mesh.edges.size() - diagonals) + " + " + std::to_string(diagonals);
  };
  EXPECT_EQ(edges_of("cube();"), "12 + 0");
  EXPECT_EQ(edges_of("polyhedron(" + kCorner + kFaces + ");"), "6 + 0");
  EXPECT_EQ(edges_of("cylinder($fn = 6);"), "18 + 0");
  EXPECT_EQ(edges_of("cylinder($fn = 4, r1 = 2, r2 = 1);"), "12 + 4");
  EXPECT_EQ(edges_of("cylinder($fn = 4, r2 = 0);"), "8 + 0");
  EXPECT_EQ(edges_of("sphere($fn = 6);"), "30 + 12");
  EXPECT_THAT(import_text("sphere($fn = 9); cube();", options).meshes, SizeIs(1));
  EXPECT_THAT(import_text("sphere($fn = 6); cube();").meshes, SizeIs(0));
}

TEST(ImporterFacets, DiagonalsRunFromAnUpperCornerToTheNextLowerOne) {
  const ImportedDesign design =
      import_text("cylinder($fn = 4, r1 = 2, r2 = 1);", {.keeps_meshes = true});
  const FacetMesh& mesh = design.meshes.begin()->second;
  size_t found = 0;
  for (const FacetMesh::Edge& edge : mesh.edges) {
    if (!is_diagonal(edge, mesh)) continue;
    const Vec3& from = mesh.mesh.vertices[edge.from];
    const Vec3& to = mesh.mesh.vertices[edge.to];
    EXPECT_GT(from.z, to.z);
    EXPECT_GT(from.x * to.y - from.y * to.x, 0);
    ++found;
  }
  EXPECT_EQ(found, 4u);
}

TEST(ImporterFacets, AreSharedWhereOnlyTheSizeDiffers) {
  const auto polyhedra = [](const std::string& text) {
    std::vector<const csgcore::Polyhedron*> result;
    for (const Primitive& primitive : import_text(text).scene.primitives) {
      result.push_back(primitive.polyhedron());
    }
    return result;
  };
  const auto prisms =
      polyhedra("cylinder($fn = 6); cylinder($fn = 6, h = 9, r = 7, center = true);");
  EXPECT_EQ(prisms[0], prisms[1]);
  const auto cones =
      polyhedra("cylinder($fn = 6, r1 = 2, r2 = 1); cylinder($fn = 6, d1 = 8, d2 = 4);");
  EXPECT_EQ(cones[0], cones[1]);
  const auto balls = polyhedra("sphere($fn = 6); sphere($fn = 6, r = 5); sphere($fn = 7);");
  EXPECT_EQ(balls[0], balls[1]);
  EXPECT_NE(balls[0], balls[2]);
  const auto others = polyhedra(
      "cylinder($fn = 6); cylinder($fn = 6, r2 = 0); cylinder($fn = 6, r1 = 0); cylinder($fn = 5);"
      "sphere($fn = 6);");
  for (size_t i = 0; i < others.size(); ++i) {
    for (size_t k = 0; k < i; ++k) EXPECT_NE(others[i], others[k]) << i << ' ' << k;
  }
}

TEST(ImporterFacets, KeepPlaceColourAndId) {
  const std::vector<Primitive> primitives =
      import_text(
          "cube(); color([0, 1, 0]) { multmatrix([[-1,0,0,7],[0,1,0,0],[0,0,1,0]]) "
          "{ cylinder($fn = 4, h = 3, r = 2, center = true); } }")
          .scene.primitives;
  expect_box(box_of(primitives.at(1)), Vec3(5, -2, -1.5), Vec3(9, 2, 1.5), 1e-15);
  EXPECT_EQ(primitives[1].id, 1u);
  EXPECT_EQ(primitives[1].color->g, 1);
  EXPECT_LT(primitives[1].local_to_world.determinant(), 0);
}

TEST(ImporterFacets, TakeNoMemoryOutOfProportion) {
  const ImportedDesign design = import_text(
      "cylinder($fn = 50);\n sphere($fn = 1e6); cylinder($fn = 1e300);\n"
      "sphere($fn = 60); cylinder($fn = 6);",
      {.facets = Facets::kAll});
  ASSERT_THAT(design.warnings, SizeIs(1));
  EXPECT_EQ(design.warnings[0].text,
            "a.csg:2:2: warning: 2 round primitives are smooth; this is the first: more than "
            "1048576 facets would be needed (give a smaller $fn)");
  std::vector<Shape> shapes;
  for (const Primitive& primitive : design.scene.primitives) shapes.push_back(primitive.shape());
  EXPECT_THAT(shapes, ElementsAre(Shape::kPolyhedron, Shape::kSphere, Shape::kFrustum,
                                  Shape::kPolyhedron, Shape::kPolyhedron));
  // Many small primitives are too much as well, beyond those that the length of the text allows.
  std::string text;
  for (int i = 0; i < 3; ++i) text += "sphere($fn = " + std::to_string(1000 + i) + ");";
  text += "cylinder($fn = 6);";
  const ImportedDesign many = import_text(text, {.facets = Facets::kAll});
  uint64_t faces = 0;
  for (const Primitive& primitive : many.scene.primitives) {
    if (primitive.mesh()) faces += primitive.mesh()->triangles().size() / 2;
  }
  EXPECT_GT(faces, 900000u);
  EXPECT_LT(faces, 1048576u);
  EXPECT_EQ(many.scene.primitives.back().shape(), Shape::kPolyhedron);
  EXPECT_THAT(many.warnings, SizeIs(1));
}

/// The number of triangles, and the box.
TEST(ImporterFacets, AreMeshesWhereTheyAreMany) {
  const Primitive sphere =
      import_text("sphere(r = 3, $fn = 200);", {.facets = Facets::kAll}).scene.primitives.at(0);
  ASSERT_EQ(sphere.shape(), Shape::kMesh);
  EXPECT_TRUE(sphere.mesh()->is_closed());
  EXPECT_EQ(sphere.mesh()->triangles().size(), 2u * 99 * 200 + 2 * 198);
  const csgcore::Box box = csgcore::canonicalize(sphere).bounds;
  const double top = 3 * std::cos(M_PI / 200), side = 3 * std::cos(M_PI / 200);
  expect_box(box, Vec3(-side, -side, -top), Vec3(side, side, top), 1e-12);
  // A quadrilateral of a cone is cut from the upper corner i to the lower corner i + 1.
  const Primitive cone =
      import_text("cylinder(h = 2, r1 = 3, r2 = 1, $fn = 20000);", {.facets = Facets::kAll})
          .scene.primitives.at(0);
  ASSERT_EQ(cone.shape(), Shape::kMesh);
  EXPECT_EQ(cone.mesh()->triangles().size(), 2u * 20000 + 2 * 19998);
  size_t diagonals = 0;
  for (const csgcore::TriangleMesh::Triangle& triangle : cone.mesh()->triangles()) {
    for (size_t i = 0; i < 3; ++i) {
      const Vec3& from = cone.mesh()->vertices()[triangle[i]];
      const Vec3& to = cone.mesh()->vertices()[triangle[(i + 1) % 3]];
      if (from.z <= to.z) continue;
      const double turn = from.x * to.y - from.y * to.x;
      diagonals += turn > 1e-9;
      EXPECT_GT(turn, -1e-9);
    }
  }
  EXPECT_EQ(diagonals, 20000u);
}

TEST(ImportFacets, ARevolutionWithAStartHasItsSectionsRoundedUp) {
  ImportOptions options;
  options.facets = Facets::kAll;
  const auto corners = [&](const std::string& arguments) {
    const ImportedDesign design =
        import_text("rotate_extrude(" + arguments +
                        ", $fn = 10) { polygon([[5, 0], [6, 0], [6, 1], [5, 1]]); }",
                    options);
    return design.scene.primitives.at(0).mesh()->vertices().size();
  };
  EXPECT_EQ(corners("angle = 100"), 3u * 4);
  EXPECT_EQ(corners("angle = 100, start = 0"), 4u * 4);
  EXPECT_EQ(corners("angle = 108, start = 30"), 4u * 4);
}

TEST(ImportFacets, ARevolutionHasTheSectionsOfWhatItsOperationsLeave) {
  ImportOptions options;
  options.facets = Facets::kAll;
  const ImportedDesign design = import_text(
      "rotate_extrude($fa = 12, $fs = 2) { difference() { polygon([[6, 0], [8, 0], [8, 2], [6, "
      "2]]);"
      "polygon([[7, -1], [9, -1], [9, 3], [7, 3]]); } }",
      options);
  // ⌈2π·7/2⌉ = 22 sections, and not ⌈2π·8/2⌉ = 26.
  EXPECT_EQ(design.scene.primitives.at(0).mesh()->vertices().size(), 22u * 4);
}

}  // namespace
}  // namespace frontend
