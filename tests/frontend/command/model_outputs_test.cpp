// Tests what the command writes of solids and plane figures. No openscad runs here.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "frontend/command.hpp"
#include "temporary_folder.hpp"

namespace frontend {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

class ModelOutputs : public testing::Test {
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
      drawn_primitives_ = scene.primitives.size();
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
  size_t drawn_primitives_ = 0;

 private:
  Environment no_openscad_{"OPENSCAD", "/nonexistent/openscad"};
};

TEST_F(ModelOutputs, SeveralAtOnce) {
  const Said said = run({"-o", folder_ / "a.stl", "-o", folder_ / "a.off", "-o", folder_ / "a.obj",
                         "-o", folder_ / "a.3mf", "-o", folder_ / "a.AMF", design("cube(2);")});
  EXPECT_EQ(said.code, ExitCode::kDone);
  EXPECT_EQ(said.err, "");
  EXPECT_THAT(folder_.read("a.stl"), StartsWith("OpenSCAD Model\n"));
  EXPECT_THAT(folder_.read("a.off"), StartsWith("OFF 8 12 0\n"));
  EXPECT_THAT(folder_.read("a.obj"), StartsWith("o OpenSCAD_Model\n"));
  EXPECT_THAT(folder_.read("a.3mf"), StartsWith("PK"));
  EXPECT_THAT(folder_.read("a.AMF"), HasSubstr("<amf"));
}

TEST_F(ModelOutputs, PlaneFigures) {
  const Said said = run({"-o", folder_ / "a.svg", "-o", folder_ / "a.dxf", "-o", folder_ / "a.pdf",
                         design("difference() { square(4); square(1); }")});
  EXPECT_EQ(said.code, ExitCode::kDone);
  EXPECT_THAT(folder_.read("a.svg"), HasSubstr("viewBox=\"0 -4 4 4\""));
  EXPECT_THAT(folder_.read("a.dxf"), HasSubstr("LINE"));
  EXPECT_THAT(folder_.read("a.pdf"), StartsWith("%PDF"));
}

TEST_F(ModelOutputs, TheFormatStandsAboveTheSuffix) {
  const std::string file = design("cube(2);");
  EXPECT_THAT(run({"-o", "-", "--export-format=asciistl", file}).out,
              StartsWith("solid OpenSCAD_Model\n"));
  EXPECT_THAT(run({"-o", "-", "--export-format=binstl", file}).out, StartsWith("OpenSCAD Model\n"));
  EXPECT_EQ(run({"-o", folder_ / "x.png", "--export-format=OFF", file}).code, ExitCode::kDone);
  EXPECT_THAT(folder_.read("x.png"), StartsWith("OFF "));
}

TEST_F(ModelOutputs, ADesignThatTheFormatCannotHoldLeavesNoFile) {
  folder_.write("old.stl", "old");
  const auto expect_failure = [&](const char* text, const char* name, const char* message) {
    const Said said = run({"-o", folder_ / "other.off", "-o", folder_ / name, design(text)});
    EXPECT_EQ(said.code, ExitCode::kFailure);
    EXPECT_THAT(said.err, HasSubstr(message));
    EXPECT_THAT(folder_.names(), ElementsAre("a.scad", "old.stl"));
    EXPECT_EQ(folder_.read("old.stl"), "old");
  };
  expect_failure("", "old.stl", "a.scad: error: Current top level object is empty.\n");
  expect_failure("square(1);", "old.stl", "Current top level object is not a 3D object.");
  expect_failure("cube(1);", "a.svg", "Current top level object is not a 2D object.");
  expect_failure("%cube(1);", "old.stl", "Current top level object is empty.");
  expect_failure("cube(1", "old.stl", "syntax error");
  expect_failure("assert(false) cube(1);", "old.stl", "Assertion 'false' failed");
}

TEST_F(ModelOutputs, TheFirstPartTellsTheDimension) {
  const Said said = run({"-o", folder_ / "a.off", design("cube(1); square(1);")});
  EXPECT_EQ(said.code, ExitCode::kDone);
  EXPECT_THAT(said.err, HasSubstr("a.scad:1:10: warning: square: Ignoring 2D child object"));
  EXPECT_EQ(run({"-q", "-o", folder_ / "a.off", design("cube(1); square(1);")}).err, "");
  EXPECT_EQ(run({"--hardwarnings", "-o", folder_ / "b.off", design("cube(1); square(1);")}).code,
            ExitCode::kFailure);
  EXPECT_FALSE(folder_.has("b.off"));
}

TEST_F(ModelOutputs, WhatIsLeftOutIsSaidOnce) {
  const Said said = run({"-o", folder_ / "a.off", "-o", folder_ / "a.stl",
                         design("cube(1);\npolyhedron([[0,0,0],[1,0,0],[0,1,0]], [[0,1,2]]);")});
  EXPECT_EQ(said.code, ExitCode::kDone);
  const std::string left_out = "a.scad:2:1: warning: polyhedron is left out of the file";
  EXPECT_THAT(said.err, HasSubstr(left_out));
  EXPECT_EQ(said.err.find(left_out), said.err.rfind(left_out));
}

TEST_F(ModelOutputs, ItIsAFinalRender) {
  const Said said = run({"--echo", "-o", folder_ / "a.off",
                         design("echo($preview); if (!$preview) cube(1); #cube(2); %cube(3);")});
  EXPECT_EQ(said.code, ExitCode::kDone);
  EXPECT_EQ(said.out, "ECHO: false\n");
  EXPECT_THAT(folder_.read("a.off"), HasSubstr("2 2 2"));
}

TEST_F(ModelOutputs, StandBesideTextsAndPictures) {
  const Said said = run({"-o", folder_ / "a.png", "-o", folder_ / "a.csg", "-o", folder_ / "a.stl",
                         "-d", folder_ / "a.d", "--imgsize=4,4", design("cube(1); %cube(2);")});
  EXPECT_EQ(said.code, ExitCode::kDone);
  EXPECT_THAT(folder_.names(), ElementsAre("a.csg", "a.d", "a.png", "a.scad", "a.stl"));
  EXPECT_EQ(drawn_primitives_, 2u) << "the picture is a preview";
  EXPECT_THAT(folder_.read("a.d"), HasSubstr("a.stl"));
}

TEST_F(ModelOutputs, TheRuleOfAModelAlone) {
  folder_.write("b.scad", "cube(1);");
  const Said said = run({"-o", folder_ / "a.stl", "-d", folder_ / "a.d",
                         design("use <b.scad>\n"
                                "cube(2);")});
  EXPECT_EQ(said.code, ExitCode::kDone);
  EXPECT_THAT(folder_.read("a.d"), testing::AllOf(HasSubstr("a.stl"), HasSubstr("b.scad")));
}

TEST_F(ModelOutputs, NoOutputIsAFileOfTheDesign) {
  const std::string file = design("import(\"b.off\");");
  folder_.write("b.off",
                "OFF 4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n"
                "3 1 2 3\n");
  const std::string before = folder_.read("b.off");
  EXPECT_EQ(run({"-o", folder_ / "b.off", file}).code, ExitCode::kFailure);
  EXPECT_EQ(folder_.read("b.off"), before);
}

TEST_F(ModelOutputs, FramesOfAnAnimation) {
  EXPECT_EQ(run({"-o", folder_ / "a.off", "--animate=2", design("cube(1 + $t);")}).code,
            ExitCode::kDone);
  EXPECT_THAT(folder_.names(), ElementsAre("a.scad", "a00000.off", "a00001.off"));
  EXPECT_THAT(folder_.read("a00001.off"), HasSubstr("1.5 1.5 1.5"));
}

}  // namespace
}  // namespace frontend
