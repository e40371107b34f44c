// Tests that the installed openscad reads what scadray exports, and finds the same in it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "frontend/command.hpp"
#include "meshes/read_solid_file.hpp"
#include "temporary_folder.hpp"

namespace frontend {
namespace {

using testing::HasSubstr;
using testing::Not;

class OpenScadReads : public testing::Test {
 protected:
  void export_design(const std::string& text, const std::string& name) {
    const auto no_renderer = [](const auto&...) { return csgcore::Image(); };
    ASSERT_EQ(run_command({"-q", "-o", folder_ / name, folder_.write("a.scad", text)}, no_renderer),
              ExitCode::kDone);
  }
  /// Has openscad export the text of a design, and returns the bytes of the file.
  std::string by_openscad(const std::string& text, const std::string& format) {
    const std::string design = folder_.write("o.scad", text), out = folder_ / ("o." + format);
    const std::string command =
        "openscad -o " + out + " " + design + " 2>" + (folder_ / "messages");
    EXPECT_EQ(std::system(command.c_str()), 0) << folder_.read("messages");
    EXPECT_THAT(folder_.read("messages"), Not(HasSubstr("WARNING")));
    return folder_.read("o." + format);
  }
  static double volume(const std::string& off) { return enclosed_volume(read_off(off, "o").faces); }

  TemporaryFolder folder_;
};

TEST_F(OpenScadReads, SolidsInEveryFormat) {
  const std::string design =
      "color(\"red\") sphere(10, $fn = 20);\n"
      "color(\"blue\") translate([50, 0, 0]) rotate([10, 20, 30]) cube([1, 2, 3] * 7 / 3);\n"
      "translate([100, 0, 0]) linear_extrude(5, twist = 90) square(3);\n";
  const double expected = volume(by_openscad(design, "off"));
  for (const char* name : {"a.stl", "a.off", "a.amf", "a.3mf"}) {
    SCOPED_TRACE(name);
    export_design(design, name);
    // A second operand has openscad check that the surface is closed.
    const std::string read =
        "import(\"" + std::string(name) + "\"); translate([0, 0, 50]) cube(1);";
    EXPECT_NEAR(volume(by_openscad(read, "off")), expected + 1, 1e-5 * expected);
  }
}

TEST_F(OpenScadReads, Outlines) {
  const std::string design = "difference() { circle(10, $fn = 7); translate([1, 2]) square(3); }";
  const std::string solid = "linear_extrude(1) ";
  const double expected = volume(by_openscad(solid + design, "off"));
  for (const char* name : {"a.svg", "a.dxf"}) {
    SCOPED_TRACE(name);
    export_design(design, name);
    const std::string read = solid + "import(\"" + std::string(name) + "\");";
    EXPECT_NEAR(volume(by_openscad(read, "off")), expected, 1e-3 * expected);
  }
}

}  // namespace
}  // namespace frontend
