// Tests --facets=all against the meshes that OpenSCAD makes of the same files: the exact volume,
// and the first hits of rays. Prints a table.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "csgcore/polyhedron.hpp"
#include "csgcore/tracer.hpp"
#include "frontend/camera.hpp"
#include "frontend/importer.hpp"
#include "frontend/parser.hpp"
#include "oracle/nef_solid.hpp"
#include "support/full_run.hpp"
#include "support/openscad_mesh.hpp"
#include "support/read_design.hpp"

namespace frontend {
namespace {

using csgcore::Vec3;

/// The bar.
constexpr double kVolumeTolerance = 1e-5;
/// The distance of a mesh's surface from ours, as a share of the design's size: OpenSCAD does not
/// heal the file's six digits, snaps vertices to a grid of 2⁻²⁰, and writes them as floats.
constexpr double kMeshError = 1e-5;

/// Spheres, cylinders and cones with all kinds of fragments, in frames with rounded matrices.
const std::string kMixed =
    "difference() {"
    "  multmatrix([[0.689851,-0.544118,0.477537,1],[0.607024,0.79419,0.0280116,2],"
    "              [-0.394496,0.270552,0.878165,3],[0,0,0,1]]) { union() {"
    "    cube(size = [20, 14, 9], center = true); sphere($fn = 0, $fa = 30, $fs = 2, r = 9);"
    "    cylinder($fn = 7, $fa = 12, $fs = 2, h = 16, r1 = 6, r2 = 0, center = false); } }"
    "  cylinder($fn = 0, $fa = 12, $fs = 2, h = 40, r1 = 2, r2 = 4, center = true);"
    "  multmatrix([[1,0,0,9],[0,1,0,3.33333],[0,0,1,7]]) { sphere($fn = 9, r = 6); }"
    "  multmatrix([[1,0,0.3,-9],[0,-1,0,0],[0,0,1,0]]) {"
    "    cylinder($fn = 5, h = 30, r1 = 0, r2 = 4, center = true); }"
    "}";

/// Returns the first crossing of the ray with the mesh at s > 0; +∞ if there is none.
double first_hit(const csgcore::Mesh& triangles, const csgcore::Ray& ray) {
  // Triangles are slightly enlarged, so that no ray slips between two (Möller and Trumbore).
  constexpr double kOutside = -1e-9;
  double first = std::numeric_limits<double>::infinity();
  for (const std::vector<uint32_t>& face : triangles.faces) {
    const Vec3& a = triangles.vertices[face[0]];
    const Vec3 ab = triangles.vertices[face[1]] - a;
    const Vec3 ac = triangles.vertices[face[2]] - a;
    const Vec3 p = glm::cross(ray.direction, ac);
    const double determinant = glm::dot(ab, p);
    if (determinant == 0) continue;
    const Vec3 offset = ray.origin - a;
    const double u = glm::dot(offset, p) / determinant;
    if (u < kOutside) continue;
    const Vec3 q = glm::cross(offset, ab);
    const double v = glm::dot(ray.direction, q) / determinant;
    if (v < kOutside || u + v > 1 - kOutside) continue;
    const double s = glm::dot(ac, q) / determinant;
    if (s > 0) first = std::min(first, s);
  }
  return first;
}

struct Tally {
  uint64_t hits = 0;
  uint64_t undecided = 0;  // agree with the mesh only if displaced a little
  uint64_t wrong = 0;
};

/// Compares the tracer's hits with the mesh.
Tally compare(const csgcore::Hits& hits, const csgcore::View& view, const csgcore::Mesh& mesh,
              double margin) {
  Tally tally;
  for (uint32_t i = 0; i < hits.s.size(); ++i) {
    csgcore::Ray ray = csgcore::pixel_ray(view, i % view.width_px, i / view.width_px);
    const auto agrees = [&](double s) {
      if (!std::isfinite(s) || !std::isfinite(hits.s[i])) return s == hits.s[i];
      const double thickness = std::abs(glm::dot(hits.normal[i], ray.direction));
      return std::abs(s - hits.s[i]) * thickness <= margin;
    };
    tally.hits += std::isfinite(hits.s[i]);
    if (agrees(first_hit(mesh, ray))) continue;
    bool beside = false;
    const Vec3 eye = ray.origin;
    for (int x = -1; x <= 1; ++x) {
      for (int y = -1; y <= 1; ++y) {
        const double sideways = x == 0 && y == 0 ? 0 : margin;
        ray.origin = eye + sideways * (double(x) * view.right + double(y) * view.up);
        beside = beside || agrees(first_hit(mesh, ray));
      }
    }
    ++(beside ? tally.undecided : tally.wrong);
  }
  return tally;
}

double exact_volume(const csgcore::Scene& scene) {
  std::vector<oracle::FacetedSolid> polyhedra;
  for (const csgcore::Primitive& primitive : scene.primitives) {
    EXPECT_EQ(primitive.shape(), csgcore::Shape::kPolyhedron);
    polyhedra.push_back({primitive.polyhedron()->half_spaces(), primitive.local_to_world});
  }
  const oracle::NefBuild build = oracle::NefSolid::build(scene.model, polyhedra);
  EXPECT_EQ(build.status, oracle::NefStatus::kBuilt) << build.reason;
  return build.solid ? build.solid->volume().get_d() : 0;
}

void expect_openscads_solid(const std::string& name, const std::string& csg) {
  if (!test_support::openscad_installed()) GTEST_SKIP() << "openscad is not installed";
  const ImportedDesign design = import_design(parse(csg, name), {.facets = Facets::kAll});
  EXPECT_TRUE(design.warnings.empty());
  const csgcore::Mesh mesh = test_support::openscad_triangles(csg);
  ASSERT_FALSE(mesh.faces.empty());

  const double volume = exact_volume(design.scene);
  const double expected = test_support::volume_of(mesh);
  EXPECT_NEAR(volume / expected, 1, kVolumeTolerance);

  const csgcore::Solid solid(csgcore::canonical_primitives(design.scene), design.scene.model);
  const double size = solid.bounds().diagonal();
  CameraOptions options;
  options.width_px = test_support::full_run() ? 160 : 64;
  options.height_px = options.width_px * 3 / 4;
  Tally sum;
  for (const Vec3& rotation_deg : {Vec3(55, 0, 25), Vec3(130, 0, 200), Vec3(80, 20, 120)}) {
    const csgcore::View view =
        make_view({solid.bounds().center(), rotation_deg, 3 * size}, options);
    csgcore::Hits hits;
    csgcore::TraceStats stats;
    csgcore::trace(solid, view, {}, hits, stats);
    const Tally tally = compare(hits, view, mesh, kMeshError * size);
    sum.hits += tally.hits;
    sum.undecided += tally.undecided;
    sum.wrong += tally.wrong;
  }
  std::printf(
      "%-14s %6zu triangles, volume %.8g, off by %8.1e; %5llu hits, %llu undecided, %llu "
      "wrong\n",
      name.c_str(), mesh.faces.size(), volume, volume / expected - 1,
      static_cast<unsigned long long>(sum.hits), static_cast<unsigned long long>(sum.undecided),
      static_cast<unsigned long long>(sum.wrong));
  EXPECT_GT(sum.hits, 500u);
  EXPECT_EQ(sum.wrong, 0u);
  // These are within the margin of an edge.
  EXPECT_LE(sum.undecided * 100, sum.hits);
}

TEST(OpenScadFacets, OfEveryKind) { expect_openscads_solid("mixed", kMixed); }

class FacetedExample : public testing::TestWithParam<const char*> {};

TEST_P(FacetedExample, IsOpenScadsSolid) {
  const std::string name = GetParam();
  if (name != "nut_trap" && !test_support::full_run()) {
    GTEST_SKIP() << "run with SCADRAY_TEST_FULL=1";
  }
  expect_openscads_solid(name, test_support::csg_text(SCADRAY_EXAMPLES_DIR "/" + name + ".scad"));
}

// OpenSCAD meshes these in up to 20 s of processor time, and cc100 in 4 minutes. The knob, t1022,
// cs100 and all larger ones take more than 5.
INSTANTIATE_TEST_SUITE_P(, FacetedExample,
                         testing::Values("nut_trap", "bracket", "dodecahedron", "three_spheres",
                                         "r9", "pulley", "flange", "cc100"),
                         [](const auto& instance) { return std::string(instance.param); });

}  // namespace
}  // namespace frontend
