#include "evaluation/evaluated.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <thread>

#include "evaluation/value_stack.hpp"
#include "language/csg_writer.hpp"
#include "language/stopped.hpp"

namespace language {
namespace {

// A used file that speaks when its top level is evaluated.
constexpr const char* kLibrary = R"(echo("not called");
libv = echo("library") 3;
$lv = 7;
function lf(a = echo("default") 1, b) = [a, b, libv, $lv, $z];
module lm(a = 1) { echo("body", a, $lv, $z); children(); }
function gf() = function() libv;
)";

// A used file whose top level can be kept while $q stays.
constexpr const char* kQuiet = R"(q = $q * 10;
list = [for (i = [0:3]) i];
function value() = q;
function constant() = list;
module quiet() { echo(q, $q); }
)";

// A used file whose top level has another result at each call.
constexpr const char* kChanging = R"(name = parent_module(0);
number = rands(0, 1, 1)[0];
function name() = name;
function number() = number;
)";

// A used file in another folder, which reads names that are not set.
constexpr const char* kUnset = "function unset() = [$name, $children, name];\n";

class Folder {
 public:
  Folder() { std::filesystem::create_directories(path_); }
  ~Folder() { std::filesystem::remove_all(path_); }
  std::string write(const std::string& name, const std::string& text) const {
    const auto file = path_ / name;
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file) << text;
    return file;
  }

 private:
  std::filesystem::path path_ =
      std::filesystem::temp_directory_path() / ("language-test-" + std::to_string(getpid()));
};

}  // namespace

Evaluated evaluated(const std::string& program, const Options& options) {
  const Folder folder;
  folder.write("library.scad", kLibrary);
  folder.write("quiet.scad", kQuiet);
  folder.write("changing.scad", kChanging);
  folder.write("folder/unset.scad", kUnset);
  EvaluationOptions evaluation;
  evaluation.hard_warnings = options.hard_warnings;
  evaluation.check_parameters = options.check_parameters;
  Evaluated result;
  const auto sink = [&](std::string_view line) { (result.messages += line) += "\n"; };
  result.evaluation = evaluate(folder.write("design.scad", program), evaluation, sink);
  result.tree = csg_text(*result.evaluation.tree);
  return result;
}

TEST(Evaluation, TellsOutcomeAndFiles) {
  const Evaluated result = evaluated("use <quiet.scad>\nuse <none.scad>\ncube(1);\n");
  EXPECT_EQ(result.evaluation.outcome, Outcome::kDone);
  ASSERT_EQ(result.evaluation.files_read.size(), 2u);
  EXPECT_TRUE(result.evaluation.files_read[1].ends_with("/quiet.scad"));
  EXPECT_FALSE(result.evaluation.lookups.empty());
  EXPECT_EQ(evaluated("cube(").evaluation.outcome, Outcome::kNotParsed);
  EXPECT_EQ(evaluated("assert(false);").evaluation.outcome, Outcome::kAborted);
}

TEST(Evaluation, TellsWhereLinesComeFrom) {
  const Folder folder;
  folder.write("folder/deep.scad", "module deep() {\n  x = nothing;\n}\n");
  folder.write("folder/broken.scad", "cube(;\n");
  std::vector<std::string> places;
  const Evaluation evaluation =
      evaluate(folder.write("design.scad",
                            "use <folder/deep.scad>\nuse <folder/broken.scad>\ndeep();\n echo(y);"),
               {}, [&](const SaidLine& line) {
                 if (line.place.file == kNoFile) return places.push_back("none");
                 const std::string& path = line.files[line.place.file].path;
                 places.push_back(path.substr(path.rfind('/', path.rfind('/') - 1) + 1) + ":" +
                                  std::to_string(line.files.line(line.place)));
               });
  const std::string root = std::filesystem::path(evaluation.files_read[0]).parent_path().filename();
  ASSERT_EQ(places.size(), 4u);
  EXPECT_EQ(places[0], "folder/broken.scad:1");
  EXPECT_EQ(places[1], "folder/deep.scad:2");
  EXPECT_EQ(places[2], root + "/design.scad:4");
  EXPECT_EQ(places[3], "none");
  EXPECT_TRUE(evaluation.has_unparsed_files);
  EXPECT_FALSE(evaluated("use <quiet.scad>\n").evaluation.has_unparsed_files);
}

