// Tests `scadray validate` as a program: exit status, table, report, interruption.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <poll.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <nlohmann/json.hpp>
#include <thread>

#include "temporary_folder.hpp"

namespace validation {
namespace {

using frontend::Environment;
using frontend::TemporaryFolder;
using nlohmann::json;
using testing::AllOf;
using testing::EndsWith;
using testing::Ge;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::MatchesRegex;
using testing::Not;
using testing::StartsWith;
using Clock = std::chrono::steady_clock;

constexpr const char* kPlanted = "SCADRAY_VALIDATE_PLANTED_ERROR";

struct Outcome {
  int code;
  std::string out, err;
};

std::string example(const std::string& name) {
  return std::string(SCADRAY_EXAMPLES_DIR) + "/" + name + ".csg";
}

class Validate : public testing::Test {
 protected:
  /// Starts `scadray validate` with files as standard output and error.
  pid_t start(std::vector<std::string> arguments, const std::string& program = SCADRAY_PROGRAM) {
    arguments.insert(arguments.begin(), {program, "validate"});
    // The files are opened before it may be interrupted.
    const int out = open((folder_ / "out").c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
    const int err = open((folder_ / "err").c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
    const pid_t child = fork();
    if (child != 0) {
      close(out);
      close(err);
      return child;
    }
    signal(SIGINT, SIG_DFL);  // a shell's background jobs are started with it ignored
    dup2(out, STDOUT_FILENO);
    dup2(err, STDERR_FILENO);
    std::vector<char*> words;
    for (std::string& argument : arguments) words.push_back(argument.data());
    words.push_back(nullptr);
    execv(program.c_str(), words.data());
    _exit(127);
  }

  Outcome finish(pid_t child) {
    int status = 0;
    waitpid(child, &status, 0);
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status), folder_.read("out"),
            folder_.read("err")};
  }

  Outcome run(const std::vector<std::string>& arguments) { return finish(start(arguments)); }

  /// Runs with samples that take a moment.
  Outcome run_few(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"--renderer=cpu", "--points=500", "--rays=500",
                                         "--views=1", "--time-limit=1000"});
    return run(arguments);
  }

  json report() { return json::parse(folder_.read("report.json")); }

  TemporaryFolder folder_;
  std::string report_ = "--report=" + folder_ / "report.json";
};

/// Checks the table's row, whose numbers must be consistent.
void expect_row(const std::string& table, const std::string& name, uint64_t compared) {
  const std::size_t at = table.find("\n  " + name + "  ");
  ASSERT_NE(at, std::string::npos) << name << " in\n" << table;
  std::string numbers = table.substr(at + name.size() + 3, table.find('\n', at + 1) - at);
  std::erase(numbers, ',');
  unsigned long long counts[4];
  ASSERT_EQ(std::sscanf(numbers.c_str(), "%llu %llu %llu %llu", counts, counts + 1, counts + 2,
                        counts + 3),
            4)
      << numbers;
  EXPECT_EQ(counts[0], compared) << name;
  EXPECT_EQ(counts[1] + counts[2], compared) << name;
  EXPECT_EQ(counts[3], 0u) << name;
}

void expect_whole_table(const Outcome& outcome) {
  EXPECT_EQ(outcome.err, "");
  EXPECT_EQ(outcome.code, 0);
  constexpr uint64_t kPixels = 160 * 120;
  const std::size_t facets_at = outcome.out.find("in facets, against CGAL");
  ASSERT_NE(facets_at, std::string::npos) << outcome.out;
  const std::string smooth = outcome.out.substr(0, facets_at);
  const std::string facets = outcome.out.substr(facets_at);
  EXPECT_THAT(smooth, HasSubstr("compared     agreed  undecided  disagreed  worst error\n"));
  expect_row(smooth, "rays", 500);
  expect_row(smooth, "pictures", kPixels);
  expect_row(facets, "volume", 1);
  expect_row(facets, "points near surfaces", 500);
  expect_row(facets, "points near edges", 500);
  expect_row(facets, "rays", 500);
  expect_row(facets, "pictures", kPixels);
  expect_row(facets.substr(facets.find("sagitta")), "points", 1500);
  EXPECT_THAT(outcome.out, EndsWith("\nagrees\n"));
}

TEST_F(Validate, ItsReportDoesNotOverwriteTheDesign) {
  const std::string design = folder_.write("a.csg", "sphere(r = 1);\n");
  const Outcome outcome = run({"--report=" + design, design});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, testing::HasSubstr("--report would overwrite the design"));
  EXPECT_EQ(folder_.read("a.csg"), "sphere(r = 1);\n");
}

