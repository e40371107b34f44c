// Tests `scadray bench` as a program: exit status, tables, JSON.
#include <gmock/gmock.h>
#include <sys/wait.h>

#include <cstdlib>
#include <nlohmann/json.hpp>

#include "temporary_folder.hpp"

namespace bench {
namespace {

using frontend::Environment;
using frontend::TemporaryFolder;
using nlohmann::json;
using testing::AllOf;
using testing::EndsWith;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::MatchesRegex;
using testing::Not;
using testing::StartsWith;

struct Outcome {
  int code;
  std::string out, err;
};

std::string example(const std::string& name) {
  return std::string(SCADRAY_EXAMPLES_DIR) + "/" + name + ".csg";
}

std::vector<std::string> keys_of(const json& object) {
  std::vector<std::string> keys;
  for (const auto& [key, value] : object.items()) keys.push_back(key);
  return keys;  // in alphabetical order
}

class Bench : public testing::Test {
 protected:
  Outcome run(const std::vector<std::string>& arguments,
              const std::string& program = SCADRAY_PROGRAM) {
    std::string command = "'" + program + "' bench";
    for (const std::string& argument : arguments) command += " '" + argument + "'";
    command += " >'" + (folder_ / "out") + "' 2>'" + (folder_ / "err") + "'";
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, folder_.read("out"), folder_.read("err")};
  }

  /// Measures small pictures by the CPU, each once.
  Outcome run_few(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(),
                     {"--renderer=cpu", "--repeat=1", "--time=0", "--imgsize=80,60"});
    return run(arguments);
  }

  TemporaryFolder folder_;
};

TEST_F(Bench, PrintsATable) {
  const Outcome outcome = run_few({example("r9")});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(outcome.err, "");
  EXPECT_THAT(outcome.out, StartsWith(example("r9") + ": 9 primitives, "));
  EXPECT_THAT(outcome.out, HasSubstr(" of 4,800 pixels show it\n  milliseconds "));
  for (const char* text : {"  tiles, cpu\n    first frame  ", "  cells, cpu\n    first frame  ",
                           "\n      of it subdividing  ", "\n    frame, steady  ",
                           "\n  the paper's times, K = 8, no cell dropped: ",
                           "\n  the paper's times, K = 2, cells below 1 pixels dropped: ",
                           "\n    S, subdivide  ", "\n    T_R by the CPU  "}) {
    EXPECT_THAT(outcome.out, HasSubstr(text));
  }
  EXPECT_THAT(outcome.out, Not(HasSubstr("T_S")));
}

TEST_F(Bench, PrintsJson) {
  const Outcome outcome = run_few({"--json", "--threads=2", example("r9"), example("nut_trap")});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  const json all = json::parse(outcome.out);
  EXPECT_THAT(keys_of(all),
              testing::ElementsAre("files", "height_px", "threads", "version", "width_px"));
  EXPECT_EQ(all["threads"], 2);
  EXPECT_EQ(all["width_px"], 80);
  ASSERT_EQ(all["files"].size(), 2u);
  EXPECT_EQ(all["files"][1]["file"], example("nut_trap"));
  const json& r9 = all["files"][0];
  EXPECT_THAT(keys_of(r9), testing::ElementsAre("file", "frames", "hits", "left_out", "pixels",
                                                "primitives", "rules", "wrong"));
  EXPECT_EQ(r9["primitives"], 9);
  EXPECT_EQ(r9["pixels"], 4800);
  ASSERT_EQ(r9["frames"].size(), 2u);
  EXPECT_THAT(keys_of(r9["frames"][0]),
              testing::ElementsAre("first", "renderer", "steady", "technique", "wrong_pixels"));
  EXPECT_THAT(keys_of(r9["frames"][1]),
              testing::ElementsAre("first", "first_subdivide", "renderer", "steady", "technique",
                                   "wrong_pixels"));
  EXPECT_THAT(keys_of(r9["frames"][0]["steady"]),
              testing::ElementsAre("count", "least", "median", "quartiles"));
  ASSERT_EQ(r9["rules"].size(), 2u);
  EXPECT_THAT(keys_of(r9["rules"][0]),
              testing::ElementsAre("S", "cpu", "leaf_primitives", "leaves", "leaves_dropped",
                                   "leaves_given_up", "threshold_px"));
  EXPECT_THAT(keys_of(r9["rules"][0]["cpu"]), testing::ElementsAre("T_R", "wrong_pixels"));
}

