// Tests `measure` itself on a few small designs: the report can read what it writes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "process.hpp"
#include "report.hpp"

namespace {

using nlohmann::json;
using testing::HasSubstr;

class Measure : public testing::Test {
 protected:
  Measure() {
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }

  measure::ProcessResult run(std::vector<std::string> options) const {
    options.insert(options.begin(),
                   {MEASURE, "--quick", "--output", results_, "--folder", folder_ / "work"});
    return measure::run_process(options, {300, folder_});
  }
  json results() const {
    std::ifstream stream(results_);
    return json::parse(stream);
  }

  const std::filesystem::path folder_ =
      std::filesystem::path(testing::TempDir()) /
      (std::string("measure_") + testing::UnitTest::GetInstance()->current_test_info()->name());
  const std::filesystem::path results_ = folder_ / "results.json";
};

/// The sections that are quick to measure.
const std::vector<std::string> kSections{"whole", "scale", "stability"};

TEST_F(Measure, WritesWhatTheReportReads) {
  std::vector<std::string> options;
  for (const std::string& section : kSections) {
    options.push_back("--section");
    options.push_back(section);
  }
  const measure::ProcessResult result = run(options);
  ASSERT_TRUE(result.succeeded()) << result.output;
  const json measured = results();
  EXPECT_GT(measured.at("machine").at("cores"), 0);
  for (const std::string& section : kSections) {
    EXPECT_TRUE(measured.at("sections").contains(section)) << section;
  }
  EXPECT_EQ(measured.at("sections").at("whole").at("designs").size(), 2u);  // r9 and cs100
  EXPECT_EQ(measured.at("sections").at("scale").at("primitives").size(), 5u);
  const report::Report made = report::make_report(measured);
  for (const char* heading : {"\n## From file to PNG", "\n## How it grows with primitives",
                              "\n## What cannot be seen", "\n## Pixels and threads"}) {
    EXPECT_THAT(made.markdown, HasSubstr(heading));
  }
  for (const report::Figure& figure : made.figures) {
    EXPECT_FALSE(report::gnuplot_script(figure, "out.svg").empty()) << figure.name;
  }
}

TEST_F(Measure, KeepsTheOtherSectionsOfTheSameMachine) {
  ASSERT_TRUE(run({"--section", "stability"}).succeeded());
  json before = results();
  before["sections"]["paper"] = "kept";
  std::ofstream(results_) << before;
  ASSERT_TRUE(run({"--section", "stability"}).succeeded());
  EXPECT_EQ(results().at("sections").at("paper"), "kept");
  before["machine"]["processor"] = "Abacus";
  std::ofstream(results_) << before;
  ASSERT_TRUE(run({"--section", "stability"}).succeeded());
  EXPECT_FALSE(results().at("sections").contains("paper"));
}

/// Runs other programs in scadray's place.
class WrongProgram : public Measure {
 protected:
  measure::ProcessResult run_with(const std::string& body) const {
    const std::filesystem::path program = folder_ / "program";
    std::ofstream(program) << "#!/bin/sh\n[ \"$1\" = --version ] && exit\n" << body;
    std::filesystem::permissions(program, std::filesystem::perms::owner_all);
    return run({"--section", "whole", "--scadray", program});
  }
  void expect_no_times(const measure::ProcessResult& result, const char* why) const {
    EXPECT_EQ(result.status, 1);
    EXPECT_THAT(result.output, HasSubstr("measure: wrong answer: "));
    EXPECT_THAT(result.output, HasSubstr(why));
    EXPECT_FALSE(std::filesystem::exists(results_));
  }
};

TEST_F(WrongProgram, ThatFailsHasNoTimes) {
  expect_no_times(run_with("echo out of paint; exit 1\n"), "out of paint");
}

TEST_F(WrongProgram, ThatDrawsNothingHasNoTimes) {
  // This one has another camera, which looks away.
  expect_no_times(run_with(std::string("exec ") + SCADRAY + " --camera=1e6,1e6,0,0,0,0,1 \"$@\"\n"),
                  "an empty picture");
}

TEST_F(WrongProgram, WhosePicturesDependOnTheTechniqueHasNoTimes) {
  expect_no_times(
      run_with(std::string("case \"$*\" in *cells*) turn=--camera=0,0,0,9,0,0,99 ;; esac\n"
                           "exec ") +
               SCADRAY + " $turn \"$@\"\n"),
      "another picture with --technique=cells");
}

TEST_F(Measure, UnknownSectionsAreNamed) {
  const measure::ProcessResult result = run({"--section", "speed"});
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(result.output, HasSubstr("no section speed (there are: whole"));
}

}  // namespace
