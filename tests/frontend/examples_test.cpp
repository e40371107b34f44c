// Tests the designs in examples/: their numbers of primitives, that each .csg which is kept is what
// OpenSCAD makes of the .scad, and that the paper's models agree with the paper.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <glm/geometric.hpp>
#include <map>
#include <set>

#include "frontend/importer.hpp"
#include "frontend/parser.hpp"
#include "support/full_run.hpp"
#include "support/read_design.hpp"
#include "temporary_folder.hpp"

namespace frontend {
namespace {

using csgcore::Primitive;
using csgcore::Shape;
using csgcore::Vec3;

const std::filesystem::path kExamples = SCADRAY_EXAMPLES_DIR;

// The paper's models.
constexpr double kRadius = 10;
constexpr double kHeight = 20;
constexpr double kMaxTiltDeg = 40;
/// The error of coordinates that are computed from sines and roots of doubles.
constexpr double kRounding = 1e-12;

/// The number of primitive nodes of each design.
const std::map<std::string, uint32_t> kPrimitives = {
    {"cs100", 101},       {"cs1000", 1001}, {"cs10000", 10001}, {"cc100", 101},
    {"cc200", 201},       {"cc500", 501},   {"cc1000", 1001},   {"r9", 9},
    {"t1022", 1022},      {"knob", 44},     {"flange", 29},     {"pulley", 25},
    {"three_spheres", 3}, {"nut_trap", 7},  {"bracket", 11},    {"dodecahedron", 2},
    {"vase", 1},          {"gear", 93},     {"box", 31},        {"belt_pulley", 13},
    {"bolt", 5},          {"shell", 1},     {"mould", 7},       {"cap", 39},
    {"sign", 9},          {"stamp", 6},     {"enclosure", 35},  {"handle", 56}};

/// Designs whose 2D nodes and hulls make other numbers of primitives.
const std::set<std::string> kWithFigures = {"gear", "box",   "belt_pulley", "cap",
                                            "sign", "stamp", "enclosure",   "handle"};

std::string contents(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error("cannot read " + path.string());
  return {std::istreambuf_iterator<char>(file), {}};
}

ImportedDesign import_file(const std::filesystem::path& path) {
  return import_design(parse(contents(path), path.string()),
                       {.folder = path.parent_path().string()});
}

bool openscad_installed() { return std::system("command -v openscad >/dev/null 2>&1") == 0; }

/// Runs examples/export.
bool export_into(const std::filesystem::path& folder, const std::string& names) {
  const std::string command =
      "'" + (kExamples / "export").string() + "' -o '" + folder.string() + "' " + names;
  return std::system(command.c_str()) == 0;
}

std::string name_of_instance(const testing::TestParamInfo<std::string>& instance) {
  return instance.param;
}

std::vector<std::string> all_names() {
  std::vector<std::string> names;
  for (const auto& [name, count] : kPrimitives) names.push_back(name);
  return names;
}

std::filesystem::path scad_of(const std::string& name) { return kExamples / (name + ".scad"); }

class Example : public testing::TestWithParam<std::string> {};

TEST_P(Example, HasItsNumberOfPrimitives) {
  const ImportedDesign design = test_support::read_design(scad_of(GetParam()));
  EXPECT_EQ(design.primitive_nodes, kPrimitives.at(GetParam()));
  if (!kWithFigures.contains(GetParam())) {
    EXPECT_EQ(design.scene.primitives.size(), design.primitive_nodes) << "none may be empty";
  }
  EXPECT_FALSE(design.scene.model.empty());
  EXPECT_TRUE(design.warnings.empty());
}

TEST_P(Example, IsRoundEnoughToCompareWithOpenScad) {
  const DesignTree tree = parse(test_support::csg_text(scad_of(GetParam())), GetParam());
  for (const language::NodeArgument& argument : tree.nodes->arguments) {
    if (argument.name != "$fn") continue;
    // Up to 8 fragments the polygon itself is meant.
    EXPECT_THAT(argument.value.number(), testing::AnyOf(testing::Le(8), testing::Ge(48)));
  }
}

INSTANTIATE_TEST_SUITE_P(, Example, testing::ValuesIn(all_names()), name_of_instance);

TEST(Examples, KeptAreWhatOpenScadExports) {
  if (!openscad_installed()) GTEST_SKIP() << "openscad is not installed";
  const TemporaryFolder folder;
  ASSERT_TRUE(export_into(folder.path(), "cs100 nut_trap r9"));
  for (const std::string file : {"cs100.csg", "nut_trap.csg", "r9.csg"}) {
    EXPECT_TRUE(contents(folder / file) == contents(kExamples / file)) << "run examples/export";
  }
}

TEST(Examples, AreAllCounted) {
  std::set<std::string> found;
  for (const auto& entry : std::filesystem::directory_iterator(kExamples)) {
    if (entry.path().extension() == ".scad") found.insert(entry.path().stem());
  }
  found.erase("cut_cylinder");  // the common base of csN and ccN
  EXPECT_THAT(found, testing::UnorderedElementsAreArray(all_names()));
}

// --- The paper's CSn and CCn -----------------------------------------------------------------

/// Where a cutter cuts the surface, and the surface's outward normal there.
struct Bite {
  Vec3 point, normal;
  bool wall = false;
};

/// Returns the place on the cylinder's surface nearest to a point, which must be on it.
Bite bite_at(const Vec3& point) {
  const double across = std::hypot(point.x, point.y);
  Bite bite{point, {0, 0, point.z > 0 ? 1 : -1}};
  if (std::abs(std::abs(point.z) - kHeight / 2) > kRounding) {
    bite.wall = true;
    bite.normal = Vec3(point.x, point.y, 0) / across;
    EXPECT_NEAR(across, kRadius, kRounding);
    EXPECT_LE(std::abs(point.z), kHeight / 2);
  }
  EXPECT_LE(across, kRadius + kRounding);
  return bite;
}

/// Pearson's χ² of counts that should be equal.
double chi_squared(const std::vector<size_t>& counts) {
  double total = 0, sum = 0;
  for (const size_t count : counts) total += double(count);
  const double expected = total / double(counts.size());
  for (const size_t count : counts) sum += (double(count) - expected) * (double(count) - expected);
  return sum / expected;
}

/// Fails unless the bites are uniform by area, in 24 patches of equal area: the wall's in 4 sectors
/// of 4 heights, each cap's in 4 sectors.
void expect_uniform(const std::vector<Bite>& bites) {
  std::vector<size_t> patches(24, 0);
  for (const Bite& bite : bites) {
    const double turn = std::atan2(bite.point.y, bite.point.x) / (2 * std::acos(-1.0)) + 0.5;
    const size_t sector = std::min<size_t>(3, size_t(turn * 4));
    const double height = std::clamp(bite.point.z / kHeight + 0.5, 0.0, 1.0);
    const size_t layer = bite.wall          ? std::min<size_t>(3, size_t(height * 4))
                         : bite.point.z > 0 ? 4
                                            : 5;
    ++patches[layer * 4 + sector];
  }
  // With 23 degrees of freedom, one fair draw in 10,000 exceeds this.
  constexpr double kChiSquared = 55.5;
  EXPECT_LT(chi_squared(patches), kChiSquared) << testing::PrintToString(patches);
  // In a cap, the square of the distance from the axis is uniform.
  std::vector<size_t> rings(4, 0);
  for (const Bite& bite : bites) {
    if (bite.wall) continue;
    const double share =
        (bite.point.x * bite.point.x + bite.point.y * bite.point.y) / (kRadius * kRadius);
    ++rings[std::min<size_t>(3, size_t(share * 4))];
  }
  constexpr double kChiSquaredRings = 21.1;  // the same for 3 degrees of freedom
  EXPECT_LT(chi_squared(rings), kChiSquaredRings) << testing::PrintToString(rings);
}

void expect_body(const Primitive& body) {
  EXPECT_EQ(body.shape(), Shape::kFrustum);
  EXPECT_EQ(body.as<csgcore::FrustumShape>().r_bottom, kRadius);
  EXPECT_EQ(body.as<csgcore::FrustumShape>().r_top, kRadius);
  EXPECT_EQ(body.as<csgcore::FrustumShape>().z_min, -kHeight / 2);
  EXPECT_EQ(body.as<csgcore::FrustumShape>().z_max, kHeight / 2);
}

void expect_spheres(const ImportedDesign& design) {
  const double n = design.primitive_nodes - 1;
  std::vector<Bite> bites;
  expect_body(design.scene.primitives.at(0));
  for (const Primitive& p : design.scene.primitives) {
    if (&p == &design.scene.primitives[0]) continue;
    ASSERT_EQ(p.shape(), Shape::kSphere);
    EXPECT_NEAR(p.as<csgcore::SphereShape>().radius, 20 / std::sqrt(n), kRounding);
    bites.push_back(bite_at(p.local_to_world.translation));
  }
  expect_uniform(bites);
}

TEST(PaperModels, SpheresAreUniformOnTheSurface) {
  for (const char* name : {"cs100", "cs1000", "cs10000"}) {
    SCOPED_TRACE(name);
    expect_spheres(test_support::read_design(scad_of(name)));
  }
}

TEST(PaperModels, ConesBiteThroughTheSurface) {
  for (const char* name : {"cc100", "cc200", "cc500", "cc1000"}) {
    SCOPED_TRACE(name);
    const ImportedDesign design = test_support::read_design(scad_of(name));
    const double n = design.primitive_nodes - 1;
    std::vector<Bite> bites;
    std::vector<size_t> tilts(4, 0);
    expect_body(design.scene.primitives.at(0));
    for (const Primitive& p : design.scene.primitives) {
      if (&p == &design.scene.primitives[0]) continue;
      const auto& [z_min, z_max, r_bottom, r_top] = p.as<csgcore::FrustumShape>();
      ASSERT_EQ(r_bottom, 0) << "the apex is inwards";
      EXPECT_NEAR(r_top, 26 / std::sqrt(n), kRounding);
      EXPECT_NEAR(z_max - z_min, 4 * 26 / std::sqrt(n), kRounding);
      const Vec3 outwards = p.local_to_world.linear[2];
      const Vec3 middle = p.local_to_world.point({0, 0, z_min + (z_max - z_min) * 2 / 3});
      bites.push_back(bite_at(middle));
      const double cosine = glm::dot(glm::normalize(outwards), bites.back().normal);
      const double tilt_deg = std::acos(std::min(1.0, cosine)) * 180 / std::acos(-1.0);
      EXPECT_LE(tilt_deg, kMaxTiltDeg + kRounding);
      ++tilts[std::min<size_t>(3, size_t(tilt_deg / kMaxTiltDeg * 4))];
    }
    expect_uniform(bites);
    EXPECT_THAT(tilts, testing::Each(testing::Gt(n / 8))) << "tilts of all sizes";
  }
}

TEST(PaperModels, AnyNumberIsExported) {
  if (!openscad_installed()) GTEST_SKIP() << "openscad is not installed";
  const TemporaryFolder folder;
  ASSERT_TRUE(export_into(folder.path(), "cc1 cc1234 cs2000"));
  EXPECT_EQ(import_file(folder / "cc1.csg").primitive_nodes, 2u);
  EXPECT_EQ(import_file(folder / "cc1234.csg").primitive_nodes, 1235u);
  EXPECT_EQ(import_file(folder / "cs2000.csg").primitive_nodes, 2001u);
}

TEST(PaperModels, AMillionIsExported) {
  if (!test_support::full_run()) GTEST_SKIP() << "run with SCADRAY_TEST_FULL=1";
  if (!openscad_installed()) GTEST_SKIP() << "openscad is not installed";
  const TemporaryFolder folder;
  ASSERT_TRUE(export_into(folder.path(), "cs1000000"));
  EXPECT_EQ(import_file(folder / "cs1000000.csg").primitive_nodes, 1000001u);
}

TEST(ExportScript, RefusesWhatItDoesNotKnow) {
  const TemporaryFolder folder;
  for (const char* name : {"nonsense", "cs", "csx", "cs1x", "-x"}) {
    EXPECT_FALSE(export_into(folder.path(), std::string(name) + " 2>/dev/null")) << name;
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

}  // namespace
}  // namespace frontend