TEST_F(Bench, MeasuresOpenGlWhereItCanBeHad) {
  const Outcome outcome =
      run({"--json", "--repeat=1", "--time=0", "--imgsize=80,60", example("r9")});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  const json r9 = json::parse(outcome.out)["files"][0];
  if (!r9["left_out"].empty()) GTEST_SKIP() << r9["left_out"];
  ASSERT_EQ(r9["frames"].size(), 4u);
  EXPECT_EQ(r9["frames"][2]["technique"], "tiles");
  EXPECT_EQ(r9["frames"][3]["technique"], "cells");
  const json& frame = r9["frames"].back();
  EXPECT_THAT(std::string(frame["renderer"]), StartsWith("gl: "));
  EXPECT_THAT(keys_of(frame), testing::IsSupersetOf({"context", "first_shaders"}));
  for (const json& rule : r9["rules"]) {
    EXPECT_THAT(keys_of(rule["gl"]), testing::ElementsAre("S_R", "T_R", "T_S", "cells_drawn",
                                                          "draw_calls", "wrong_pixels"));
  }
}

TEST_F(Bench, WithoutOpenGlTheCpuIsMeasured) {
  const Environment environment("__EGL_VENDOR_LIBRARY_FILENAMES", folder_ / "none.json");
  const std::vector<std::string> few{"--repeat=1", "--time=0", "--imgsize=80,60", example("r9")};
  const Outcome outcome = run(few);
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("tiles, cpu"), HasSubstr("\n  left out: OpenGL: "),
                                 Not(HasSubstr("gl: "))));
  std::vector<std::string> gl = few;
  gl.insert(gl.begin(), "--renderer=gl");
  const Outcome failed = run(gl);
  EXPECT_EQ(failed.code, 1);
  EXPECT_EQ(failed.out, "");
  EXPECT_THAT(failed.err, StartsWith("error: "));
}

TEST_F(Bench, RepeatsAsOftenAsItIsTold) {
  const auto count = [&](const char* repeat, const char* time) {
    const Outcome outcome =
        run({"--json", "--renderer=cpu", "--imgsize=80,60", repeat, time, example("r9")});
    return json::parse(outcome.out)["files"][0]["frames"][0]["steady"]["count"].get<int>();
  };
  EXPECT_EQ(count("--repeat=3", "--time=0"), 3);
  EXPECT_GT(count("--repeat=3", "--time=0.2"), 10);
}

TEST_F(Bench, MeasuresTheRuleThatIsAskedFor) {
  const auto rules = [&](std::vector<std::string> options) {
    options.insert(options.end(), {"--json", example("cs100")});
    return json::parse(run_few(options).out)["files"][0]["rules"];
  };
  const json four = rules({"--leaf-primitives=4"});
  ASSERT_EQ(four.size(), 1u);
  EXPECT_EQ(four[0]["leaf_primitives"], 4);
  EXPECT_EQ(four[0]["threshold_px"], 0);
  EXPECT_EQ(four[0]["leaves_dropped"], 0);
  EXPECT_EQ(four[0]["leaves_given_up"], 0);
  const json coarse = rules({"--leaf-primitives=2", "--threshold=4"});
  EXPECT_EQ(coarse[0]["threshold_px"], 4);
  EXPECT_GT(coarse[0]["leaves_dropped"], 0);
  EXPECT_GT(coarse[0]["cpu"]["wrong_pixels"], 0);
}

TEST_F(Bench, TakesACamera) {
  const auto hits = [&](const char* camera) {
    const Outcome outcome = run_few({"--json", camera, example("r9")});
    return json::parse(outcome.out)["files"][0]["hits"].get<int>();
  };
  EXPECT_GT(hits("--camera=0,0,0,55,0,25,100"), 2 * hits("--camera=0,0,0,55,0,25,400"));
}

TEST_F(Bench, AnEmptyDesign) {
  const Outcome outcome = run_few({folder_.write("empty.csg", "\n"), example("r9")});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("the design is empty: nothing to measure\n"));
  EXPECT_THAT(outcome.out, HasSubstr("9 primitives"));
}