TEST(Evaluation, TellsWhatAMessageIsOfWithoutGroupAndPlace) {
  const Folder folder;
  std::string told;
  const std::string path = folder.write("design.scad", "x = y;\ninclude <none.scad>\necho(1);");
  evaluate(path, {}, [&](const SaidLine& line) {
    const bool has_place = line.place.file != kNoFile;
    told += std::to_string(static_cast<int>(line.group)) + std::string(line.what) +
            (has_place ? "@" + std::to_string(line.place.offset) : "") + "\n";
  });
  EXPECT_EQ(told,
            "1Can't open include file 'none.scad'.@7\n1Ignoring unknown variable 'y'@4\n51\n");
}

TEST(Evaluation, TellsTheValuesOfTheTopLevel) {
  const Folder folder;
  EvaluationOptions options;
  options.wants_values = true;
  const auto values_of = [&](const std::string& text) {
    std::string all;
    const auto said = evaluate(folder.write("design.scad", text), options, [](const SaidLine&) {});
    for (const auto& [name, value] : said.values) all += name + "=" + value + " ";
    return all;
  };
  EXPECT_EQ(values_of("a = 1 + 1; b = [a, [\"c\"]]; $d = a; module m() { e = 1; } m(); f = g;"),
            "$d=2 a=2 b=[2, [\"c\"]] f=undef ");
  EXPECT_EQ(
      values_of("a = [for (i = [0 : 99]) i]; b = [[for (i = [0 : 99]) i]]; f = function () 1;"),
      "a=vector of 100 elements b=vector of 1 elements f=function ");
  EXPECT_EQ(values_of("a = 1; assert(false);"), "a=1 ");
  EXPECT_EQ(values_of("a = 1; b = "), "");
  options.wants_values = false;
  EXPECT_EQ(values_of("a = 1;"), "");
}

TEST(Evaluation, ReadsTheCamera) {
  const Evaluated result = evaluated("$vpt = [1, 2, 3];\n$vpr = [1, 2, 3, 4];\n$vpd = 70;\n");
  const DesignCamera& camera = result.evaluation.camera;
  EXPECT_EQ(camera.translation, (std::array<double, 3>{1, 2, 3}));
  EXPECT_FALSE(camera.rotation_deg);
  EXPECT_EQ(camera.distance, 70);
  EXPECT_FALSE(camera.field_of_view_deg);
  EXPECT_EQ(result.messages,
            "WARNING: Unable to convert $vpr=[1, 2, 3, 4] to a vec3 or vec2 of numbers\n"
            "WARNING: Viewall and autocenter disabled in favor of $vp*\n");
}

TEST(Evaluation, SaysOfTheCameraWhatOpenScadSays) {
  const Folder folder;
  const auto said = [&](CameraChoice choice) {
    EvaluationOptions options;
    options.camera = choice;
    std::string messages;
    const auto sink = [&](std::string_view line) { (messages += line) += "\n"; };
    const Evaluation result =
        evaluate(folder.write("camera.scad", "$vpt = \"a\"; $vpd = 5;"), options, sink);
    EXPECT_EQ(result.camera.distance, 5);
    return messages;
  };
  const std::string wrong = "WARNING: Unable to convert $vpt=\"a\" to a vec3 or vec2 of numbers\n";
  EXPECT_EQ(said(CameraChoice::kDesign),
            wrong + "WARNING: Viewall and autocenter disabled in favor of $vp*\n");
  EXPECT_EQ(said(CameraChoice::kWindow), wrong);
  EXPECT_EQ(said(CameraChoice::kCommand), "");
}

TEST(Evaluation, AppliesParameterSets) {
  const Folder folder;
  EvaluationOptions options;
  options.parameter_file = folder.write(
      "sets.json", R"({"parameterSets": {"one": {"a": "5", "b": "hi", "c": "x", "d": "7"}}})");
  options.parameter_set = "one";
  std::string messages;
  const auto sink = [&](std::string_view line) { (messages += line) += "\n"; };
  evaluate(folder.write("design.scad", "a = 1; b = \"x\"; c = 3; d = 1 + 1; echo(a, b, c, d);\n"),
           options, sink);
  EXPECT_EQ(messages, "ECHO: 5, \"hi\", 3, 7\n");
}

TEST(Evaluation, NestsDeeplyAndEnds) {
  const Evaluated deep =
      evaluated("function r(n) = n == 0 ? 0 : 1 + r(n - 1);\necho(r(100000));\n");
  EXPECT_EQ(deep.messages, "ECHO: 100000\n");
  const Evaluated endless = evaluated("function r(n) = 1 +\nr(n + 1);\necho(r(0));\n");
  EXPECT_EQ(endless.evaluation.outcome, Outcome::kAborted);
  EXPECT_TRUE(endless.messages.starts_with(
      "ERROR: Recursion detected calling function 'r' in file design.scad, line 2\n"
      "TRACE: called by 'r' in file design.scad, line 2\n"));
}

