// Tests the command with designs that scadray evaluates itself. No openscad runs here unless a test
// plays one.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "frontend/command.hpp"
#include "temporary_folder.hpp"

namespace frontend {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

class EvaluatedDesign : public testing::Test {
 protected:
  struct Said {
    ExitCode code;
    std::string out, err;
  };

  Said run(const std::vector<std::string>& arguments) {
    testing::internal::CaptureStdout();
    testing::internal::CaptureStderr();
    const auto renderer = [this](const csgcore::Scene& scene, const csgcore::View& view,
                                 const RenderSettings&, RenderStats&) {
      scene_ = scene;
      view_ = view;
      csgcore::Image image;
      image.width_px = view.width_px;
      image.height_px = view.height_px;
      image.rgb.assign(std::size_t{view.width_px} * view.height_px, {});
      return image;
    };
    Said said{run_command(arguments, renderer), {}, {}};
    said.out = testing::internal::GetCapturedStdout();
    said.err = testing::internal::GetCapturedStderr();
    return said;
  }
  std::string design(const std::string& text) { return folder_.write("a.scad", text); }

  TemporaryFolder folder_;
  csgcore::Scene scene_;
  csgcore::View view_;

 private:
  Environment no_openscad_{"OPENSCAD", "/nonexistent/openscad"};
};

TEST_F(EvaluatedDesign, WritesItsTree) {
  const Said said = run({"-o", folder_ / "x.csg", design("echo(1); cube(2, center = 1);")});
  EXPECT_EQ(said.code, ExitCode::kDone);
  EXPECT_EQ(said.err, "ECHO: 1\n");
  EXPECT_EQ(folder_.read("x.csg"), "cube(size = [2, 2, 2], center = false);\n\n");
}

TEST_F(EvaluatedDesign, WritesItsMessages) {
  const Said said = run({"-o", folder_ / "x.echo", design("echo(a); cube(2);")});
  EXPECT_EQ(said.code, ExitCode::kDone);
  EXPECT_EQ(said.err, "");
  EXPECT_EQ(folder_.read("x.echo"),
            "WARNING: Ignoring unknown variable 'a' in file a.scad, line 1\nECHO: undef\n");
}

TEST_F(EvaluatedDesign, GoesToStandardOutput) {
  EXPECT_EQ(run({"-o", "-", "--export-format=csg", design(";")}).out, "\n");
  EXPECT_EQ(run({"-o", "-", "--export-format", "echo", design("echo(1);")}).out, "ECHO: 1\n");
}

TEST_F(EvaluatedDesign, WithASyntaxErrorHasNoTree) {
  const Said said = run({"-o", folder_ / "x.csg", design("cube(1)")});
  EXPECT_EQ(said.code, ExitCode::kFailure);
  EXPECT_THAT(said.err, StartsWith("ERROR: Parser error: syntax error in file "));
  EXPECT_THAT(said.err,
              HasSubstr("a.scad, line 2\nCan't parse file '" + folder_ / "a.scad" + "'!\n\n"));
  EXPECT_FALSE(folder_.has("x.csg"));
}

TEST_F(EvaluatedDesign, IsEmptyAfterAFailedAssertion) {
  const Said said = run({"-o", folder_ / "x.csg", design("cube(1); assert(false);")});
  EXPECT_EQ(said.code, ExitCode::kDone);
  EXPECT_THAT(said.err, StartsWith("ERROR: Assertion 'false' failed in file a.scad, line 1\n"));
  EXPECT_EQ(folder_.read("x.csg"), "\n");
}

TEST_F(EvaluatedDesign, HasNoPictureAfterAFailedAssertion) {
  const Said said = run({"-o", folder_ / "x.png", design("cube(1);\nassert(false);")});
  EXPECT_EQ(said.code, ExitCode::kFailure);
  EXPECT_THAT(said.err, HasSubstr("a.scad:2: error: Assertion 'false' failed"));
  EXPECT_FALSE(folder_.has("x.png"));
}

TEST_F(EvaluatedDesign, TakesVariablesAndQuietness) {
  const std::string file = design("a = 1; echo(a); cube(a, foo = 1);");
  EXPECT_THAT(run({"-o", folder_ / "x.csg", "-D", "a=3", file}).err, HasSubstr("ECHO: 3\n"));
  EXPECT_THAT(folder_.read("x.csg"), HasSubstr("[3, 3, 3]"));
  EXPECT_EQ(run({"-q", "-o", folder_ / "x.csg", file}).err, "");
  EXPECT_THAT(run({"--hardwarnings", "-o", folder_ / "x.csg", file}).err, HasSubstr("TRACE:"));
  EXPECT_EQ(folder_.read("x.csg"), "\n");
}

TEST_F(EvaluatedDesign, TellsARuleItsFiles) {
  const std::string used = folder_.write("b.scad", "module b() cube(1);");
  const std::string file = design("use <b.scad>\nb();");
  EXPECT_EQ(run({"-o", folder_ / "x.csg", "-d", folder_ / "x.d", file}).code, ExitCode::kDone);
  EXPECT_EQ(folder_.read("x.d"), folder_ / "x.csg" + ": \\\n\t" + used + " \\\n\t" + file + "\n");
}

TEST_F(EvaluatedDesign, IsDrawnWithAllDigits) {
  EXPECT_EQ(run({"-o", folder_ / "x.png", design("translate([1/3, 0, 0]) cube(1);")}).code,
            ExitCode::kDone);
  EXPECT_EQ(scene_.primitives.at(0).local_to_world.translation.x, 1.0 / 3);
}

TEST_F(EvaluatedDesign, SetsTheCameraUnlessTheCommandDoes) {
  const std::string file = design("$vpt = [1, 2, 3]; $vpr = [0, 0, 0]; $vpd = 50; cube(1);");
  run({"-o", folder_ / "x.png", file});
  EXPECT_EQ(view_.eye, csgcore::Vec3(1, 2, 53));
  run({"-o", folder_ / "x.png", "--camera=0,0,0,0,0,0,7", file});
  EXPECT_EQ(view_.eye, csgcore::Vec3(0, 0, 7));
  // As openscad, which says so of a picture that has no --camera.
  constexpr const char* kSaid = "WARNING: Viewall and autocenter disabled in favor of $vp*\n";
  for (const char* output : {"x.png", "x.csg"}) {
    EXPECT_EQ(run({"-o", folder_ / output, file}).err, kSaid);
    EXPECT_EQ(run({"-o", folder_ / output, "--camera=0,0,0,0,0,0,7", file}).err, "");
  }
}

TEST_F(EvaluatedDesign, IsDrawnAfterErrorsThatOpenScadGoesOnAfter) {
  folder_.write("broken.scad", "module m() { cube(1) }");
  const std::string png = folder_ / "x.png";
  const Said said = run({"-o", png, "-p", folder_ / "no.json", "-P", "p",
                         design("use <broken.scad>\necho(1); sphere(1);")});
  EXPECT_EQ(said.code, ExitCode::kDone);
  EXPECT_THAT(said.err, testing::ContainsRegex("^ERROR: Parser error: syntax error in file .*\n"
                                               "ERROR: Cannot open Parameter Set .*\n"
                                               "ECHO: 1\n"));
  EXPECT_EQ(scene_.primitives.at(0).shape, csgcore::Shape::kSphere);
  const Said failed = run({"-o", png, design("include <broken.scad>\nsphere(1);")});
  EXPECT_EQ(failed.code, ExitCode::kFailure);
}

TEST_F(EvaluatedDesign, IsComparedWithOpenScads) {
  const Environment same("OPENSCAD", folder_.script("same",
                                                    "printf '\\\\'\n"  // as its lexer does
                                                    "echo 'ECHO: 1' >&2\n"
                                                    "printf 'group();\\n\\n' >\"$2\"\n"));
  const Said equal = run({"check", design("echo(1); group();")});
  EXPECT_EQ(equal.code, ExitCode::kDone);
  EXPECT_THAT(equal.out, HasSubstr("a.scad: the same\n"));
  const Said different = run({"check", design("echo(1); hull();")});
  EXPECT_EQ(different.code, ExitCode::kDisagreement);
  EXPECT_THAT(different.out, HasSubstr("the trees differ in line 1:\n  scadray:  hull();\n"
                                       "  openscad: group();\n"));
  EXPECT_EQ(run({"check"}).code, ExitCode::kFailure);
  const Environment longer("OPENSCAD", folder_.script("longer",
                                                      "echo 'ECHO: 1' >&2\n"
                                                      "printf 'group();\\n\\n\\n' >\"$2\"\n"));
  EXPECT_THAT(run({"check", design("echo(1); group();")}).out,
              HasSubstr("the trees differ in line 4:\n  scadray:  (the end)\n"
                        "  openscad: (an empty line)\n"));
}

}  // namespace
}  // namespace frontend
