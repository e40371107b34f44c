// Tests what minimising leaves of large scenes, and how it is printed.
#include "oracle/minimise.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "csgcore/polyhedron.hpp"
#include "support/models.hpp"
#include "support/reference_test_scenes.hpp"
#include "support/test_meshes.hpp"

namespace oracle {
namespace {

using csgcore::CsgToken;
using csgcore::CsgTreeBuilder;
using csgcore::make_frustum;
using csgcore::make_polyhedron;
using csgcore::make_sphere;
using csgcore::Mat3;
using csgcore::Op;
using csgcore::Polyhedron;
using csgcore::Primitive;
using csgcore::Scene;
using csgcore::Shape;
using csgcore::Vec3;
using csgcore::reference_test::scene_of;

TEST(Minimise, KeepsWhatItTakes) {
  // Accepts a difference of two primitives, the second of which is a cone far up.
  const auto shows = [](const Scene& scene) {
    for (size_t i = 2; i < scene.model.tokens().size(); ++i) {
      const auto tokens = scene.model.tokens().subspan(i - 2, 3);
      if (!tokens[1].is_primitive || tokens[2].is_primitive) continue;
      const Primitive& cut = scene.primitives[tokens[1].value];
      if (tokens[2].op == Op::kDifference && cut.shape() == Shape::kFrustum &&
          cut.as<csgcore::FrustumShape>().r_top == 0 && cut.local_to_world.translation.z > 2.37) {
        return true;
      }
    }
    return false;
  };
  int found = 0;
  for (uint32_t seed = 1; seed <= 150; ++seed) {
    const Scene scene = test_support::random_tree(12, seed);
    if (!shows(scene)) continue;
    ++found;
    const Scene smallest = minimise(scene, shows);
    ASSERT_TRUE(shows(smallest));
    ASSERT_EQ(smallest.model.tokens().size(), 3u) << as_openscad(smallest);
    ASSERT_EQ(smallest.primitives.size(), 2u);
    const Primitive &body = smallest.primitives[0], &cut = smallest.primitives[1];
    EXPECT_EQ(body.shape(), Shape::kSphere);
    EXPECT_EQ(body.as<csgcore::SphereShape>().radius, 1);
    EXPECT_EQ(body.id, 0u);
    EXPECT_EQ(cut.id, 1u);
    EXPECT_EQ(cut.as<csgcore::FrustumShape>().r_bottom, 1);
    EXPECT_EQ(body.local_to_world.linear, Mat3(1.0));
    EXPECT_EQ(body.local_to_world.translation, Vec3(0.0));
    EXPECT_EQ(cut.local_to_world.translation.x, 0);
    EXPECT_LE(as_cpp(smallest).size(), 300u) << as_cpp(smallest);
  }
  EXPECT_GT(found, 5);
}

TEST(Minimise, PolyhedraBecomeSimpler) {
  const Scene scene = scene_of(Op::kUnion, {make_polyhedron(Polyhedron::sphere(3, 40)),
                                            make_polyhedron(Polyhedron::frustum(0, 4, 3, 2, 9))});
  const auto faces_of = [&](size_t least) {
    const Scene smallest = minimise(scene, [&](const Scene& s) {
      return std::any_of(s.primitives.begin(), s.primitives.end(), [&](const Primitive& p) {
        return p.polyhedron() && p.polyhedron()->half_spaces().size() >= least;
      });
    });
    EXPECT_EQ(smallest.primitives.size(), 1u);
    return smallest.primitives[0].polyhedron()->half_spaces().size();
  };
  EXPECT_EQ(faces_of(1), 4u);  // a tetrahedron
  EXPECT_EQ(faces_of(5), 5u);  // a prism
  EXPECT_EQ(faces_of(6), 6u);  // a cube
  EXPECT_EQ(faces_of(9), 9u);
  EXPECT_EQ(faces_of(15), 23u);  // a sphere of seven fragments
  EXPECT_EQ(faces_of(30), 19 * 40 + 2u);
}

TEST(Minimise, MeshesLoseVertices) {
  const Scene scene =
      scene_of(Op::kUnion, {csgcore::make_mesh(test_support::torus_parts(3, 1, 12, 8).mesh()),
                            csgcore::make_mesh(test_support::icosphere_parts(1, 2).mesh())});
  const auto smallest = [&](const auto& shows) {
    const Scene result = minimise(scene, [&](const Scene& s) {
      return std::any_of(s.primitives.begin(), s.primitives.end(),
                         [&](const Primitive& p) { return p.mesh() && shows(*p.mesh()); });
    });
    EXPECT_EQ(result.primitives.size(), 1u);
    return result.primitives[0].as<csgcore::MeshShape>().mesh;
  };
  const auto is_closed = [](const csgcore::TriangleMesh& mesh) {
    return mesh.is_closed() && mesh.vertices().size() >= 4;
  };
  EXPECT_EQ(smallest(is_closed)->vertices().size(), 4u);
  const auto is_open = [](const csgcore::TriangleMesh& mesh) { return !mesh.is_closed(); };
  EXPECT_EQ(smallest(is_open)->triangles().size(), 1u);
}

TEST(Minimise, WhatHoldsOfNothingElseStays) {
  const Scene scene = test_support::random_tree(9, 4);
  const std::string text = as_cpp(scene);
  const Scene same = minimise(scene, [&](const Scene& other) { return as_cpp(other) == text; });
  EXPECT_EQ(as_cpp(same), text);
}

TEST(Minimise, GivesUp) {
  uint32_t tries = 0;
  const Scene scene = test_support::random_tree(200, 7);
  const auto count = [&](const Scene&) { return ++tries % 3 == 0; };
  const Scene smaller = minimise(scene, count, 50);
  EXPECT_EQ(tries, 50u);
  EXPECT_LT(smaller.model.tokens().size(), scene.model.tokens().size());
  EXPECT_TRUE(minimise({}, count).model.empty());
}

TEST(SceneText, Cpp) {
  const Scene scene =
      scene_of(Op::kDifference,
               {make_sphere(0.1), make_frustum(-1, 1e-9, 2, 0, {Mat3(2.0), Vec3(1, -2, 0.1)}),
                make_polyhedron(Polyhedron::box({Vec3(0), Vec3(1, 2, 3)}))});
  EXPECT_EQ(as_cpp(scene),
            "Scene scene;\n"
            "scene.primitives = {\n"
            "    make_sphere(0.1, {Mat3(1.0), Vec3(0, 0, 0)}),\n"
            "    make_frustum(-1, 1e-09, 2, 0, {Mat3(Vec3(2, 0, 0), Vec3(0, 2, 0), "
            "Vec3(0, 0, 2)), Vec3(1, -2, 0.1)}),\n"
            "    make_polyhedron(std::make_shared<Polyhedron>(std::vector<HalfSpace>{"
            "{{1, 0, 0}, 1}, {{-1, -0, -0}, -0}, {{0, 1, 0}, 2}, {{-0, -1, -0}, -0}, "
            "{{0, 0, 1}, 3}, {{-0, -0, -1}, -0}}, std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, "
            "{0, 2, 0}, {1, 2, 0}, {0, 0, 3}, {1, 0, 3}, {0, 2, 3}, {1, 2, 3}}), "
            "{Mat3(1.0), Vec3(0, 0, 0)})};\n"
            "CsgTreeBuilder builder;\n"
            "builder.open(Op::kDifference);\n"
            "builder.primitive(0);\n"
            "builder.primitive(1);\n"
            "builder.primitive(2);\n"
            "builder.close();\n"
            "scene.model = builder.finish();\n");
}

TEST(SceneText, Meshes) {
  const csgcore::Primitive mesh =
      csgcore::make_mesh(test_support::tetrahedron_parts(1.5).mesh(), {Mat3(1.0), Vec3(0, 0, 1)});
  const Scene scene = scene_of(Op::kUnion, {mesh, make_sphere(1)});
  EXPECT_NE(as_cpp(scene).find("make_mesh(std::make_shared<TriangleMesh>(std::vector<Vec3>{"
                               "{1.5, 1.5, 1.5}, {-1.5, -1.5, 1.5}, {-1.5, 1.5, -1.5}, "
                               "{1.5, -1.5, -1.5}}, std::vector<TriangleMesh::Triangle>{{"),
            std::string::npos)
      << as_cpp(scene);
  // OpenSCAD's faces are clockwise as seen from outside.
  const auto [a, b, c] = mesh.mesh()->triangles()[0];
  const std::string face =
      "[" + std::to_string(a) + ", " + std::to_string(c) + ", " + std::to_string(b) + "]";
  EXPECT_NE(as_openscad(scene).find("translate([0, 0, 1]) polyhedron([[1.5, 1.5, 1.5], [-1.5, "
                                    "-1.5, 1.5], [-1.5, 1.5, -1.5], [1.5, -1.5, -1.5]], [" +
                                    face),
            std::string::npos)
      << as_openscad(scene);
}

TEST(SceneText, OpenScad) {
  const Scene scene =
      scene_of({make_sphere(2, {Mat3(1.0), Vec3(0, 0, 1)}), make_frustum(-1, 2, 3, 0),
                make_polyhedron(Polyhedron::frustum(0, 1, 1, 0, 4))},
               [](CsgTreeBuilder& builder) {
                 builder.open(Op::kDifference);
                 builder.open(Op::kIntersection);
                 builder.primitive(0);
                 builder.primitive(1);
                 builder.close();
                 builder.primitive(2);
                 builder.close();
               });
  EXPECT_EQ(as_openscad(scene),
            "difference() {\n"
            "  intersection() {\n"
            "    translate([0, 0, 1]) sphere(2);\n"
            "    translate([0, 0, -1]) cylinder(3, 3, 0);\n"
            "  }\n"
            "  polyhedron([[1, 0, 0], [0, 1, 0], [-1, -0, 0], [-0, -1, 0], [0, 0, 1]], "
            "[[0, 4, 1], [1, 4, 2], [2, 4, 3], [0, 3, 4], [0, 1, 2, 3]]);\n"
            "}\n");
}

}  // namespace
}  // namespace oracle