TEST(Evaluation, StopsWhenAsked) {
  std::stop_source source;
  EvaluationOptions options;
  options.stop = source.get_token();
  const auto sink = [&](std::string_view) { source.request_stop(); };
  const Folder folder;
  const std::string file = folder.write(
      "endless.scad", "echo(1);\nfor (i = [0:9998], j = [0:9998], k = [0:9998]) let (a = i) { }\n");
  EXPECT_THROW(evaluate(file, options, sink), Stopped);
}

// Each of these takes minutes to years within one instruction.
TEST(Evaluation, StopsWithinAnInstruction) {
  const std::string nested =
      "echo(1); function twice(n) = n == 0 ? [1] : let (half = twice(n - 1)) [half, half];\n"
      "m = [for (i = [0:1499]) [for (j = [0:1499]) i + j]]; q = [for (i = [0:500000]) i];\n";
  for (const char* endless :
       {"echo(twice(60) == twice(60));", "echo(twice(60) < twice(60));",
        "echo(len(search([twice(50)], [twice(50)])));", "echo(len(m * m));",
        "echo(len(search([for (i = q) -1], q)));", "polygon(twice(60));",
        "k = [for (i = [0:9], j = q) undef]; module n() children(k); n() cube();"}) {
    std::stop_source source;
    EvaluationOptions options;
    options.stop = source.get_token();
    const Folder folder;
    const std::string file = folder.write("endless.scad", nested + endless);
    std::jthread stopper;
    const auto sink = [&](std::string_view) {
      stopper = std::jthread([&source] {
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
        source.request_stop();
      });
    };
    EXPECT_THROW(evaluate(file, options, sink), Stopped) << endless;
  }
}

// Files that hold nothing but other files: 2^50 of them.
TEST(Evaluation, StopsAmongIncludes) {
  const Folder folder;
  std::string file = folder.write("50.scad", "");
  for (int i = 49; i >= 0; --i) {
    const std::string next = "include <" + std::to_string(i + 1) + ".scad>\n";
    file = folder.write(std::to_string(i) + ".scad", next + next);
  }
  std::stop_source source;
  EvaluationOptions options;
  options.stop = source.get_token();
  const std::jthread stopper([&source] {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    source.request_stop();
  });
  EXPECT_THROW(evaluate(file, options, [](std::string_view) {}), Stopped);
}

TEST(Evaluation, CountsItsStack) {
  const ObjectMemory before = object_memory;
  object_memory.limit = object_memory.used + (1 << 20);
  {
    ValueStack stack;
    stack.reserve(1 << 15);
    EXPECT_GE(object_memory.used - before.used, (1 << 15) * int64_t{sizeof(Value)});
    EXPECT_THROW(stack.reserve(1 << 17), OutOfValueMemory);
    EXPECT_THROW(stack.reserve(0xFFFFFFFFu), OutOfValueMemory);
  }
  EXPECT_EQ(object_memory.used, before.used);
  object_memory = before;
}

TEST(Evaluation, TakesParametersAndTheTime) {
  const Folder folder;
  const std::string file = folder.write("design.scad", "a = 1; b = 2; c = $t * 10; echo(a, b, c);");
  const auto said = [&](const EvaluationOptions& options) {
    std::string lines;
    evaluate(file, options, [&](std::string_view line) { lines += line; });
    return lines;
  };
  EvaluationOptions options;
  options.parameter_file = folder.write("sets.json", R"({"parameterSets": {"s": {"a": "5"}}})");
  options.parameter_set = "s";
  EXPECT_EQ(said(options), "ECHO: 5, 2, 0");
  options.parameters = ParameterSet{{"b", "7"}, {"none", "8"}};
  options.time = 0.5;
  EXPECT_EQ(said(options), "ECHO: 1, 7, 5") << "in place of the file's set";
}

// Function values that hold themselves are no leak: the address sanitizer would say so.
TEST(Evaluation, FreesFunctionsThatHoldThemselves) {
  const Evaluated result = evaluated(
      "x = [for (i = [0:99]) let (f = function(n) n == 0 ? 0 : 1 + f(n - 1)) f(i)];\n"
      "g = function() h;\nh = [g, function() g];\necho(x[99], len(g()));\n");
  EXPECT_EQ(result.messages, "ECHO: 99, 2\n");
}

}  // namespace language
