// Tests the facets of OpenSCAD's primitives, and the half-spaces that define them.
#include "csgcore/facets.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <set>
#include <string>

#include "openscad_mesh.hpp"

namespace csgcore {
namespace {

TEST(FragmentCount, IsOpenSCADs) {
  const double inf = std::numeric_limits<double>::infinity();
  struct Case {
    double radius;
    FacetSettings settings;
    int fragments;
  };
  const Case cases[] = {
      {1, {}, 5},                  // 2π/2 is less than the least count
      {5, {}, 16},                 // 2π·5/2 = 15.7
      {100, {}, 30},               // 360/12
      {100, {0, 1, 0.1}, 360},     //
      {1e4, {0, 0, 0.01}, 36000},  // $fa is 0.01 at least
      {1, {0, 12, 0}, 30},         //
      {1, {2, 12, 2}, 3},          //
      {1, {6.9, 12, 2}, 6},        // truncated, not rounded
      {1, {inf, 12, 2}, 3},        //
      {9e-7, {50, 12, 2}, 3},      // below 2⁻²⁰
      {1, {1e30, 12, 2}, 2147483647},
  };
  for (const Case& c : cases) {
    EXPECT_EQ(fragment_count(c.radius, c.settings), c.fragments)
        << c.radius << ' ' << c.settings.fn << ' ' << c.settings.fa << ' ' << c.settings.fs;
  }
}

TEST(Facets, AreAsFineAsTheToleranceAsks) {
  const auto depth = [](double radius, int fragments) {
    return 2 * radius * std::pow(std::sin(std::numbers::pi / fragments / 2), 2);
  };
  for (const double radius : {0.3, 10.0, 1e6}) {
    for (const double tolerance : {1e-9, 1e-3, 0.01}) {
      const int fragments = fragment_count(radius, {.fn = 100, .tolerance = tolerance});
      EXPECT_LE(depth(radius, fragments), tolerance * (1 + 1e-12));
      EXPECT_GT(depth(radius, fragments - 1), tolerance);
    }
  }
  EXPECT_EQ(fragment_count(1, {.tolerance = 5}), 5);
  EXPECT_EQ(fragment_count(1e300, {.tolerance = 1e-300}), std::numeric_limits<int>::max());
}

/// A primitive as text and as this module makes it.
struct MeshCase {
  std::string scad;
  Mesh mesh;
};

std::vector<MeshCase> mesh_cases() {
  std::vector<MeshCase> cases;
  const auto add = [&](const std::string& scad, Mesh mesh) { cases.push_back({scad, mesh}); };
  for (const int fn : {3, 4, 5, 6, 7, 8, 11, 12, 25, 48}) {
    const std::string arguments = ", $fn = " + std::to_string(fn) + ");";
    add("sphere(r = 3.7" + arguments, sphere_mesh(3.7, fn));
    add("cylinder(h = 2, r = 1.3" + arguments, frustum_mesh(0, 2, 1.3, 1.3, fn));
    add("cylinder(h = 2, r1 = 1.3, r2 = 0.4, center = true" + arguments,
        frustum_mesh(-1, 1, 1.3, 0.4, fn));
    add("cylinder(h = 5, r1 = 0, r2 = 2" + arguments, frustum_mesh(0, 5, 0, 2, fn));
    add("cylinder(h = 5, r1 = 2, r2 = 0" + arguments, frustum_mesh(0, 5, 2, 0, fn));
  }
  const FacetSettings fine{0, 5, 0.5};
  add("sphere(r = 2, $fa = 5, $fs = 0.5);", sphere_mesh(2, fragment_count(2, fine)));
  add("cylinder(h = 1, r1 = 2, r2 = 9, $fa = 5, $fs = 0.5);",
      frustum_mesh(0, 1, 2, 9, fragment_count(9, fine)));
  add("sphere(r = 12);", sphere_mesh(12, fragment_count(12, {})));
  add("cube([1, 2, 3]);", box_mesh({{0, 0, 0}, {1, 2, 3}}));
  add("cube(0.7, center = true);", box_mesh({Vec3(-0.35), Vec3(0.35)}));
  return cases;
}

/// Returns whether the values are equal to the six digits that OpenSCAD writes.
bool same_digits(double written, double value) {
  constexpr double kHalfDigit = 5.001e-6;
  constexpr double kNoise = 1e-15;  // sin(180°) is as small as this in some versions
  return std::abs(written - value) <= kHalfDigit * std::abs(value) + kNoise;
}

/// Returns for each vertex of `written` the index of the same vertex of `mesh`, or the size of
/// mesh.vertices if there is none.
std::vector<size_t> matched(const Mesh& written, const Mesh& mesh) {
  std::vector<size_t> result;
  for (const Vec3& w : written.vertices) {
    const auto found = std::find_if(mesh.vertices.begin(), mesh.vertices.end(), [&](const Vec3& v) {
      return same_digits(w.x, v.x) && same_digits(w.y, v.y) && same_digits(w.z, v.z);
    });
    result.push_back(static_cast<size_t>(found - mesh.vertices.begin()));
  }
  return result;
}

/// Returns whether the polygon's corners are among the face's, in the same sense of rotation.
bool is_part_of(const std::vector<size_t>& corners, const std::vector<uint32_t>& face) {
  std::vector<size_t> places;
  for (const size_t corner : corners) {
    const auto found = std::find(face.begin(), face.end(), corner);
    if (found == face.end()) return false;
    places.push_back(static_cast<size_t>(found - face.begin()));
  }
  std::rotate(places.begin(), std::min_element(places.begin(), places.end()), places.end());
  return std::is_sorted(places.begin(), places.end());
}

TEST(Facets, AreOpenSCADs) {
  if (!test_support::openscad_installed()) GTEST_SKIP() << "openscad is not installed";
  for (const MeshCase& c : mesh_cases()) {
    const Mesh written = test_support::openscad_mesh(c.scad);
    const std::vector<size_t> vertices = matched(written, c.mesh);
    const std::set<size_t> different(vertices.begin(), vertices.end());
    ASSERT_FALSE(different.contains(c.mesh.vertices.size())) << c.scad << ": an unknown vertex";
    ASSERT_EQ(different.size(), c.mesh.vertices.size()) << c.scad;

    // OpenSCAD's polygons tile the faces: each is in one face, and their triangles are as many.
    size_t triangles = 0;
    for (const std::vector<uint32_t>& face : c.mesh.faces) triangles += face.size() - 2;
    size_t written_triangles = 0;
    for (const std::vector<uint32_t>& polygon : written.faces) {
      std::vector<size_t> corners;
      for (const uint32_t corner : polygon) {  // OpenSCAD repeats equal points
        const size_t vertex = vertices[corner];
        if (corners.empty() || corners.back() != vertex) corners.push_back(vertex);
      }
      const bool is_part = std::any_of(c.mesh.faces.begin(), c.mesh.faces.end(),
                                       [&](const auto& face) { return is_part_of(corners, face); });
      EXPECT_TRUE(is_part) << c.scad;
      written_triangles += corners.size() - 2;
    }
    EXPECT_EQ(written_triangles, triangles) << c.scad;
  }
}

/// Moves the design so that `vertex` is at the origin, and magnifies it by a power of two that
/// makes a difference in the last bit visible.
std::string magnified(const std::string& scad, const Vec3& vertex) {
  const double scale = std::ldexp(1.0, 60);
  char text[400];
  std::snprintf(text, sizeof text,
                "multmatrix([[%.17g, 0, 0, %.17g], [0, %.17g, 0, %.17g], [0, 0, %.17g, %.17g]]) ",
                scale, -scale * vertex.x, scale, -scale * vertex.y, scale, -scale * vertex.z);
  return text + scad;
}

TEST(Facets, HaveOpenSCADsBits) {
  if (!test_support::openscad_installed()) GTEST_SKIP() << "openscad is not installed";
  const std::pair<std::string, Mesh> cases[] = {
      {"sphere(r = 3.7, $fn = 7);", sphere_mesh(3.7, 7)},
      {"sphere(r = 0.3, $fn = 48);", sphere_mesh(0.3, 48)},
      {"cylinder(h = 0.7, r1 = 1.1, r2 = 0.3, center = true, $fn = 13);",
       frustum_mesh(-0.35, 0.35, 1.1, 0.3, 13)}};
  constexpr size_t kVertices = 15;  // vertices of each, evenly from the first to the last
  for (const auto& [scad, mesh] : cases) {
    for (size_t i = 0; i < kVertices; ++i) {
      const Vec3& vertex = mesh.vertices[i * (mesh.vertices.size() - 1) / (kVertices - 1)];
      const Mesh written = test_support::openscad_mesh(magnified(scad, vertex));
      EXPECT_THAT(written.vertices, testing::Contains(Vec3(0.0)))
          << scad << ' ' << vertex.x << ' ' << vertex.y << ' ' << vertex.z;
    }
  }
}

double signed_distance(const HalfSpace& h, const Vec3& p) {
  return (glm::dot(h.normal, p) - h.offset) / glm::length(h.normal);
}

/// Fails unless every face is in a half-space's boundary, no vertex is outside of any, and each has
/// a face.
void expect_bounds(const std::vector<HalfSpace>& half_spaces, const Mesh& mesh,
                   const std::string& name) {
  constexpr double kRounding = 1e-14;  // some ulps of coordinates below 12
  ASSERT_EQ(half_spaces.size(), mesh.faces.size()) << name;
  for (const HalfSpace& h : half_spaces) {
    for (const Vec3& v : mesh.vertices) EXPECT_LE(signed_distance(h, v), kRounding) << name;
    const bool has_face = std::any_of(mesh.faces.begin(), mesh.faces.end(), [&](const auto& face) {
      return std::all_of(face.begin(), face.end(), [&](uint32_t vertex) {
        return std::abs(signed_distance(h, mesh.vertices[vertex])) <= kRounding;
      });
    });
    EXPECT_TRUE(has_face) << name;
  }
}

TEST(HalfSpaces, BoundTheMesh) {
  for (const int fragments : {3, 4, 5, 6, 7, 8, 12, 31, 48}) {
    const std::string name = std::to_string(fragments) + " fragments";
    expect_bounds(half_spaces(faceted_sphere(3.7, fragments)), sphere_mesh(3.7, fragments), name);
    expect_bounds(half_spaces(faceted_frustum(-1, 2, 1.3, 1.3, fragments)),
                  frustum_mesh(-1, 2, 1.3, 1.3, fragments), name);
    expect_bounds(half_spaces(faceted_frustum(-1, 2, 0, 1.3, fragments)),
                  frustum_mesh(-1, 2, 0, 1.3, fragments), name);
    expect_bounds(half_spaces(faceted_frustum(-1, 2, 4.3, 0, fragments)),
                  frustum_mesh(-1, 2, 4.3, 0, fragments), name);
  }
  const Box box{{-1, 2, 3}, {4, 5, 6}};
  expect_bounds(half_spaces(box), box_mesh(box), "box");
}

// The planes have the polygon's own numbers where these are exact, so that they meet where they
// should.
TEST(HalfSpaces, AreExactWhereTheAnglesAre) {
  const std::vector<HalfSpace> hexagon = half_spaces(faceted_frustum(0, 1, 5, 5, 6));
  EXPECT_EQ(hexagon[0].normal.x, 1);  // of the sector from 0 to 60°, and of the one from −60° to 0
  EXPECT_EQ(hexagon[5].normal.x, 1);
  EXPECT_EQ(hexagon[0].normal.z, 0);
  EXPECT_EQ(hexagon[0].offset, 5);
  for (const HalfSpace& side : std::vector(hexagon.begin(), hexagon.end() - 2)) {
    EXPECT_EQ(side.offset, 5);
  }
}

TEST(HalfSpaces, OfConvexMeshes) {
  for (const Mesh& mesh : {sphere_mesh(3.7, 12), frustum_mesh(0, 1, 2, 1, 5),
                           frustum_mesh(0, 1, 0, 1, 8), box_mesh({{0, 0, 0}, {1, 2, 3}})}) {
    const std::optional<std::vector<HalfSpace>> result = half_spaces(mesh);
    ASSERT_TRUE(result);
    expect_bounds(*result, mesh, "mesh");
  }
}

TEST(HalfSpaces, OfMeshesRoundedToSixDigits) {
  Mesh mesh = sphere_mesh(37, 12);
  for (Vec3& v : mesh.vertices) v = glm::round(v * 1e4) / 1e4;
  const std::optional<std::vector<HalfSpace>> result = half_spaces(mesh);
  ASSERT_TRUE(result);
  for (const HalfSpace& h : *result) {
    for (const Vec3& v : mesh.vertices) EXPECT_LE(signed_distance(h, v), 1e-14 * 37);
  }
}

TEST(HalfSpaces, OfNoConvexSolid) {
  const Mesh box = box_mesh({{0, 0, 0}, {1, 1, 1}});
  Mesh open = box;
  open.faces.pop_back();
  EXPECT_FALSE(half_spaces(open));

  Mesh inside_out = box;
  for (auto& face : inside_out.faces) std::reverse(face.begin(), face.end());
  EXPECT_TRUE(half_spaces(inside_out));  // the solid is unambiguous

  Mesh bent = box;
  bent.vertices[7] *= 1.001;  // three faces are no longer plane
  EXPECT_FALSE(half_spaces(bent));
  bent.vertices[7] = Vec3(1 + 1e-6);  // as far as the file's digits
  EXPECT_TRUE(half_spaces(bent));

  Mesh dented = box;  // its lid is a funnel
  dented.vertices.push_back({0.5, 0.5, 0.9});
  dented.faces.erase(dented.faces.begin());
  for (const auto& [a, b] : {std::pair(4u, 5u), {5u, 7u}, {7u, 6u}, {6u, 4u}}) {
    dented.faces.push_back({a, b, 8});
  }
  EXPECT_FALSE(half_spaces(dented));
  dented.vertices[8].z = 1.1;  // a roof
  EXPECT_TRUE(half_spaces(dented));

  Mesh flat;
  flat.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  flat.faces = {{0, 1, 2}, {2, 1, 0}};
  EXPECT_FALSE(half_spaces(flat));

  Mesh two = box;  // a solid beside it
  for (const Vec3& v : box.vertices) two.vertices.push_back(v + Vec3(3.0));
  for (auto face : box.faces) {
    for (uint32_t& vertex : face) vertex += 8;
    two.faces.push_back(face);
  }
  EXPECT_FALSE(half_spaces(two));

  Mesh nowhere = box;
  nowhere.vertices[0].x = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(half_spaces(nowhere));
  EXPECT_FALSE(half_spaces(Mesh{}));
}

}  // namespace
}  // namespace csgcore
