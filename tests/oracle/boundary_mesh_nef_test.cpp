// Compares volume and area of the mesh kernel's results with those of Nef polyhedra, on random
// trees of polyhedra that touch. The full run has 4,000 of them; SCADRAY_TEST_TREES sets another
// number.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <memory>
#include <vector>

#include "csgcore/boundary_mesh.hpp"
#include "oracle/nef_solid.hpp"
#include "support/full_run.hpp"
#include "support/mesh_judge.hpp"
#include "support/random_solids.hpp"

namespace {

using csgcore::BoundaryMesh;
using oracle::FacetedSolid;
using oracle::NefSolid;
using test_support::MeshParts;
using test_support::RandomSolid;

constexpr uint32_t kParts = 4;  // so that they run side by side
constexpr uint32_t kFullTrees = 4'000;
constexpr uint32_t kSampleTrees = 160;
constexpr double kMostDifference = 1e-9;  // relative

uint32_t trees_of_a_part() {
  if (const char* trees = std::getenv("SCADRAY_TEST_TREES")) {
    return uint32_t(std::strtoul(trees, nullptr, 10)) / kParts;
  }
  return (test_support::full_run() ? kFullTrees : kSampleTrees) / kParts;
}

std::unique_ptr<const NefSolid> nef_of(const RandomSolid& solid) {
  std::vector<MeshParts> shells;
  const csgcore::CsgTree tree = solid.tree_of_shells(shells);
  std::vector<FacetedSolid> polyhedra;
  for (const MeshParts& shell : shells) {
    // A mesh needs a vertex, and a tree of nothing names no shell.
    polyhedra.push_back({{}, {}, shell.mesh()});
  }
  oracle::NefBuild build = NefSolid::build(tree, polyhedra);
  EXPECT_EQ(build.status, oracle::NefStatus::kBuilt) << build.reason;
  return std::move(build.solid);
}

/// The error of a coordinate of the result that rounding to double may make.
double rounding_of(const RandomSolid& solid) {
  double largest = 0;
  for (const test_support::SolidOperand& operand : solid.operands) {
    for (const csgcore::Vec3& p : operand.surface.vertices) {
      largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    }
  }
  return largest * std::numeric_limits<double>::epsilon();
}

/// Returns in which way the mesh differs from the Nef polyhedron, or "".
std::string difference(const RandomSolid& solid) {
  const std::unique_ptr<const NefSolid> nef = nef_of(solid);
  if (!nef) return "";
  const BoundaryMesh mesh = csgcore::boundary_mesh(solid.surfaces(), solid.tree());
  const auto volume = double(test_support::volume_of(mesh));
  const auto area = double(test_support::area_of(mesh));
  const double nef_volume = nef->volume().get_d(), nef_area = nef->area();
  // A wall of a billionth has a volume that the rounding of its corners changes by more than 1e-9.
  const double rounding = 4 * rounding_of(solid);
  const double volume_error = kMostDifference * nef_volume + rounding * nef_area;
  const double area_error =
      kMostDifference * nef_area + rounding * double(test_support::edge_length_of(mesh));
  char text[200];
  std::snprintf(text, sizeof(text), "volume %.17g instead of %.17g, area %.17g instead of %.17g",
                volume, nef_volume, area, nef_area);
  const bool is_same =
      std::abs(volume - nef_volume) <= volume_error && std::abs(area - nef_area) <= area_error;
  return is_same ? "" : text;
}

class RandomBoundaryMeshes : public testing::TestWithParam<uint32_t> {};

TEST_P(RandomBoundaryMeshes, EqualNef) {
  const uint32_t trees = trees_of_a_part();
  uint32_t compared = 0;
  for (uint32_t i = 0; compared < trees; ++i) {
    const uint32_t seed = 1 + GetParam() + kParts * i;
    const RandomSolid solid = test_support::random_solid(seed);
    if (!solid.has_shells()) continue;
    ++compared;
    const std::string found = difference(solid);
    if (found.empty()) continue;
    const RandomSolid smallest = test_support::minimised(
        solid, [](const RandomSolid& smaller) { return !difference(smaller).empty(); });
    ADD_FAILURE() << "tree " << seed << ": " << found << "\nsmallest: " << difference(smallest)
                  << "\n"
                  << smallest.as_openscad();
    if (!test_support::full_run()) return;
  }
}

INSTANTIATE_TEST_SUITE_P(, RandomBoundaryMeshes, testing::Range(0u, kParts));

}  // namespace
