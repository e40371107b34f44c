// Tests triangle meshes by OpenGL against the CPU tracer's picture.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>

#include "agreement.hpp"
#include "csgcore/polyhedron.hpp"
#include "support/mesh_models.hpp"
#include "support/models.hpp"

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
using gl_test::leaves_of;
using gl_test::LoadedScene;
using gl_test::Way;
using test_support::joined;
using test_support::mesh_of;
using test_support::reversed;
using test_support::Shell;

/// Normals of one triangle are equal up to rounding; those of neighbours are further apart, even in
/// the finest mesh.
constexpr double kOtherFace = 1e-4;
constexpr gl_test::EdgeLimits kEdges{.face_distance = kOtherFace};
/// For views along an axis, where rays lie in edges.
constexpr gl_test::EdgeLimits kAlongAnAxis{.face_distance = kOtherFace, .hits_per_edge_pixel = 500};

const Way kWays[] = {leaves_of(2), leaves_of(8), gl_test::by_tiles()};

Affine at(double x, double y, double z) { return {Mat3{1.0}, {x, y, z}}; }

/// A sheared, mirrored, uneven map.
Affine skewed() { return {Mat3{Vec3{-1, 0.3, 0}, Vec3{0.5, 2, 0.1}, Vec3{0, 0.7, 1}}, {7, 8, 9}}; }

Primitive mesh(Shell shell, const Affine& place = {}) {
  return make_mesh(mesh_of(std::move(shell)), place);
}

Primitive cube(const Vec3& min, const Vec3& max) {
  return make_polyhedron(Polyhedron::box({min, max}));
}

struct NamedScene {
  std::string name;
  Scene scene;
};

/// Prints the scene for the test's name, which must not contain an address.
void PrintTo(const NamedScene& one, std::ostream* out) { *out << one.name; }

std::vector<NamedScene> scenes() {
  using test_support::ball_shell;
  using test_support::box_shell;
  using test_support::l_prism_shell;
  using test_support::torus_shell;
  const Shell ball = ball_shell(3, 3), torus = torus_shell(3, 1, 48, 24);
  const Shell coil = test_support::coil_shell(3, 0.4, 1, 6, 32, 8);
  std::vector<NamedScene> all;
  const auto add = [&](const char* name, Op op, std::vector<Primitive> primitives) {
    all.push_back({name, test_support::scene_of(op, std::move(primitives))});
  };
  add("LPrism", Op::kUnion, {mesh(l_prism_shell(1))});
  add("SkewedLPrism", Op::kUnion, {mesh(l_prism_shell(1), skewed())});
  add("Torus", Op::kUnion, {mesh(torus)});
  add("SkewedTorus", Op::kUnion, {mesh(torus, skewed())});
  add("Coil", Op::kUnion, {mesh(coil)});
  add("FarFromTheOrigin", Op::kUnion, {mesh(torus, at(1000, -2000, 500))});
  add("Thousandth", Op::kUnion,
      {mesh(l_prism_shell(1), {Mat3{0.001}, {0.1, 0.2, 0.3}}), make_sphere(0.05, at(0, 0.2, 0.3))});
  add("BallWithCavityCutOpen", Op::kDifference,
      {mesh(joined({ball, reversed(ball_shell(2, 2))})), cube({0, -4, 0}, {4, 4, 4})});
  add("InsideOut", Op::kUnion, {mesh(reversed(torus)), mesh(reversed(l_prism_shell(1)))});
  add("OverlappingShells", Op::kUnion,
      {mesh(joined({ball, ball_shell(2, 2, {2, 1, 0}), box_shell({-3, -1, -1}, {0, 1, 3.5})}))});
  add("OverlappingShellsCutOpen", Op::kDifference,
      {mesh(joined({ball, ball_shell(2, 2, {2, 1, 0}), box_shell({-3, -1, -1}, {0, 1, 3.5})})),
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
      {cube({0, 0, 0}, {1, 1, 1}), mesh(l_prism_shell(1)), cube({1, 1, 0}, {2, 2, 1})});
  add("MeshWithFacesOfACube", Op::kUnion, {mesh(l_prism_shell(1)), cube({0, 0, 0}, {1, 1, 1})});
  add("FlushCuts", Op::kDifference,
      {mesh(l_prism_shell(2)), cube({0, 0, 1}, {1, 1, 2}), mesh(box_shell({1, 0, 0}, {2, 1, 1})),
       make_frustum(1, 2, 0.4, 0.4, at(0.5, 1.5, 0))});
  add("EqualMeshes", Op::kIntersection,
      {mesh(l_prism_shell(1)), mesh(l_prism_shell(1)), mesh(l_prism_shell(2))});
  add("OpenBox", Op::kUnion, {mesh(test_support::open_box_shell({-2, -1, 0}, {2, 1, 1}))});
  add("OpenBoxLessCylinder", Op::kDifference,
      {mesh(test_support::open_box_shell({-2, -1, 0}, {2, 1, 1})), make_frustum(-1, 2, 0.5, 0.5),
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
  for (const Way& way : kWays) {
    LoadedScene loaded(GetParam().scene, way);
    for (const Projection projection : {Projection::kPerspective, Projection::kOrthographic}) {
      const std::string name = GetParam().name + ", " + gl_test::name_of(way);
      expect_agreement(loaded, view_of(loaded, projection, 25, 35), name);
      expect_agreement(loaded, view_of(loaded, projection, 205, -22, 1.2), name);
      expect_agreement(loaded, view_of(loaded, projection, 10, 90), name, kAlongAnAxis);
    }
  }
}

}  // namespace