TEST_F(Bench, AWrongPictureIsAFailure) {
  const std::string file =
      folder_.write("thin.csg", "cylinder(h = 4e-06, r1 = 10, r2 = 10, $fn = 0);");
  const Outcome outcome = run({"--repeat=1", "--time=0", "--imgsize=80,60", file});
  if (outcome.out.find("left out: OpenGL") != std::string::npos) GTEST_SKIP() << "no OpenGL";
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, AllOf(StartsWith(file + ": error: gl, "),
                                 HasSubstr(": not measured (OpenGL computes in float")));
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("tiles, cpu"), Not(HasSubstr("gl: "))));
}

// A file that cannot be read is found before the first one is measured.
TEST_F(Bench, Failures) {
  const auto expect_failure = [&](const std::vector<std::string>& arguments,
                                  const std::string& text) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.code, 1) << text;
    EXPECT_EQ(outcome.out, "") << text;
    EXPECT_THAT(outcome.err, HasSubstr(text));
    EXPECT_THAT(outcome.err, HasSubstr("error: ")) << text;
  };
  const std::string r9 = example("r9");
  expect_failure({}, "no file to measure (give .csg or .scad files, or -)");
  expect_failure({"-", "-"}, "standard input is given twice");
  expect_failure({r9, "missing.csg"}, "missing.csg: error: cannot be read");
  expect_failure({r9, folder_.write("bad.csg", "group() {\n  sphere(r = \n")}, "bad.csg:3:");
  expect_failure({"--no-such", r9}, "no-such");
  expect_failure({"--imgsize=80", r9}, "--imgsize=80 is not understood");
  expect_failure({"--camera=1,2,x", r9}, "--camera=1,2,x");
  expect_failure({"--camera=0,0,0,0,0,0,-5", r9}, "nothing is seen (give --camera a positive");
  expect_failure({"--projection=flat", r9}, "--projection=flat");
  expect_failure({"--renderer=ink", r9}, "give auto, gl or cpu");
  expect_failure({"--leaf-primitives=0", r9}, "--leaf-primitives=0");
  expect_failure({"--threshold=-1", r9}, "--threshold=-1");
  expect_failure({"--threads=0", r9}, "--threads=0");
  expect_failure({"--repeat=0", r9}, "--repeat=0 is not understood (give a number from 1 to ");
  expect_failure({"--time=nan", r9}, "--time=nan");
}

TEST_F(Bench, WhatCannotBeDrawnIsLeftOut) {
  const std::string flat = folder_.write("flat.csg", "cube(1e308);");
  for (const char* option : {"--skip-unsupported", "--threads=1"}) {
    const Outcome outcome = run_few({option, flat});
    EXPECT_EQ(outcome.code, 0);
    EXPECT_THAT(outcome.err, HasSubstr("flat.csg:1:1: warning: cube is left out"));
  }
}

TEST_F(Bench, EvaluatesAScadAndShowsItsWarningsUnlessQuiet) {
  const Environment environment(
      "OPENSCAD", folder_.script("openscad", "echo 'WARNING: so' >&2; echo 'sphere(r = 1);'"));
  const std::string file = folder_.write("a.scad", "sphere(nope);");
  const Outcome outcome = run_few({"--evaluator=openscad", "-D", "a=1", file});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("WARNING: so"));
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("1 primitive"), Not(HasSubstr("1 primitives"))));
  EXPECT_THAT(run_few({file}).err, HasSubstr("'nope'"));
  EXPECT_EQ(run_few({"-q", file}).err, "");
}

TEST_F(Bench, HelpAndVersion) {
  const Outcome help = run({"--help"});
  EXPECT_EQ(help.code, 0);
  for (const char* option : {"--imgsize", "--camera", "--renderer", "--leaf-primitives",
                             "--threshold", "--repeat", "--time", "--json", "--threads"}) {
    EXPECT_THAT(help.out, HasSubstr(option));
  }
  EXPECT_THAT(run({"-v"}).out, MatchesRegex("scadray-bench version [0-9.]+\n"));
}

TEST_F(Bench, WithoutTheProgramTheErrorSaysSo) {
  const std::string alone = folder_ / "scadray";
  std::filesystem::copy_file(SCADRAY_PROGRAM, alone);
  const Outcome outcome = run({example("r9")}, alone);
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("error: this scadray has no `bench`: "));
}

}  // namespace
}  // namespace bench
