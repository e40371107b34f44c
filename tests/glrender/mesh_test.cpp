// Tests triangle meshes by OpenGL against the CPU tracer's picture.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <memory>
#include <optional>
#include <utility>

#include "agreement.hpp"
#include "csgcore/polyhedron.hpp"
#include "support/models.hpp"
#include "support/test_meshes.hpp"

namespace {

using csgcore::Affine;
using csgcore::Image;
using csgcore::make_frustum;
using csgcore::make_mesh;
using csgcore::make_polyhedron;
using csgcore::make_sphere;
using csgcore::Mat3;
using csgcore::Op;
using csgcore::Polyhedron;
using csgcore::Primitive;
using csgcore::Projection;
using csgcore::Scene;
using csgcore::Vec3;
using csgcore::View;
using gl_test::at;
using gl_test::cube;
using gl_test::leaves_of;
using gl_test::LoadedScene;
using gl_test::skewed;
using gl_test::Way;
using test_support::joined;
using test_support::MeshParts;

/// Normals of one triangle are equal up to rounding; those of neighbours are further apart, even in
/// the finest mesh.
constexpr double kOtherFace = 1e-4;
constexpr gl_test::EdgeLimits kEdges{.face_distance = kOtherFace};
/// For views along an axis, where rays lie in edges.
constexpr gl_test::EdgeLimits kAlongAnAxis{.face_distance = kOtherFace, .hits_per_edge_pixel = 500};

Primitive mesh(const MeshParts& parts, const Affine& place = {}) {
  return make_mesh(parts.mesh(), place);
}

/// A mesh whose triangles are red, blue, and of no colour by turns.
Primitive colored_mesh(const MeshParts& parts, const Affine& place = {}) {
  const std::optional<csgcore::Color> kColors[] = {csgcore::Color{1, 0, 0, 1},
                                                   csgcore::Color{0, 0.5f, 2, 1}, std::nullopt};
  std::vector<std::optional<csgcore::Color>> colors;
  for (size_t i = 0; i < parts.triangles.size(); ++i) colors.push_back(kColors[i % 3]);
  return make_mesh(std::make_shared<const csgcore::TriangleMesh>(parts.vertices, parts.triangles,
                                                                 std::move(colors)),
                   place);
}

struct NamedScene {
  std::string name;
  Scene scene;
};

/// Prints the scene for the test's name, which must not contain an address.
void PrintTo(const NamedScene& one, std::ostream* out) { *out << one.name; }

std::vector<NamedScene> scenes() {
  using test_support::box_parts;
  using test_support::icosphere_parts;
  using test_support::l_prism_parts;
  using test_support::torus_parts;
  const MeshParts ball = icosphere_parts(3, 3), torus = torus_parts(3, 1, 48, 24);
  const MeshParts coil = test_support::helix_parts(3, 0.4, 1, 6, 32, 8);
  std::vector<NamedScene> all;
  const auto add = [&](const char* name, Op op, std::vector<Primitive> primitives) {
    all.push_back({name, test_support::scene_of(op, std::move(primitives))});
  };
  add("LPrism", Op::kUnion, {mesh(l_prism_parts(2, 1, 1))});
  add("SkewedLPrism", Op::kUnion, {mesh(l_prism_parts(2, 1, 1), skewed())});
  add("Torus", Op::kUnion, {mesh(torus)});
  add("SkewedTorus", Op::kUnion, {mesh(torus, skewed())});
  add("Coil", Op::kUnion, {mesh(coil)});
  add("ColoredFaces", Op::kUnion,
      {colored_mesh(test_support::icosphere_parts(3, 2)), mesh(torus, at(0, 0, 2))});
  Primitive green = colored_mesh(l_prism_parts(2, 1, 1), at(2, 0, 0));
  green.color = csgcore::Color{0, 1, 0, 1};
  add("ColoredCutFaces", Op::kDifference,
      {colored_mesh(test_support::box_parts({-2, -2, -2}, {3, 3, 0.6})),
       colored_mesh(l_prism_parts(2, 1, 1), skewed()), green});
  add("FarFromTheOrigin", Op::kUnion, {mesh(torus, at(1000, -2000, 500))});
  add("Thousandth", Op::kUnion,
      {mesh(l_prism_parts(2, 1, 1), {Mat3{0.001}, {0.1, 0.2, 0.3}}),
       make_sphere(0.05, at(0, 0.2, 0.3))});
  add("BallWithCavityCutOpen", Op::kDifference,
      {mesh(joined({ball, icosphere_parts(2, 2).inside_out()})), cube({0, -4, 0}, {4, 4, 4})});
  add("InsideOut", Op::kUnion,
      {mesh(torus.inside_out()), mesh(l_prism_parts(2, 1, 1).inside_out())});
  add("OverlappingShells", Op::kUnion,
      {mesh(joined(
          {ball, icosphere_parts(2, 2).moved({2, 1, 0}), box_parts({-3, -1, -1}, {0, 1, 3.5})}))});
  add("OverlappingShellsCutOpen", Op::kDifference,
      {mesh(joined(
           {ball, icosphere_parts(2, 2).moved({2, 1, 0}), box_parts({-3, -1, -1}, {0, 1, 3.5})})),
       cube({-5, -5, 0.3}, {5, 5, 5})});
  add("TorusLessCylinders", Op::kDifference,
      {mesh(torus), make_frustum(-2, 2, 0.6, 0.6, at(3, 0, 0)),
       make_frustum(-2, 2, 0.7, 0.3, at(0, 3, 0)), make_frustum(-2, 2, 1, 1, at(-3, 0, 0))});
  add("CylinderLessTori", Op::kDifference,
      {make_frustum(0, 5, 3, 3), mesh(torus, at(0, 0, 5)), mesh(torus, at(0, 0, 2)),
       mesh(coil, at(0, 0, 1))});
  add("TorusAndBall", Op::kIntersection, {mesh(torus), mesh(ball, at(1, 0, 0))});
  add("Coils", Op::kUnion, {mesh(coil), mesh(coil, at(3, 0, 0.5)), make_sphere(2, at(0, 0, 3))});
  add("CubeWithFacesOfAMesh", Op::kUnion,
      {cube({0, 0, 0}, {1, 1, 1}), mesh(l_prism_parts(2, 1, 1)), cube({1, 1, 0}, {2, 2, 1})});
  add("MeshWithFacesOfACube", Op::kUnion,
      {mesh(l_prism_parts(2, 1, 1)), cube({0, 0, 0}, {1, 1, 1})});
  add("CubeWithFacesOfShells", Op::kUnion,
      {cube({0, 0, 0}, {1, 1, 1}),
       mesh(joined({l_prism_parts(2, 1, 1), box_parts(Vec3(1e-7), Vec3(1 - 1e-7))}))});
  add("FlushCuts", Op::kDifference,
      {mesh(l_prism_parts(2, 1, 2)), cube({0, 0, 1}, {1, 1, 2}),
       mesh(box_parts({1, 0, 0}, {2, 1, 1})), make_frustum(1, 2, 0.4, 0.4, at(0.5, 1.5, 0))});
  add("EqualMeshes", Op::kIntersection,
      {mesh(l_prism_parts(2, 1, 1)), mesh(l_prism_parts(2, 1, 1)), mesh(l_prism_parts(2, 1, 2))});
  add("OpenBox", Op::kUnion, {mesh(test_support::open_box_parts({-2, -1, 0}, {2, 1, 1}))});
  add("Sheet", Op::kUnion,
      {mesh(test_support::sheet_parts(3)), make_sphere(0.5, at(1.5, 1.5, 0.2)),
       mesh(test_support::sheet_parts(2), at(0.5, 0, 1))});
  add("OpenBoxLessCylinder", Op::kDifference,
      {mesh(test_support::open_box_parts({-2, -1, 0}, {2, 1, 1})), make_frustum(-1, 2, 0.5, 0.5),
       cube({1, -2, 0.5}, {3, 2, 3})});
  return all;
}

View view_of(const LoadedScene& loaded, Projection projection, double around_deg, double above_deg,
             double distance = 3) {
  View view =
      gl_test::view_from(loaded.solid.bounds(), projection, around_deg, above_deg, distance);
  view.width_px = 160;
  view.height_px = 120;
  return view;
}

/// Returns the pixels that are wrong though the pixels around show the same face by the CPU.
uint64_t wrong_within_faces(const Image& gl, const Image& cpu) {
  const auto differ = [&](const Image& a, size_t i, size_t j) {
    return a.id[i] != cpu.id[j] || glm::length(a.normal[i] - cpu.normal[j]) > kOtherFace;
  };
  uint64_t wrong = 0;
  for (size_t y = 1; y + 1 < cpu.height_px; ++y) {
    for (size_t x = 1; x + 1 < cpu.width_px; ++x) {
      const size_t i = y * cpu.width_px + x;
      bool is_edge = false;
      for (size_t row = y - 1; row <= y + 1; ++row) {
        for (size_t column = x - 1; column <= x + 1; ++column) {
          is_edge |= differ(cpu, row * cpu.width_px + column, i);
        }
      }
      wrong += !is_edge && differ(gl, i, i);
    }
  }
  return wrong;
}

void expect_agreement(const Image& gl, const Image& cpu, const View& view, double size,
                      const std::string& name, const gl_test::EdgeLimits& edges = kEdges) {
  gl_test::expect_agreement(gl, cpu, view, size, edges, name);
  EXPECT_EQ(wrong_within_faces(gl, cpu), 0u) << name;
}

void expect_agreement(LoadedScene& loaded, const View& view, const std::string& name,
                      const gl_test::EdgeLimits& edges = kEdges) {
  expect_agreement(loaded.draw(view), gl_test::draw_by_cpu(loaded, view), view,
                   loaded.solid.bounds().diagonal(), name, edges);
}

class MeshTest : public testing::TestWithParam<NamedScene> {};

INSTANTIATE_TEST_SUITE_P(, MeshTest, testing::ValuesIn(scenes()),
                         [](const auto& instance) { return instance.param.name; });

TEST_P(MeshTest, EveryChannelIsTheTracers) {
  for (const Way& way : gl_test::all_ways()) {
    LoadedScene loaded(GetParam().scene, way);
    for (const Projection projection : {Projection::kPerspective, Projection::kOrthographic}) {
      const std::string name = GetParam().name + ", " + gl_test::name_of(way);
      expect_agreement(loaded, view_of(loaded, projection, 25, 35), name);
      expect_agreement(loaded, view_of(loaded, projection, 205, -22, 1.2), name);
      expect_agreement(loaded, view_of(loaded, projection, 10, 90), name, kAlongAnAxis);
    }
  }
}

/// A hollow ball with a torus in its cavity and a hole through all of it.
Scene rooms() {
  return test_support::scene_of(
      Op::kDifference, {mesh(joined({test_support::icosphere_parts(5, 3),
                                     test_support::icosphere_parts(4, 3).inside_out(),
                                     test_support::torus_parts(2.5, 0.8, 32, 16)})),
                        make_frustum(-6, 6, 0.5, 0.5, at(2, 2, 0)), cube({0, -6, -6}, {6, 0, 0})});
}

TEST(MeshPictureTest, EyeInsideTheSolidACavityAndACut) {
  const Scene scene = rooms();
  for (const Way& way : gl_test::all_ways()) {
    LoadedScene loaded(scene, way);
    View view = view_of(loaded, Projection::kPerspective, 30, 20);
    view.half_height = 0.7;
    for (const Vec3& eye :
         {Vec3{0.1, 0.2, 0.3} /* in the cavity */, Vec3{-2.5, 0.1, 0.2} /* in the torus */,
          Vec3{-3.1, 3.1, 0.5} /* in the ball */, Vec3{2, 2.1, 5} /* in a hole */}) {
      view.eye = eye;
      expect_agreement(loaded, view, "eye inside, " + gl_test::name_of(way));
    }
  }
}

TEST(MeshPictureTest, EyeInAnOpenMesh) {
  const Scene scene = test_support::scene_of(
      Op::kUnion, {mesh(test_support::open_box_parts({-2, -1, 0}, {2, 1, 1})),
                   make_sphere(0.3, at(1, 0, 0.2)), cube({-3, -3, -2}, {3, 3, -1})});
  for (const Way& way : gl_test::all_ways()) {
    LoadedScene loaded(scene, way);
    View view = view_of(loaded, Projection::kPerspective, 200, 10);
    view.half_height = 1;
    view.eye = {-1, 0.2, 0.7};
    expect_agreement(loaded, view, "eye in an open mesh, " + gl_test::name_of(way));
    loaded.draw(view);
    const Image behind = loaded.renderer.draw_behind(view, loaded.settings, loaded.stats);
    EXPECT_EQ(behind.id, gl_test::draw_by_cpu(loaded, view, csgcore::Boundary::kBehind).id);
  }
}

TEST(MeshPictureTest, BehindASheetIsItsOtherSide) {
  const Scene scene = test_support::scene_of(
      Op::kUnion, {mesh(test_support::open_box_parts({-2, -1, 0}, {2, 1, 1}))});
  for (const Way& way : gl_test::all_ways()) {
    LoadedScene loaded(scene, way);
    const View view = view_of(loaded, Projection::kPerspective, 25, 35);
    loaded.draw(view);
    const Image behind = loaded.renderer.draw_behind(view, loaded.settings, loaded.stats);
    const Image cpu = gl_test::draw_by_cpu(loaded, view, csgcore::Boundary::kBehind);
    // Sheets are thicker by OpenGL, so that the other sides do not quite agree.
    const gl_test::Comparison same =
        gl_test::compare(behind, cpu, loaded.solid.bounds().diagonal());
    EXPECT_GT(same.hits, 3000u);
    EXPECT_EQ(same.wrong() + same.id + same.normal, 0u) << same.first << gl_test::name_of(way);
  }
}

TEST(MeshPictureTest, WhatLiesBehindAFront) {
  for (const Scene& scene :
       {rooms(), test_support::scene_of(Op::kUnion,
                                        {mesh(test_support::helix_parts(3, 0.4, 1, 6, 32, 8))})}) {
    for (const Way& way : gl_test::all_ways()) {
      LoadedScene loaded(scene, way);
      const View view = view_of(loaded, Projection::kPerspective, 25, 35);
      loaded.draw(view);
      const Image behind = loaded.renderer.draw_behind(view, loaded.settings, loaded.stats);
      const Image oracle = gl_test::draw_by_cpu(loaded, view, csgcore::Boundary::kBehind);
      expect_agreement(behind, oracle, view, loaded.solid.bounds().diagonal(),
                       "behind, " + gl_test::name_of(way));
    }
  }
}

TEST(MeshPictureTest, RaysThroughVerticesAndEdgesDoNotLeak) {
  const Scene scene = test_support::scene_of(Op::kUnion, {mesh(test_support::slab_parts(40))});
  for (const Way& way : gl_test::all_ways()) {
    LoadedScene loaded(scene, way);
    View view = view_of(loaded, Projection::kOrthographic, 0, 90);
    view.width_px = view.height_px =
        79;  // all centres within the slab, at multiples of half a unit
    view.half_height = 0.25 * view.height_px;
    view.eye = {20, 20, 10};
    view.forward = {0, 0, -1};
    for (const Vec3& right : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{-1, 0, 0}}) {
      view.right = right;
      view.up = glm::cross(view.right, view.forward);
      const Image gl = loaded.draw(view);
      EXPECT_EQ(std::ranges::count(gl.id, 0u), 79 * 79) << gl_test::name_of(way);
      EXPECT_EQ(std::ranges::count(gl.z, 9.0f), 79 * 79) << gl_test::name_of(way);
    }
  }
}