TEST_F(Validate, AgreesOnR9) { expect_whole_table(run_few({example("r9")})); }

TEST_F(Validate, AgreesOnCs100) { expect_whole_table(run_few({"--fn=4", example("cs100")})); }

TEST_F(Validate, AFlippedSignIsFoundAndNamed) {
  const Environment planted(kPlanted, "flip:5");
  const Outcome outcome = run_few({report_, example("r9")});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.out, EndsWith("\nDISAGREES\n"));
  EXPECT_THAT(outcome.out, HasSubstr("disagreements name: 5 ("));
  const json found = report();
  EXPECT_EQ(found["agrees"], false);
  for (const json& check : found["checks"]) {
    EXPECT_GT(check["disagreed"], 0) << check["group"] << check["name"];
    EXPECT_EQ(check["disagreed"], check["disagreements"].size());
  }
  const json ray = found["checks"][0]["disagreements"][0];
  EXPECT_EQ(ray["ray"]["origin"].size(), 3u) << ray;
  EXPECT_TRUE(ray["seen"].contains("hit") && ray["expected"].contains("hit")) << ray;
  const json pixel = found["checks"][1]["disagreements"][0];
  EXPECT_EQ(pixel["view"], 0) << pixel;
  EXPECT_EQ(pixel["pixel"].size(), 2u) << pixel;
}

// The move is 6e-9 of the design's size, which only rays see.
TEST_F(Validate, APrimitiveThatIsMovedEverSoLittleIsFoundAndNamed) {
  const Environment planted(kPlanted, "move:3:1e-6");
  const Outcome outcome = run_few({example("r9")});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.out, HasSubstr("disagreements name: 3 ("));
  EXPECT_THAT(outcome.out, HasSubstr("first disagreement, rays (in facets"));
}

// An empty node has an id, but is not a primitive of the scene.
TEST_F(Validate, PrimitivesAreNamedByTheirIds) {
  const Environment planted(kPlanted, "move:2:0.1");
  const Outcome outcome = run_few({folder_.write("a.csg",
                                                 "sphere(r = 0, $fn = 0); sphere(r = 1, $fn = 0);"
                                                 "cylinder(h = 3, r1 = 0.5, r2 = 0.5, $fn = 0);")});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.out, HasSubstr("disagreements name: 2 ("));
}

TEST_F(Validate, AnErrorThatCannotBePlantedIsRefused) {
  for (const char* error : {"flip:9", "turn:1", "move:1"}) {
    const Environment planted(kPlanted, error);
    const Outcome outcome = run_few({example("r9")});
    EXPECT_EQ(outcome.code, 1) << error;
    EXPECT_THAT(outcome.err, HasSubstr("give flip:K or move:K:DISTANCE")) << error;
  }
}

TEST_F(Validate, WithoutTimeForCgalByExactRaysAlone) {
  for (const char* limit : {"0", "0.05"}) {
    const Outcome outcome =
        run({"--renderer=cpu", std::string("--time-limit=") + limit, report_, example("cs100")});
    EXPECT_EQ(outcome.code, 0) << outcome.out;
    EXPECT_THAT(outcome.out,
                HasSubstr(std::string("too large for CGAL Nef polyhedra within --time-limit=") +
                          limit + " s: compared with rays in exact arithmetic only\n"));
    EXPECT_THAT(outcome.out, Not(HasSubstr("in facets")));
    const json found = report();
    ASSERT_EQ(found["checks"].size(), 2u);
    for (const json& check : found["checks"]) EXPECT_THAT(int(check["compared"]), Ge(1024));
  }
  // These first samples alone find an error, too.
  const Environment planted(kPlanted, "flip:7");
  EXPECT_EQ(run({"--renderer=cpu", "--time-limit=0", example("cs100")}).code, 2);
}

TEST_F(Validate, CgalIsNotBegunWithThousandsOfPrimitives) {
  std::string csg;
  for (int i = 0; i < 20000; ++i) {
    csg += "multmatrix([[1,0,0," + std::to_string(i % 100) + "],[0,1,0," + std::to_string(i / 100) +
           "],[0,0,1,0],[0,0,0,1]]) sphere(r = 0.4, $fn = 0);\n";
  }
  const Clock::time_point start = Clock::now();
  const Outcome outcome =
      run({"--renderer=cpu", "--rays=10", "--views=0", folder_.write("a.csg", csg)});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_THAT(outcome.out, HasSubstr("too large for CGAL"));
  EXPECT_LT(Clock::now() - start, std::chrono::seconds(20));  // of the limit's 40
}

