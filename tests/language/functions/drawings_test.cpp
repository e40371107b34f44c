// dxf_dim() and dxf_cross(), with what OpenSCAD 2021.01 makes of the same files.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "language/evaluation.hpp"

namespace language {
namespace {

namespace fs = std::filesystem;

std::string groups(std::initializer_list<std::pair<int, std::string>> list) {
  std::string text;
  for (const auto& [code, value] : list) text += std::to_string(code) + "\n" + value + "\n";
  return text;
}
std::string line(const char* x, const char* y, const char* end_x, const char* end_y) {
  return groups({{0, "LINE"}, {8, "0"}, {10, x}, {20, y}, {11, end_x}, {21, end_y}});
}
std::string dimension(const char* type, const char* name, const std::string& more = "") {
  return groups({{0, "DIMENSION"},
                 {8, "lay"},
                 {70, type},
                 {1, name},
                 {10, "1"},
                 {20, "2"},
                 {13, "64"},
                 {23, "128"},
                 {14, "256"},
                 {24, "512"},
                 {15, "1024"},
                 {25, "2048"}}) +
         more;
}

class Drawings : public ::testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder_ / "lib"); }
  void TearDown() override { fs::remove_all(folder_); }

  void write(const char* name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
  }
  void write_entities(const char* name, const std::string& entities) const {
    write(name, groups({{0, "SECTION"}, {2, "ENTITIES"}}) + entities +
                    groups({{0, "ENDSEC"}, {0, "EOF"}}));
  }
  /// Returns what a design says.
  std::string said(const std::string& design, bool hard_warnings = false) {
    write("design.scad", design);
    std::string messages;
    EvaluationOptions options;
    options.hard_warnings = hard_warnings;
    evaluation_ = evaluate(folder_ / "design.scad", options,
                           [&](std::string_view text) { (messages += text) += "\n"; });
    return messages;
  }
  std::string path(const char* name) const { return folder_ / name; }

  Evaluation evaluation_;

 private:
  fs::path folder_ =
      fs::canonical(fs::temp_directory_path()) / ("drawings-test-" + std::to_string(getpid()));
};

TEST_F(Drawings, TellTheirDimensions) {
  std::string all;
  for (const char* type : {"0", "1", "2", "3", "4", "6", "70", "38"}) all += dimension(type, type);
  write_entities("a.dxf", all + dimension("0", "turned", groups({{50, "30"}})));
  EXPECT_EQ(said("d = function(n, s = 1, o = [0, 0])\n"
                 "  dxf_dim(file = \"a.dxf\", name = n, scale = s, origin = o);\n"
                 "echo([for (n = [0, 1, 2, 3, 4, 6, 70, 38, \"turned\"]) d(n)]);\n"
                 "echo(d(\"\"), d(0, -2), d(2, -2), d(6, 3, [100, 100]), d(70, 3, [100, 100]));\n"),
            "ECHO: [192, 429.325, 180, 2287.5, 2287.5, 128, 64, 128, 358.277]\n"
            "ECHO: 192, 384, 180, 84, -108\n");
}

TEST_F(Drawings, TellWhereTheirFirstLinesCross) {
  const std::string first = line("0", "0", "10", "10"), second = line("0", "10", "10", "1");
  const auto cross = [&](const std::string& entities) {
    write_entities("a.dxf", entities);
    return said("echo(dxf_cross(file = \"a.dxf\"));");
  };
  EXPECT_EQ(cross(first + second + line("1", "0", "1", "1")), "ECHO: [5.26316, 5.26316]\n");
  const std::string none =
      "WARNING: Can't find cross in 'a.dxf', layer ''! in file design.scad, "
      "line 1\nECHO: undef\n";
  EXPECT_EQ(cross(first + line("0", "5", "10", "15") + second), none);  // parallel
  EXPECT_EQ(cross(first + second + line("10", "1", "20", "1")), none);  // a chain of two
  EXPECT_EQ(cross(line("1", "1", "1", "1") + first + second), none);    // a point is a line, too
}

