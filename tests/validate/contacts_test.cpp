// Tests the Nef oracle's solids of designs with coplanar contacts against cells in rationals,
// OpenSCAD's meshes, and the answers of `scadray validate`. The full run has 400 designs.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <random>
#include <vector>

#include "contact_designs.hpp"
#include "exact_cells.hpp"
#include "frontend/importer.hpp"
#include "frontend/parser.hpp"
#include "nef_judge.hpp"
#include "openscad_mesh.hpp"
#include "support/full_run.hpp"
#include "validation.hpp"

namespace validation {
namespace {

using csgcore::Scene;
using csgcore::Vec3;
using oracle::FacetedSolid;
using oracle::NefSolid;
using oracle::Place;
using oracle::Rational;
using test_support::ExactCells;

uint32_t designs() { return test_support::full_run() ? 400 : 30; }
const char* length() { return test_support::full_run() ? "full run" : "sample"; }

/// Nothing is round: cylinders of 8 fragments or fewer are imported as prisms.
constexpr int kAnyFragments = 3;
Scene scene_of(const std::string& csg) {
  return frontend::import_design(frontend::parse(csg, "contacts.csg")).scene;
}

std::vector<FacetedSolid> polyhedra_of(const Scene& scene) {
  std::vector<FacetedSolid> polyhedra;
  for (const csgcore::Primitive& primitive : scene.primitives) {
    polyhedra.push_back(oracle::faceted(primitive, kAnyFragments));
  }
  return polyhedra;
}

/// Returns a point on the designs' grid, beside it, or anywhere.
Vec3 random_point(std::mt19937& random) {
  constexpr double kBeside = 0x1p-20;
  Vec3 point;
  for (int axis = 0; axis < 3; ++axis) {
    point[axis] = static_cast<double>(random() % 17) / 2 - 4;
    const uint32_t kind = random() % 4;
    if (kind == 0) point[axis] += kBeside;
    if (kind == 1) point[axis] -= kBeside;
    if (kind == 2) point[axis] = static_cast<double>(random()) * 0x1p-29 - 4;
  }
  return point;
}

TEST(CoplanarContacts, NefEqualsExactCells) {
  constexpr int kPoints = 100;
  uint32_t solids = 0, points = 0, points_inside = 0;
  for (uint32_t seed = 1; seed <= designs(); ++seed) {
    const std::string csg = contact_design(seed);
    SCOPED_TRACE("seed " + std::to_string(seed) + ":\n" + csg);
    const Scene scene = scene_of(csg);
    const std::vector<FacetedSolid> polyhedra = polyhedra_of(scene);
    const ExactCells cells(scene.model, polyhedra);
    const oracle::NefBuild nef = NefSolid::build(scene.model, polyhedra);
    ASSERT_EQ(nef.status, oracle::NefStatus::kBuilt) << nef.reason;
    const Rational volume = cells.volume();
    EXPECT_EQ(nef.solid->volume(), volume)
        << nef.solid->volume().get_d() << " for " << volume.get_d();
    solids += volume > 0;
    std::mt19937 random(seed);
    for (int i = 0; i < kPoints; ++i) {
      const Vec3 point = random_point(random);
      const std::optional<bool> is_inside = cells.contains(point);
      if (!is_inside) continue;  // on the solid's boundary, or in a face that it does not have
      ++points;
      points_inside += *is_inside;
      EXPECT_EQ(nef.solid->locate(point), *is_inside ? Place::kInside : Place::kOutside)
          << point.x << ", " << point.y << ", " << point.z;
    }
    if (HasFailure()) return;
  }
  std::printf("%s: %u designs, %u not empty; %u points, %u inside\n", length(), designs(), solids,
              points, points_inside);
  EXPECT_GT(solids, designs() * 3 / 4);
  EXPECT_GT(points_inside, points / 20);
}

TEST(CoplanarContacts, ValidateAgrees) {
  Settings settings;
  settings.points = 300;
  settings.rays = 300;
  settings.views = 0;
  settings.renderer = frontend::RendererKind::kCpu;
  for (uint32_t seed = 1; seed <= designs(); ++seed) {
    const std::string csg = contact_design(seed);
    const Scene scene = scene_of(csg);
    settings.seed = seed;
    const Result result = validate(scene, settings, [](const std::string&, double) {});
    for (const CheckResult& check : result.checks) {
      EXPECT_EQ(check.disagreed, 0u)
          << check.group << ", " << check.name << ", seed " << seed << ":\n"
          << csg << check.disagreements.front();
    }
    if (HasFailure()) return;
  }
}

TEST(CoplanarContacts, HaveOpenSCADsVolume) {
  if (!test_support::openscad_installed()) GTEST_SKIP() << "openscad is not installed";
  /// Vertices are written as floats, on a grid of 2⁻²⁰.
  constexpr double kVertexError = 0x1p-20 + 1e-6;
  const uint32_t count = test_support::full_run() ? designs() : 5;
  for (uint32_t seed = 1; seed <= count; ++seed) {
    const std::string csg = contact_design(seed);
    const Scene scene = scene_of(csg);
    const oracle::NefBuild nef = NefSolid::build(scene.model, polyhedra_of(scene));
    ASSERT_EQ(nef.status, oracle::NefStatus::kBuilt) << nef.reason;
    const double expected = test_support::volume_of(test_support::openscad_triangles(csg));
    EXPECT_NEAR(nef.solid->volume().get_d(), expected, kVertexError * nef.solid->area())
        << "seed " << seed << ":\n"
        << csg;
  }
}

}  // namespace
}  // namespace validation
