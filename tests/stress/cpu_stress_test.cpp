// Tests the CPU tracer against the exact ray oracle, on the whole stress suite and on the examples.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "cpu_methods.hpp"
#include "support/full_run.hpp"
#include "support/read_design.hpp"

namespace {

using csgcore::Hits;
using csgcore::Solid;
using stress::Case;
using stress::Family;
using stress::Line;
using stress::Tally;

/// The bars: undecided pixels per hit; and the median error of positions, in model sizes,
/// beyond the rounding of the coordinates.
constexpr double kMostUndecided = 1e-5;
constexpr double kMedianPosition = 1e-13;

/// The lines of all families, for the table's last rows.
std::vector<Line>& all_lines() {
  static std::vector<Line> lines;
  return lines;
}

class PrintTotals : public testing::Environment {
  void TearDown() override {
    if (all_lines().empty()) return;
    stress::print_header();
    for (const Line& line : stress::totals(all_lines(), "all families of this run")) {
      stress::print_line(line);
    }
  }
};
const testing::Environment* const print_totals = testing::AddGlobalTestEnvironment(new PrintTotals);

void expect_exact(const std::vector<Line>& lines, bool has_ties) {
  for (const Line& line : lines) {
    SCOPED_TRACE(line.name + " by " + line.method);
    const Tally& tally = line.tally;
    EXPECT_EQ(tally.wrong_pixels(), 0u) << tally.first_wrong;
    EXPECT_EQ(tally.speckle, 0u);
    EXPECT_LE(tally.position_errors.median(), kMedianPosition + tally.position_rounding);
  }
  for (const Line& total : stress::totals(lines, "")) {
    if (has_ties) break;
    EXPECT_LE(double(total.tally.undecided), kMostUndecided * double(total.tally.hits))
        << total.method;
  }
  std::vector<Line>& all = all_lines();
  all.insert(all.end(), lines.begin(), lines.end());
}

class CpuStressTest : public testing::TestWithParam<Family> {};

TEST_P(CpuStressTest, EqualsTheOracle) {
  expect_exact(stress::run_family(GetParam(), stress::cpu_methods(), stress::kDoubleTolerance),
               GetParam().has_ties);
}

// --- The same bits ---

bool same_bits(const Hits& a, const Hits& b) {
  const auto equal = [](const auto& x, const auto& y) {
    return x.size() == y.size() && std::memcmp(x.data(), y.data(), x.size() * sizeof(x[0])) == 0;
  };
  return equal(a.s, b.s) && equal(a.position, b.position) && equal(a.normal, b.normal) &&
         equal(a.primitive, b.primitive);
}

/// Draws with one thread and with two; `source` is a Solid or a Subdivision.
template <typename Source>
void expect_same_by_threads(const Source& source, const csgcore::View& view) {
  csgcore::TraceOptions one, two;
  one.threads = 1;
  two.threads = 2;
  csgcore::TraceStats stats;
  Hits by_one, by_two;
  csgcore::trace(source, view, one, by_one, stats);
  csgcore::trace(source, view, two, by_two, stats);
  EXPECT_TRUE(same_bits(by_one, by_two));
  one.samples = two.samples = 4;
  csgcore::Image image_by_one, image_by_two;
  csgcore::draw(source, view, {}, one, image_by_one, stats);
  csgcore::draw(source, view, {}, two, image_by_two, stats);
  EXPECT_EQ(image_by_one.rgb, image_by_two.rgb);
}

TEST_P(CpuStressTest, SamePictureByOneThreadAndByTwo) {
  for (const Case* one : stress::cases_to_run(GetParam())) {
    SCOPED_TRACE(one->name);
    const csgcore::Scene scene = one->make();
    const Solid solid(csgcore::canonical_primitives(scene), scene.model);
    const csgcore::Subdivision subdivision(solid, {});
    for (const stress::Camera& camera : one->cameras(scene, stress::picture_size())) {
      SCOPED_TRACE(camera.name);
      expect_same_by_threads(solid, camera.view);
      expect_same_by_threads(subdivision, camera.view);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(, CpuStressTest, testing::ValuesIn(stress::families()),
                         [](const auto& instance) { return instance.param.name; });

// --- The examples ---

std::vector<std::filesystem::path> example_files() {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(SCADRAY_EXAMPLES)) {
    const std::filesystem::path& file = entry.path();
    // csN and ccN include cut_cylinder.
    if (file.extension() == ".scad" && file.stem() != "cut_cylinder") files.push_back(file);
  }
  std::sort(files.begin(), files.end());
  return files;
}

TEST(CpuExamplesTest, EqualTheOracle) {
  Family examples{"examples", {}};
  for (const std::filesystem::path& file : example_files()) {
    // The sample has one example of each kind, the full run all.
    const std::string name = file.stem().string();
    const bool is_large = name.size() > 5 && name.ends_with("00");
    examples.cases.push_back({name, [file] { return test_support::read_design(file).scene; },
                              stress::default_cameras, is_large});
  }
  EXPECT_GE(stress::cases_to_run(examples).size(), 5u);
  const std::vector<stress::Method> methods{stress::cpu_method("tiles"), stress::cpu_method("K=8"),
                                            stress::cpu_method("K=64")};
  expect_exact(stress::run_family(examples, methods, stress::kDoubleTolerance), false);
}

}  // namespace