TEST_F(Validate, SaysThatNotAllWasCompared) {
  const std::string few = "not all was compared";
  EXPECT_THAT(run({"--time-limit=0", example("r9")}).out, HasSubstr(few));
  EXPECT_THAT(run_few({example("r9")}).out, Not(HasSubstr(few)));
}

TEST_F(Validate, TheSameWhateverTheThreads) {
  // The error makes results that may differ.
  const Environment planted(kPlanted, "flip:5");
  const auto report_of = [&](const char* seed, const char* threads) {
    run_few({report_, seed, threads, example("r9")});
    return folder_.read("report.json");
  };
  const std::string one = report_of("--seed=7", "--threads=1");
  EXPECT_GT(one.size(), 10000u);
  EXPECT_TRUE(one == report_of("--seed=7", "--threads=4"));  // too long to be printed
  EXPECT_TRUE(one != report_of("--seed=8", "--threads=4"));
}

TEST_F(Validate, AnEmptyDesign) {
  const Outcome outcome = run({folder_.write("empty.csg", "\n")});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_THAT(outcome.out, HasSubstr("the design is empty"));
}

TEST_F(Validate, ASolidThatTheOperationsLeaveNothingOf) {
  const Outcome outcome = run_few({folder_.write(
      "nothing.csg", "difference() { sphere(r = 1, $fn = 0); sphere(r = 2, $fn = 0); }")});
  EXPECT_EQ(outcome.code, 0) << outcome.out;
  EXPECT_THAT(outcome.out, HasSubstr("in facets"));
}

// Sizes beyond what floats, and products of three doubles, can represent.
TEST_F(Validate, VeryLargeAndVerySmallDesigns) {
  for (const char* size : {"1e-85", "1e85"}) {
    const std::string csg = std::string("multmatrix([[") + size + ",0,0,0],[0," + size +
                            ",0,0],[0,0," + size +
                            ",0],[0,0,0,1]]) difference() { sphere(r = 2, $fn = 0); cylinder(h = "
                            "9, r1 = 1, r2 = 0.5, center = true, $fn = 0); }";
    const Outcome outcome = run_few({folder_.write("scaled.csg", csg)});
    EXPECT_EQ(outcome.code, 0) << size << outcome.out << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr("in facets")) << size;
    EXPECT_THAT(outcome.out, HasSubstr("the design was scaled by 2^")) << size;
  }
}

TEST_F(Validate, Failures) {
  const auto expect_failure = [&](const std::vector<std::string>& arguments,
                                  const std::string& text) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.code, 1) << text;
    EXPECT_EQ(outcome.out, "") << text;
    EXPECT_THAT(outcome.err, HasSubstr(text));
    EXPECT_THAT(outcome.err, HasSubstr("error: ")) << text;
  };
  const std::string r9 = example("r9");
  expect_failure({}, "no file to validate");
  expect_failure({r9, r9}, "more than one file");
  expect_failure({"missing.csg"}, "missing.csg: error: cannot be read");
  expect_failure({folder_.write("bad.csg", "sphere(r = ")}, "bad.csg:1:");
  expect_failure({"--fn=2", r9}, "--fn=2 is not understood (give a number from 3 to 200)");
  expect_failure({"--fn=8.5", r9}, "--fn=8.5");
  expect_failure({"--points=0", r9}, "--points=0");
  expect_failure({"--rays=-1", r9}, "--rays=-1");
  expect_failure({"--views=101", r9}, "--views=101");
  expect_failure({"--seed=x", r9}, "--seed=x");
  expect_failure({"--time-limit=nan", r9}, "--time-limit=nan");
  expect_failure({"--renderer=ink", r9}, "--renderer=ink");
  expect_failure({"--no-such", r9}, "no-such");
  expect_failure({"--report=" + folder_ / "no/such/folder", r9}, "cannot be written");
}

TEST_F(Validate, WhatCannotBeDrawnIsLeftOut) {
  const std::string flat = folder_.write("flat.csg", "cube(1e308);");
  for (const char* option : {"--skip-unsupported", "--seed=1"}) {
    const Outcome outcome = run({option, "--renderer=cpu", "--time-limit=0", flat});
    EXPECT_EQ(outcome.code, 0);
    EXPECT_THAT(outcome.err, HasSubstr("flat.csg:1:1: warning: cube is left out"));
  }
}

