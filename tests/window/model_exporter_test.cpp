// Tests exports by the window's exporter: the file, the errors, and stopping it.
#include "model_exporter.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <optional>
#include <thread>

#include "temporary_folder.hpp"

namespace window {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

constexpr std::chrono::seconds kPatience{60};

/// Takes long to evaluate, and nothing else.
constexpr const char* kLong = "a = [for (i = [1:1e5], j = [1:1e5]) if (i < 0) 1]; cube(1);";

class ModelExporterTest : public testing::Test {
 protected:
  ModelOrder order(const std::string& file) {
    ModelOrder order;
    order.path = folder_ / file;
    order.options.input = folder_ / "a.scad";
    return order;
  }
  ModelOutcome wait() {
    const auto end = std::chrono::steady_clock::now() + kPatience;
    while (news_ == taken_ && std::chrono::steady_clock::now() < end) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    const std::optional<ModelOutcome> outcome = exporter_.take_outcome();
    if (!outcome) {
      ADD_FAILURE() << "the export does not end";
      return {};
    }
    ++taken_;
    return *outcome;
  }
  ModelOutcome write(const std::string& file) {
    exporter_.start(order(file));
    return wait();
  }

  frontend::TemporaryFolder folder_;
  std::atomic<int> news_{0};
  int taken_ = 0;
  ModelExporter exporter_{[this] { ++news_; }};
};

TEST_F(ModelExporterTest, TheSuffixTellsTheFormat) {
  folder_.write("a.scad", "cube([1, 2, 3]);");
  const std::pair<const char*, const char*> starts[] = {{"a.off", "OFF 8 12 0"},
                                                        {"a.obj", "o OpenSCAD_Model"},
                                                        {"a.amf", "<?xml"},
                                                        {"a.3mf", "PK"},
                                                        {"a.STL", ""}};
  for (const auto& [file, start] : starts) {
    const ModelOutcome outcome = write(file);
    EXPECT_EQ(outcome.error, "");
    EXPECT_EQ(outcome.path, folder_ / file);
    EXPECT_THAT(folder_.read(file), StartsWith(start));
  }
  EXPECT_EQ(folder_.read("a.STL").size(), 84 + 12 * 50u);
  EXPECT_EQ(news_, 5);
  EXPECT_FALSE(exporter_.activity());
  folder_.write("a.scad", "square(1);");
  EXPECT_EQ(write("a.svg").error, "");
  EXPECT_THAT(folder_.read("a.svg"), HasSubstr("<svg"));
}

TEST_F(ModelExporterTest, ErrorsLeaveNoFile) {
  folder_.write("a.scad", "cube(1);");
  const auto error_of = [&](const std::string& file) {
    const std::string error = write(file).error;
    EXPECT_FALSE(folder_.has(file)) << file;
    return error;
  };
  EXPECT_THAT(error_of("a.svg"), HasSubstr("Current top level object is not a 2D object."));
  EXPECT_THAT(error_of("a.foo"), HasSubstr("end it in .stl"));
  EXPECT_THAT(error_of("none/a.stl"), HasSubstr("none"));
  folder_.write("a.scad", "square(1);");
  EXPECT_THAT(error_of("a.stl"), HasSubstr("Current top level object is not a 3D object."));
  folder_.write("a.scad", "");
  EXPECT_THAT(error_of("a.stl"), HasSubstr("Current top level object is empty."));
  folder_.write("a.scad", "cube(1);\nassert(1 > 2);");
  EXPECT_THAT(error_of("a.stl"), HasSubstr("Assertion '(1 > 2)' failed"));
}

TEST_F(ModelExporterTest, WritesNoFileOfTheDesign) {
  folder_.write("a.scad", "import(\"b.off\");");
  folder_.write("b.scad", "cube(1);");
  ModelOrder part = order("b.off");
  part.options.input = folder_ / "b.scad";
  exporter_.start(part);
  EXPECT_EQ(wait().error, "");
  const std::string before = folder_.read("b.off");
  EXPECT_THAT(write("b.off").error, HasSubstr("a file of the design"));
  EXPECT_EQ(folder_.read("b.off"), before);
}

TEST_F(ModelExporterTest, TakesParametersTimeAndStream) {
  folder_.write("a.scad", "a = 1;\ncube([a, $t, $preview ? 1 : 5]);");
  ModelOrder set = order("a.obj");
  set.inputs.time = 0.25;
  set.inputs.parameters = language::ParameterSet{{"a", "7"}};
  exporter_.start(set);
  EXPECT_EQ(wait().error, "");
  EXPECT_THAT(folder_.read("a.obj"), HasSubstr("7 0.25 5"));
  ModelOrder piped = order("b.obj");
  piped.options.input = "-";
  piped.options.evaluator = frontend::Evaluator::kOwn;
  piped.stream = frontend::FileText("cube(3);");
  exporter_.start(piped);
  EXPECT_EQ(wait().error, "");
  EXPECT_THAT(folder_.read("b.obj"), HasSubstr("3 3 3"));
}

TEST_F(ModelExporterTest, IsStoppedAndBeginsAnew) {
  folder_.write("a.scad", kLong);
  exporter_.start(order("a.stl"));
  ASSERT_TRUE(exporter_.activity());
  EXPECT_THAT(exporter_.activity()->stage, StartsWith("exporting"));
  EXPECT_TRUE(exporter_.stop());
  EXPECT_FALSE(exporter_.activity());
  EXPECT_FALSE(exporter_.stop());
  folder_.write("a.scad", "cube(1);");
  EXPECT_EQ(write("b.stl").error, "");
  EXPECT_FALSE(folder_.has("a.stl"));
  EXPECT_EQ(news_, 1);
}

TEST_F(ModelExporterTest, ItsEndStopsIt) {
  folder_.write("a.scad", kLong);
  {
    ModelExporter exporter([] {});
    exporter.start(order("a.stl"));
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  EXPECT_FALSE(folder_.has("a.stl"));
}

}  // namespace
}  // namespace window