TEST(MeshPictureTest, Samples) {
  const Scene scene = test_support::scene_of(
      Op::kDifference,
      {mesh(test_support::l_prism_parts(2, 1, 1)),
       mesh(test_support::box_parts({0.2, 0.2, 0.5}, {0.8, 0.8, 2})),
       make_polyhedron(Polyhedron::frustum(0.3, 2, 0.4, 0.4, 6), at(1.5, 0.5, 0))});
  for (const Way& way : gl_test::all_ways()) {
    LoadedScene loaded(scene, way);
    const View view = view_of(loaded, Projection::kPerspective, 25, 35);
    const Image plain = loaded.draw(view);
    loaded.settings.samples = 4;
    const Image gl = loaded.draw(view);
    const Image cpu = gl_test::draw_by_cpu(loaded, view);
    uint64_t blended = 0, apart = 0;
    for (size_t i = 0; i < gl.rgb.size(); ++i) {
      blended += gl_test::levels_apart(plain, cpu, i) > gl_test::kLevels;
      apart += gl_test::levels_apart(gl, cpu, i) > gl_test::kLevels;
    }
    EXPECT_GT(blended, 300u);
    EXPECT_LE(apart * 100, blended) << gl_test::name_of(way);
  }
}

TEST(MeshPictureTest, HundredThousandTriangles) {
  const MeshParts torus = test_support::torus_parts(3, 1, 250, 200);
  ASSERT_EQ(torus.triangles.size(), 100'000u);
  const Scene scene = test_support::scene_of(
      Op::kDifference, {mesh(torus), make_sphere(1.5, at(3, 0, 1)), mesh(torus, at(0, 4, 0))});
  for (const Way& way : {Way(leaves_of(8)), gl_test::by_tiles()}) {
    LoadedScene loaded(scene, way);
    expect_agreement(loaded, view_of(loaded, Projection::kPerspective, 25, 35), "100,000");
    expect_agreement(loaded, view_of(loaded, Projection::kOrthographic, 200, -20), "100,000");
  }
}

TEST(MeshPictureTest, BatchesAreTheWholePicture) {
  LoadedScene loaded(rooms(), leaves_of(8));
  const View view = view_of(loaded, Projection::kPerspective, 25, 35);
  const Image whole = loaded.draw(view);
  const Image batches =
      loaded.renderer.draw_while_subdividing(leaves_of(8), view, loaded.settings, loaded.stats);
  EXPECT_EQ(whole.rgb, batches.rgb);
  EXPECT_EQ(whole.id, batches.id);
}

TEST(MeshPictureTest, CellsOfASolid) {
  LoadedScene loaded(rooms(), leaves_of(2));
  loaded.settings.subject = glrender::Subject::kCells;
  const Image cells = loaded.draw(view_of(loaded, Projection::kPerspective, 25, 35));
  const auto shown =
      std::count_if(cells.z.begin(), cells.z.end(), [](float z) { return std::isfinite(z); });
  EXPECT_GT(shown, 1500);
}

/// Many meshes in one list, and polyhedra beside them.
TEST(MeshPictureTest, LongLists) {
  std::vector<Primitive> all{mesh(test_support::icosphere_parts(3, 2))};
  for (int i = 0; i < 40; ++i) {
    const double around = 0.157 * i;
    const Affine place = at(2.5 * std::cos(around), 2.5 * std::sin(around), 0.05 * i - 1);
    all.push_back(i % 2 == 0 ? mesh(test_support::l_prism_parts(2, 1, 0.5), place)
                             : make_polyhedron(Polyhedron::sphere(0.5, 12), place));
  }
  const Scene scene = test_support::scene_of(Op::kDifference, std::move(all));
  for (const Way& way : {Way(leaves_of(64)), gl_test::by_tiles()}) {
    LoadedScene loaded(scene, way);
    View view = view_of(loaded, Projection::kPerspective, 25, 5);
    expect_agreement(loaded, view, "long lists, " + gl_test::name_of(way));
  }
}

/// A hundred plates, the first at x, with a block behind them.
MeshParts plates(double x, double block_x) {
  MeshParts all = test_support::box_parts({block_x, -30, -30}, {120, 30, 30});
  for (int i = 0; i < 100; ++i, x += 1) {
    all = joined({all, test_support::box_parts({x, -30, -30}, {x + 0.4, 30, 30})});
  }
  return all;
}

TEST(MeshPictureTest, PixelsThatTakeTooManyRoundsAreTheTracers) {
  // A ray passes from plate to plate, but only the blocks have points in common.
  const Scene scene =
      test_support::scene_of(Op::kIntersection, {mesh(plates(0, 110)), mesh(plates(0.5, 105))});
  for (const Way& way : {Way(leaves_of(8)), gl_test::by_tiles()}) {
    LoadedScene loaded(scene, way);
    const View view = view_of(loaded, Projection::kOrthographic, 180, 0);
    const Image gl = loaded.draw(view), cpu = gl_test::draw_by_cpu(loaded, view);
    EXPECT_GT(std::ranges::count(cpu.id, 0u) + std::ranges::count(cpu.id, 1u), 1000);
    EXPECT_EQ(gl.rgb, cpu.rgb);
    EXPECT_EQ(gl.id, cpu.id);
    // A few are drawn, too.
    View small = view;
    small.width_px = small.height_px = 3;
    EXPECT_EQ(loaded.draw(small).id, gl_test::draw_by_cpu(loaded, small).id);
  }
}

/// Feigns a lesser driver while it lives.
class FewTexels {
 public:
  explicit FewTexels(uint64_t most) { gl_test::context().set_most_texels(most); }
  ~FewTexels() { gl_test::context().set_most_texels(before_); }

 private:
  uint64_t before_ = gl_test::context().most_texels();
};

TEST(MeshPictureTest, RefusesMeshesThatTheDriverCannotHold) {
  const FewTexels lesser(65536);  // the least that OpenGL asks of a driver
  const auto draw = [&](uint32_t around) {
    const Scene scene =
        test_support::scene_of(Op::kUnion, {mesh(test_support::torus_parts(3, 1, around, 50))});
    const csgcore::Solid solid(csgcore::canonical_primitives(scene), scene.model);
    glrender::Renderer renderer(gl_test::context(), solid);
  };
  EXPECT_NO_THROW(draw(100));
  try {
    draw(200);
    ADD_FAILURE() << "it was not refused";
  } catch (const glrender::GlError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("triangles of meshes need a buffer of"));
    EXPECT_THAT(error.what(), testing::HasSubstr("allows 65536"));
  }
}

}  // namespace