TEST_F(Drawings, SayWhatIsWrongWithACall) {
  write_entities("a.dxf", dimension("1", "x") + dimension("5", "y"));
  EXPECT_EQ(said("e = function(x) echo(x) x;\n"
                 "echo(dxf_dim(foo = e(1), 2, origin = e(\"a\"), file = \"a.dxf\"));\n"
                 "echo(dxf_cross(file = \"no.dxf\", name = 1));\n"
                 "echo(dxf_dim(file = \"a.dxf\", layer = 7), dxf_dim(file = \"a.dxf\", name = "
                 "\"y\"));\n"),
            "ECHO: 1\n"
            "WARNING: dxf_dim(..., foo=...) is not supported in file design.scad, line 2\n"
            "WARNING: dxf_dim(..., =...) is not supported in file design.scad, line 2\n"
            "ECHO: \"a\"\n"
            "WARNING: dxf_dim(..., origin=\"a\") could not be converted in file design.scad, line "
            "2\n"
            "ECHO: 429.325\n"
            "WARNING: dxf_cross(..., name=...) is not supported in file design.scad, line 3\n"
            "WARNING: Can't open DXF file 'no.dxf'! in file design.scad, line 3\n"
            "ECHO: undef\n"
            "WARNING: Can't find dimension '' in 'a.dxf', layer '7'! in file design.scad, line 4\n"
            "WARNING: Dimension 'y' in 'a.dxf', layer '' has unsupported type! in file "
            "design.scad, line 4\n"
            "ECHO: undef, undef\n");
}

// OpenSCAD shows the first line of any file.
TEST_F(Drawings, ShowNoWordsOfAFileThatIsNone) {
  write("lib/passwords", "root:x:0:0\nfoo\n");
  const std::string messages = said("x = dxf_dim(file = \"lib/passwords\", name = \"x\");\n");
  EXPECT_EQ(messages.find("WARNING: Illegal ID '' in `" + path("lib/passwords") + "'\n"), 0u)
      << messages;
}

// What was found is kept, so the file's problems are said once.
TEST_F(Drawings, SayWhatIsWrongWithAFile) {
  write_entities("lib/a.dxf", dimension("1", "x", groups({{13, "1,5"}})) +
                                  groups({{0, "SPLINE"}, {0, "TEXT"}, {0, "LINE"}}));
  const std::string problems =
      "WARNING: Illegal value '1,5'in `" + path("lib/a.dxf") +
      "'\nWARNING: Not enough input values for ENDSEC. in '" + path("lib/a.dxf") +
      "'\nWARNING: Not enough input values for EOF. in '" + path("lib/a.dxf") + "'\n";
  const std::string design =
      "x = dxf_dim(file = \"lib/a.dxf\", name = \"x\");\n"
      "echo(x, dxf_dim(file = \"lib/a.dxf\", name = \"x\"));\n";
  EXPECT_EQ(said(design), problems +
                              "WARNING: Unsupported DXF Entity 'TEXT' (1) in \"lib/a.dxf\".\n"
                              "WARNING: Unsupported DXF Entity 'SPLINE' (1) in \"lib/a.dxf\".\n"
                              "ECHO: 429.325, 429.325\n");
  // With --hardwarnings the first three do not end the evaluation.
  EXPECT_EQ(said(design, true), problems +
                                    "WARNING: Unsupported DXF Entity 'TEXT' (1) in "
                                    "\"lib/a.dxf\".\n"
                                    "TRACE: called by 'dxf_dim' in file design.scad, line 1\n");
}

TEST_F(Drawings, AreFilesOfTheDesign) {
  write_entities("a.dxf", dimension("1", "x"));
  write("lib/use.scad", "function f(name) = dxf_dim(file = name, name = \"x\");\n");
  EXPECT_EQ(said("use <lib/use.scad>\necho(f(\"a.dxf\"), f(\"../a.dxf\"), f(\"no.dxf\"));\n"),
            "DEPRECATED: Imported file (a.dxf) found in document root instead of relative to the "
            "importing module. This behavior is deprecated\n"
            "WARNING: Can't open DXF file 'no.dxf'! in file lib/use.scad, line 1\n"
            "ECHO: 429.325, 429.325, undef\n");
  EXPECT_EQ(evaluation_.files_read,
            (std::vector<std::string>{path("design.scad"), path("lib/use.scad"), path("a.dxf")}));
  EXPECT_EQ(evaluation_.lookups,
            (std::vector<std::string>{path("lib/a.dxf"), path("lib/no.dxf"), path("no.dxf")}));
}

}  // namespace
}  // namespace language