TEST_F(Validate, SaysWhatItDoesNotJudge) {
  const Outcome outcome = run_few({folder_.write("a.csg", "cube(1); cube(1e308);")});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_THAT(outcome.out, HasSubstr("1 node is left out, and was not judged\n"));
}

TEST_F(Validate, ReportToStandardOutputAndQuiet) {
  const Outcome outcome = run({"--renderer=cpu", "--time-limit=0", "--report=-", example("r9")});
  EXPECT_EQ(json::parse(outcome.out)["agrees"], true);
  const Outcome quiet = run({"-q", "--renderer=cpu", "--time-limit=0", example("r9")});
  EXPECT_EQ(quiet.out + quiet.err, "");
  EXPECT_EQ(quiet.code, 0);
}

TEST_F(Validate, HelpAndVersion) {
  const Outcome help = run({"--help"});
  EXPECT_EQ(help.code, 0);
  for (const char* option : {"--fn", "--points", "--rays", "--views", "--seed", "--time-limit",
                             "--report", "--threads"}) {
    EXPECT_THAT(help.out, HasSubstr(option));
  }
  EXPECT_THAT(help.out, Not(HasSubstr("PLANTED")));
  EXPECT_THAT(run({"-v"}).out, MatchesRegex("scadray-validate version [0-9.]+\n"));
}

TEST_F(Validate, EvaluatesAScad) {
  const std::string openscad = folder_.script("openscad", "echo 'sphere(r = 1, $fn = 0);'");
  const Environment environment("OPENSCAD", openscad);
  const std::string file = folder_.write("a.scad", "sphere(1, $fn = 0); echo(\"own\");");
  const Outcome own = run_few({file});
  EXPECT_EQ(own.code, 0) << own.err;
  EXPECT_THAT(own.err, HasSubstr("own"));
  const Outcome exported = run_few({"--evaluator=openscad", file});
  EXPECT_EQ(exported.code, 0) << exported.err;
  EXPECT_EQ(exported.err, "");
  EXPECT_THAT(exported.out, HasSubstr("in facets"));
}

// Also while CGAL works in a process of its own, which ends as well.
TEST_F(Validate, AnInterruptionEndsItWithinASecond) {
  folder_.write("report.json", "old");
  for (const int after_ms : {20, 1500}) {
    int held[2];  // held open by all processes that this one starts
    ASSERT_EQ(pipe(held), 0);
    const pid_t child =
        start({"--renderer=cpu", "--time-limit=1000", "--fn=100", report_, example("cs100")});
    std::this_thread::sleep_for(std::chrono::milliseconds(after_ms));
    const Clock::time_point start = Clock::now();
    kill(child, SIGINT);
    const Outcome outcome = finish(child);
    EXPECT_LT(Clock::now() - start, std::chrono::seconds(1));
    close(held[1]);
    pollfd all_ended{held[0], POLLIN, 0};
    EXPECT_EQ(poll(&all_ended, 1, 1000), 1) << "a process goes on";
    close(held[0]);
    if (after_ms > 1000) {  // before it has begun it may have nothing to say
      EXPECT_EQ(outcome.err, "error: interrupted\n");
    }
    EXPECT_NE(outcome.code, 0);
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(folder_.read("report.json"), "old");
    EXPECT_THAT(folder_.names(), testing::ElementsAre("err", "out", "report.json"));
  }
}

TEST_F(Validate, WithoutTheProgramTheErrorSaysSo) {
  const std::string alone = folder_ / "scadray";
  std::filesystem::copy_file(SCADRAY_PROGRAM, alone);
  const Outcome outcome = finish(start({example("r9")}, alone));
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("error: this scadray has no `validate`: "));
  EXPECT_THAT(outcome.err, HasSubstr("SCADRAY_ORACLE"));
  folder_.write("scadray-validate", "");
  EXPECT_THAT(finish(start({example("r9")}, alone)).err, HasSubstr("cannot be run"));
  // A link in another folder leads to the program, which finds its subcommand beside itself.
  std::filesystem::create_symlink(SCADRAY_PROGRAM, folder_ / "link");
  EXPECT_EQ(finish(start({"--help"}, folder_ / "link")).code, 0);
}

}  // namespace
}  // namespace validation
