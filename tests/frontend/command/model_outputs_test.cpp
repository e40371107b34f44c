// Tests what the command writes of solids and plane figures. No openscad runs here.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "frontend/command.hpp"
#include "meshes/zip_archive.hpp"
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

TEST_F(ModelOutputs, AmfIsDeprecatedOnceBy2026) {
  const std::string scad = design("cube(2);");
  const auto said = [&](const std::string& option) {
    return run({option, "-o", folder_ / "a.amf", "-o", folder_ / "b.amf", scad});
  };
  const Environment language("SCADRAY_LANGUAGE", "2026");
  EXPECT_EQ(said("--hardwarnings").err,
            "DEPRECATED: AMF export is deprecated. Please use 3MF instead.\n");
  EXPECT_EQ(said("-q").err, "");
  EXPECT_EQ(said("--language=2021.01").err, "");
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

TEST_F(ModelOutputs, TheSummaryIsOpenScads) {
  // Run by OpenSCAD 2025.07 with Manifold, but for the area of a solid, which that does not tell.
  const std::string camera =
      "Camera:\n   Translation: 1.00, 2.00, 3.00\n   Rotation:    55.00, 0.00, 25.00\n"
      "   Distance:    50.00\n   FOV:         22.50\n";
  const auto told = [&](const std::string& output, const std::string& text) {
    return run({"-o", folder_ / output, "--summary=geometry", "--summary=bounding-box",
                "--summary=area", "--summary=camera", "--camera=1,2,3,55,0,25,50", design(text)})
        .err;
  };
  EXPECT_EQ(told("a.stl", "cube(1); translate([3, 0, 0]) cube(1);"),
            "   Top level object is a 3D object (manifold):\n   Status:     NoError\n"
            "   Genus:      -1\n   Vertices:       16\n   Facets:           24\n"
            "Bounding box:\n   Min:  0.00, 0.00, 0.00\n   Max:  4.00, 1.00, 1.00\n"
            "   Size: 4.00, 1.00, 1.00\nMeasurements:\n   Area: 12.00\n" +
                camera);
  EXPECT_EQ(told("a.svg", "difference() { square(10); translate([3, 3]) square(2); }"),
            "Top level object is a 2D object:\n   Contours:        2\n"
            "Bounding box:\n   Min:  0.00, 0.00\n   Max:  10.00, 10.00\n"
            "   Size: 10.00, 10.00\nMeasurements:\n   Area: 96.00\n" +
                camera);
  EXPECT_THAT(told("a.stl", "rotate_extrude($fn = 8) translate([5, 0]) circle(1, $fn = 6);"),
              HasSubstr("Genus:      1\n   Vertices:       48\n   Facets:           96\n"));
  EXPECT_THAT(
      told("a.off", "polyhedron([[0,0,0],[3,0,0],[0,4,0],[0,0,5]], [[0,1,2],[0,3,1],[0,2,3]]);"),
      HasSubstr("   Status:     NotManifold\n   Vertices:        4\n"));
}

TEST_F(ModelOutputs, TheSummaryOfTimeAndCaches) {
  const std::string file = design("$vpd = 7; echo(1); cube(1);");
  EXPECT_THAT(
      run({"-o", folder_ / "a.stl", "--summary=time", "--summary=cache", file}).err,
      testing::ContainsRegex("\nGeometries in cache: 0\nGeometry cache size in bytes: "
                             "0\nCGAL Polyhedrons in cache: 0\nCGAL cache size in bytes: 0\n"
                             "Total rendering time: 0:00:0[0-9][.][0-9][0-9][0-9]\n"));
  EXPECT_THAT(run({"-o", folder_ / "a.stl", "--summary=camera", file}).err,
              HasSubstr("   Distance:    7.00\n"));
  EXPECT_EQ(run({"-q", "-o", folder_ / "a.stl", "--summary=all", file}).err, "");
  EXPECT_EQ(run({"-o", folder_ / "a.csg", "--summary=all", file}).err,
            run({"-o", folder_ / "a.csg", file}).err)
      << "a text has none, as in OpenSCAD";
}

TEST_F(ModelOutputs, TheSummaryAsJson) {
  const auto told = [&](std::vector<std::string> words, const std::string& text) {
    words.insert(words.end(), {"--summary-file=-", design(text)});
    const Said said = run(words);
    EXPECT_EQ(said.err, "");
    return said.out;
  };
  EXPECT_EQ(told({"-o", folder_ / "a.stl", "--summary=geometry"}, "cube(1);"),
            R"({"geometry":{"dimensions":3,"facets":12,"simple":true,"vertices":8}})"
            "\n");
  EXPECT_EQ(
      told({"-o", folder_ / "a.svg", "--summary=geometry", "--summary=bounding-box"}, "square(2);"),
      R"({"geometry":{"bounding_box":{"max":[2.0,2.0],"min":[0.0,0.0],"size":[2.0,2.0]},)"
      R"("contours":1,"convex":true,"dimensions":2}})"
      "\n");
  EXPECT_EQ(told({"-o", folder_ / "a.svg", "--summary=area"},
                 "difference() { square(2); translate([1, 1]) square(1); }"),
            R"({"geometry":{"area":3.0}})"
            "\n");
  EXPECT_THAT(told({"-o", folder_ / "a.svg", "--summary=geometry"},
                   "difference() { square(2); translate([1, 1]) square(1); }"),
              HasSubstr("\"convex\":false"));
  EXPECT_THAT(told({"-o", folder_ / "a.stl", "--summary=time"}, "cube(1);"),
              StartsWith(R"({"time":{"hours":0,"milliseconds":)"));
  EXPECT_EQ(told({"-o", folder_ / "a.stl"}, "cube(1);"), "null\n");
  run({"-o", folder_ / "a.stl", "--summary=all", "--summary-file=" + folder_ / "s",
       design("cube(1);")});
  EXPECT_THAT(folder_.read("s"), StartsWith("{\"cache\":{\"cgal_cache\":{\"bytes\":0,"));
}

TEST_F(ModelOutputs, TheSummaryOfAPictureIsThatOfItsSolid) {
  const Said said = run({"-o", folder_ / "a.png", "--imgsize=4,4", "--summary=bounding-box",
                         design("echo(1); intersection() { cube(4); sphere(2, $fn = 4); }")});
  EXPECT_EQ(said.code, ExitCode::kDone);
  EXPECT_THAT(said.err, HasSubstr("   Max:  1.41, 1.41, 1.41\n"));
  EXPECT_EQ(said.err.find("ECHO"), said.err.rfind("ECHO")) << "said once";
  EXPECT_TRUE(folder_.has("a.png"));
  EXPECT_EQ(run({"-o", folder_ / "a.png", "--summary=bounding-box", design("")}).code,
            ExitCode::kDone);
}

TEST_F(ModelOutputs, SettingsOfO) {
  const std::string file = design("color(\"red\") cube(1); translate([2, 0, 0]) cube(1);");
  const auto materials = [&](const std::string& mode) {
    run({"-o", folder_ / "a.3mf", "-O", "export-3mf/color-mode=" + mode, "-O",
         "export-3mf/color=#00ff00", file});
    const std::string model =
        ZipArchive(folder_.read("a.3mf")).unpack("3D/3dmodel.model").value_or("");
    const std::size_t at = model.find("displaycolor=");
    return at == std::string::npos ? "" : model.substr(at + 14, 9);
  };
  EXPECT_EQ(materials("model"), "#FF0000FF");
  EXPECT_EQ(materials("selected-only"), "#00FF00FF");
  EXPECT_EQ(materials("none"), "");
  EXPECT_THAT(run({"-o", folder_ / "a.stl", "-O", "export-3mf/x=1", file}).err,
              HasSubstr("warning: -O export-3mf/x=1 is not known and ignored"));
}

TEST_F(ModelOutputs, AShardOfAnAnimation) {
  const std::string file = design("cube(1 + $t);");
  EXPECT_EQ(run({"-o", folder_ / "a.off", "-o", folder_ / "a.csg", "-o", folder_ / "a.png",
                 "--imgsize=4,4", "--animate=4", "--animate_sharding=3/3", file})
                .code,
            ExitCode::kDone);
  EXPECT_THAT(folder_.names(), ElementsAre("a.scad", "a00002.csg", "a00002.off", "a00002.png",
                                           "a00003.csg", "a00003.off", "a00003.png"));
  EXPECT_THAT(folder_.read("a00003.off"), HasSubstr("1.75 1.75 1.75"));
  EXPECT_EQ(run({"-o", folder_ / "b.png", "--animate=4", "--animate_sharding=1/5", file}).code,
            ExitCode::kDone);
  EXPECT_FALSE(folder_.has("b00000.png"));
}

TEST_F(ModelOutputs, FramesOfAnAnimation) {
  EXPECT_EQ(run({"-o", folder_ / "a.off", "--animate=2", design("cube(1 + $t);")}).code,
            ExitCode::kDone);
  EXPECT_THAT(folder_.names(), ElementsAre("a.scad", "a00000.off", "a00001.off"));
  EXPECT_THAT(folder_.read("a00001.off"), HasSubstr("1.5 1.5 1.5"));
}

}  // namespace
}  // namespace frontend
