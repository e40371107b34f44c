// Tests that extrusions that turn are compared with OpenSCAD's facets.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <optional>

#include "extrusion_judge.hpp"
#include "frontend/parser.hpp"
#include "temporary_folder.hpp"

namespace validation {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr const char* kBar =
    "linear_extrude(height = 6, twist = 60, slices = 1) square([4, 2], center = true);";

/// The corners of the bar as OpenSCAD writes them.
constexpr const char* kCorners =
    "OFF 8 12 0\n"
    "-2 -1 0\n2 -1 0\n2 1 0\n-2 1 0\n"
    "-1.86603 1.23205 6\n0.133975 -2.23205 6\n1.86603 -1.23205 6\n-0.133975 2.23205 6\n";
constexpr const char* kEnds = "3 0 2 1\n3 0 3 2\n3 4 5 6\n3 4 6 7\n";
/// The sides, two triangles each: with OpenSCAD's diagonals, the shorter ones in plan, and with the
/// other ones.
constexpr const char* kSides =
    "3 0 1 5\n3 0 5 4\n3 1 2 6\n3 1 6 5\n3 2 3 7\n3 2 7 6\n3 3 0 4\n3 3 4 7\n";
constexpr const char* kOtherSides =
    "3 0 1 4\n3 1 5 4\n3 1 2 5\n3 2 6 5\n3 2 3 6\n3 3 7 6\n3 3 0 7\n3 0 4 7\n";

class Extrusions : public testing::Test {
 protected:
  /// An openscad that exports these facets, whatever it is asked for.
  void let_openscad_export(const std::string& sides) {
    const std::string file = folder_.write("bar.off", std::string(kCorners) + kEnds + sides);
    openscad_.emplace("OPENSCAD", folder_.script("openscad", "cat '" + file + "'"));
  }

  static Result judged(const std::string& text, const frontend::ImportOptions& options = {}) {
    Settings settings;
    settings.rays = 500;
    return judge_extrusions(frontend::parse(text, "a.csg"), options, settings,
                            Clock::time_point::max(), [](const std::string&, double) {});
  }

  frontend::TemporaryFolder folder_;
  std::optional<frontend::Environment> openscad_;
};

TEST_F(Extrusions, AgreeWithOpenScadsFacets) {
  let_openscad_export(kSides);
  const Result result = judged(kBar);
  ASSERT_EQ(result.checks.size(), 1u);
  EXPECT_EQ(result.checks[0].compared, 500u);
  EXPECT_EQ(result.checks[0].disagreed, 0u);
  EXPECT_LT(result.checks[0].undecided, 5u);
  EXPECT_TRUE(result.notes.empty());
}

TEST_F(Extrusions, OfASnapshotsDesignAreComparedInTheLanguageOfTheRelease) {
  let_openscad_export(kSides);
  const Result result = judged(kBar, {.language = language::LanguageVersion::k2026});
  EXPECT_EQ(result.checks.at(0).disagreed, 0u);
}

TEST_F(Extrusions, OfAnySizeAreCompared) {
  let_openscad_export(kSides);
  const Result result = judged(
      "linear_extrude(height = 1e30, twist = 60, slices = 1) square([4e30, 2e30], center = true);");
  ASSERT_EQ(result.checks.size(), 1u);
  EXPECT_GT(result.checks[0].disagreed, 0u);
  // Nothing is left of it, while openscad has a bar.
  EXPECT_GT(judged("linear_extrude(height = 6, twist = 60) circle(0);").checks.at(0).disagreed, 0u);
}

// The corners are the same, but the surfaces between them bulge in or out.
TEST_F(Extrusions, OfOtherTrianglesDisagreeAndAreNamed) {
  let_openscad_export(kOtherSides);
  const Result result = judged("cube(1);\n  " + std::string(kBar));
  ASSERT_EQ(result.checks.size(), 1u);
  ASSERT_GT(result.checks[0].disagreed, 100u);
  EXPECT_EQ(result.checks[0].disagreements[0]["node"], "a.csg:2:3");
}

TEST_F(Extrusions, AreComparedOnceEachWhereverTheyStand) {
  let_openscad_export(kSides);
  const std::string bar = kBar, shorter = "linear_extrude(height = 5, twist = 60) square([4, 2]);";
  const Result result =
      judged("hull() { #" + bar + shorter + "} difference() { cube(9); " + bar + "} %" + shorter +
             "linear_extrude(height = 3, scale = 2) square(1);");
  ASSERT_EQ(result.checks.size(), 1u);
  EXPECT_EQ(result.checks[0].compared, 1000u);
}

TEST_F(Extrusions, AreNotComparedWithoutAnOpenScadThatKnowsThem) {
  openscad_.emplace("OPENSCAD", folder_ / "none");
  EXPECT_THAT(judged(kBar).notes, ElementsAre(HasSubstr("1 extrusion that turns was not compared "
                                                        "with OpenSCAD's facets: ")));
  EXPECT_THAT(judged(kBar).notes, ElementsAre(HasSubstr("none was not found")));
  let_openscad_export(kSides);
  EXPECT_THAT(judged("linear_extrude(v = [0, 1, 6], twist = 60) square(1);"
                     "linear_extrude(height = 6, twist = 60, segments = 9) square(1);")
                  .notes,
              ElementsAre("2 extrusions that turn were not compared with OpenSCAD's facets: "
                          "OpenSCAD 2021.01 does not know all of them"));
  EXPECT_TRUE(judged("linear_extrude(height = 3) square(1);").notes.empty());
}

}  // namespace
}  // namespace validation
