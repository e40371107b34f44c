// Tests the way from a results file to the report and README.md's summary.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "made_results.hpp"
#include "plot.hpp"
#include "process.hpp"
#include "readme.hpp"
#include "text.hpp"

namespace {

using testing::HasSubstr;
using testing::Not;

TEST(Text, NumbersHaveThreeDigitsThatCount) {
  const std::pair<double, const char*> kExpected[] = {{0, "0"},
                                                      {0.041234, "0.0412"},
                                                      {8.126, "8.13"},
                                                      {9.996, "10.0"},
                                                      {14.64, "14.6"},
                                                      {345.4, "345"},
                                                      {40, "40"},
                                                      {2, "2"},
                                                      {4321.5, "4,320"},
                                                      {1'000'001, "1,000,001"},
                                                      {1234, "1,234"},
                                                      {-12.34, "-12.3"},
                                                      {2.14e-13, "2.1e-13"},
                                                      {1e-9, "1e-9"},
                                                      {0.00012, "0.000120"},
                                                      {999.6, "1,000"}};
  for (const auto& [value, text] : kExpected) EXPECT_EQ(report::number(value), text) << value;
  EXPECT_EQ(report::number(INFINITY), "–");
  EXPECT_EQ(report::whole_number(999'999), "999,999");
  EXPECT_EQ(report::bytes(1'234), "1.23 kB");
  EXPECT_EQ(report::bytes(999'700), "1.00 MB");
  EXPECT_EQ(report::percent(0.0031), "0.310%");
  EXPECT_EQ(report::listed({"a"}), "a");
  EXPECT_EQ(report::listed({"a", "b", "c"}), "a, b and c");
}

TEST(Text, TablesAreMarkdown) {
  report::Table table({"a", "b"});
  EXPECT_TRUE(table.empty());
  table.add({"1", ""});
  EXPECT_EQ(table.markdown(), "| a | b |\n| --- | --- |\n| 1 |  |\n");
}

TEST(Readme, OnlyTheRegionIsReplaced) {
  const std::string start = report::kRegionStart, end = report::kRegionEnd;
  EXPECT_EQ(report::with_region("before\n" + start + "\nold\n" + end + "\nafter\n", "new\n"),
            "before\n" + start + "\nnew\n" + end + "\nafter\n");
}

TEST(Readme, WithoutARegionOfItsOwnIsAnError) {
  const std::string start = report::kRegionStart, end = report::kRegionEnd;
  for (const std::string& readme :
       {std::string("text"), start, end, end + start, start + start + end, start + end + end}) {
    EXPECT_THROW(report::with_region(readme, "new"), std::runtime_error) << readme;
  }
}

report::Figure figure() {
  report::Panel panel{"it's 50% of {this}_and^that", {"x"}, {"y"}, {}};
  panel.y.zero_at = 0.01;
  panel.series.push_back({"one", {report::point(1, 0), {10, 5, 4, 6}, report::point(0, 1)}});
  panel.series.push_back({"guide", {report::point(1, 1)}, report::Series::Style::kGuide});
  return {"figure", {panel}};
}

TEST(Plot, DrawsZerosWhereTheAxisHasThem) {
  const std::string script = report::gnuplot_script(figure(), "out.svg");
  EXPECT_THAT(script, HasSubstr("\n1 0.01 0.01 0.01\n10 5 4 6\nEOD\n"));  // and no x of 0
  EXPECT_THAT(script, HasSubstr("'0' 1e-2"));
  EXPECT_THAT(script, HasSubstr("set output 'out.svg'"));
}

TEST(Plot, TextIsTakenAsItStands) {
  EXPECT_THAT(report::gnuplot_script(figure(), "out.svg"),
              HasSubstr(R"('it''s 50% of \{this\}\_and\^that')"));
}

std::string contents_of(const std::filesystem::path& file) {
  std::ifstream stream(file);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// Prepares a folder with a results file, a README.md and an old report, for the program itself.
class ReportProgram : public testing::Test {
 protected:
  ReportProgram() {
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_ / "plots");
    std::ofstream(folder_ / "README.md") << readme_;
    std::ofstream(folder_ / "results.json") << made::results_of({{"whole", made::whole()}});
    std::ofstream(report_) << "old";
    std::ofstream(folder_ / "plots" / "old.svg") << "<svg/>";
    // Plays gnuplot: writes its input into the file that the input names.
    std::ofstream(folder_ / "gnuplot")
        << "#!/bin/sh\ncp \"$1\" \"$(sed -n \"s/^set output '\\(.*\\)'$/"
           "\\1/p\" \"$1\")\"\n";
    std::filesystem::permissions(folder_ / "gnuplot", std::filesystem::perms::owner_all);
  }

  measure::ProcessResult run(const std::string& gnuplot) const {
    return measure::run_process({BENCHMARK_REPORT, "--results", folder_ / "results.json",
                                 "--summary", folder_ / "README.md", "--report", folder_ / "plots",
                                 "--link", "plots", "--gnuplot", gnuplot});
  }
  void expect_unchanged() const {
    EXPECT_EQ(contents_of(folder_ / "README.md"), readme_);
    EXPECT_EQ(contents_of(report_), "old");
    EXPECT_TRUE(std::filesystem::exists(folder_ / "plots" / "old.svg"));
  }

  const std::filesystem::path folder_ =
      std::filesystem::path(testing::TempDir()) /
      testing::UnitTest::GetInstance()->current_test_info()->name();
  const std::filesystem::path report_ = folder_ / "plots" / "README.md";
  const std::string readme_ = std::string("# title\n") + report::kRegionStart + "\nout of date\n" +
                              report::kRegionEnd + "\nafter\n";
};

TEST_F(ReportProgram, ReplacesTheRegionTheReportAndThePlots) {
  const measure::ProcessResult result = run(folder_ / "gnuplot");
  ASSERT_TRUE(result.succeeded()) << result.output;
  const std::string readme = contents_of(folder_ / "README.md");
  EXPECT_TRUE(readme.starts_with(std::string("# title\n") + report::kRegionStart + "\n"));
  EXPECT_TRUE(readme.ends_with(std::string("\n") + report::kRegionEnd + "\nafter\n"));
  EXPECT_THAT(readme, HasSubstr("at commit 0123456789"));
  EXPECT_THAT(readme, Not(HasSubstr("out of date")));
  const std::string report = contents_of(report_);
  EXPECT_TRUE(report.starts_with("# Benchmarks\n"));
  EXPECT_THAT(report, HasSubstr("\n## From file to PNG\n"));
  EXPECT_THAT(contents_of(folder_ / "plots" / "whole.svg"), HasSubstr("set multiplot"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "plots" / "old.svg"));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_ / "plots"), {}), 2);
}

TEST_F(ReportProgram, MalformedResultsChangeNothing) {
  for (const char* text : {"{\"machine\": ", "", "[]", "{\"machine\": {}}"}) {
    std::ofstream(folder_ / "results.json") << text;
    const measure::ProcessResult result = run(folder_ / "gnuplot");
    EXPECT_EQ(result.status, 1) << text;
    EXPECT_THAT(result.output, HasSubstr("benchmark_report: error: ")) << text;
    expect_unchanged();
  }
}

TEST_F(ReportProgram, WithoutGnuplotNothingChanges) {
  const measure::ProcessResult result = run("no-such-gnuplot");
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(result.output, HasSubstr("no-such-gnuplot was not found"));
  expect_unchanged();
  EXPECT_EQ(run("false").status, 1);
  expect_unchanged();
}

TEST_F(ReportProgram, TheSameResultsGiveTheSameBytes) {
  if (measure::find_program("gnuplot").empty()) GTEST_SKIP() << "gnuplot is not installed";
  ASSERT_TRUE(run("gnuplot").succeeded());
  const std::string svg = contents_of(folder_ / "plots" / "whole.svg");
  EXPECT_THAT(svg, HasSubstr("</svg>"));
  EXPECT_THAT(svg, HasSubstr("From file to PNG, whole process"));
  const std::string readme = contents_of(folder_ / "README.md");
  const std::string report = contents_of(report_);
  ASSERT_TRUE(run("gnuplot").succeeded());
  EXPECT_EQ(contents_of(folder_ / "plots" / "whole.svg"), svg);
  EXPECT_EQ(contents_of(folder_ / "README.md"), readme);
  EXPECT_EQ(contents_of(report_), report);
}

}  // namespace
