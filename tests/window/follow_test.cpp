// Tests the window beside an editor: how a save, a broken save and an included file change its
// picture.
#include <gmock/gmock.h>

#include <filesystem>

#include "designs.hpp"
#include "follow/saves.hpp"
#include "live_window.hpp"
#include "support/full_run.hpp"

namespace window_test {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::StartsWith;

using Following = LiveWindow;

TEST_F(Following, EveryWayOfSaving) {
  const std::string design = folder_.write("a.csg", row_of(1));
  open(design, {"--camera=10,0,0,55,0,25,100"});
  const json first = next();
  std::size_t count = 1;
  for (const frontend::Save& save : frontend::kSaves) {
    SCOPED_TRACE(save.name);
    ++count;
    save.write(folder_, "a.csg", row_of(static_cast<int>(count)));
    const json line = next_of(count);
    EXPECT_GE(line["save_to_screen_ms"].get<double>(), 0);
    EXPECT_EQ(line["camera"], first["camera"]);
    expect_drawn(design, line);
  }
}

/// The camera that was chosen for the first design stays.
TEST_F(Following, TheViewStaysWhereItWas) {
  const std::string design = folder_.write("a.csg", row_of(1));
  open(design);
  const json first = next();
  folder_.write("a.csg", row_of(9));
  const json second = next_of(9);
  EXPECT_EQ(second["camera"], first["camera"]);
  expect_drawn(design, second);
}

TEST_F(Following, ASaveThatChangesNothing) {
  const std::string design = folder_.write("a.csg", row_of(3));
  open(design);
  const json first = next();
  const Picture before = shown();
  folder_.write("a.csg", row_of(3));
  const json second = next();
  EXPECT_EQ(second["version"], 2);
  EXPECT_EQ(second["edit"]["pixels_traced"], 0);
  EXPECT_GE(second["save_to_screen_ms"].get<double>(), 0);
  expect_shown(before);
}

/// The error is shown over the last good picture.
constexpr Area kAboveTheError{0, 30, kWidth, 120};

TEST_F(Following, MissingValidBrokenValid) {
  if (missing_program({"openscad"})) GTEST_SKIP() << "no openscad";
  const std::string design = folder_ / "a.scad";
  open(design);
  const json missing = next_error();
  EXPECT_THAT(missing["error"].get<std::string>(),
              AllOf(StartsWith(design + ": error: "), HasSubstr("No such file")));
  EXPECT_EQ(title(), "a.scad - error - scadray");
  folder_.write("a.scad", "difference() { cube(10); sphere(8); }\n");
  const json valid = next_of(2);
  expect_drawn(design, valid);
  EXPECT_EQ(title(), "a.scad - scadray");
  const Picture good = shown();

  folder_.write("a.scad", "difference() { cube(10);\nsphere(8;\n}\n");
  const json broken = next_error();
  EXPECT_THAT(broken["error"].get<std::string>(), StartsWith(design + ":2:"));
  EXPECT_EQ(broken["primitives"], 2);
  EXPECT_EQ(title(), "a.scad - error - scadray");
  wait_until_other(good);  // the window says so
  expect_shown(good, kAboveTheError);

  folder_.write("a.scad", "difference() { cube(10); sphere(8); sphere(9); }\n");
  const json mended = next_of(3);
  EXPECT_EQ(title(), "a.scad - scadray");
  EXPECT_EQ(mended["camera"], valid["camera"]);
  expect_drawn(design, mended);

  fs::remove(design);
  EXPECT_THAT(next_error()["error"].get<std::string>(), HasSubstr("No such file"));
  folder_.write("a.scad", "difference() { cube(10); sphere(8); sphere(9); }\n");
  next([](const json& line) { return line["error"] == ""; });
  expect_drawn(design, mended);
}

TEST_F(Following, EscapeStopsWhatTakesLong) {
  const std::string design = folder_.write("a.scad", "cube(10); sphere(8);");
  open(design);
  next_of(2);
  const Picture good = shown();
  folder_.write("a.scad", "function f(n) = n < 2 ? n : f(n - 1) + f(n - 2); cube(f(99));");
  wait_until_other(good);
  key("Escape");
  expect_shown(good, free_area());
  folder_.write("a.scad", "cube(10); sphere(8); cube(9);");
  expect_drawn(design, next_of(3));
}

TEST_F(Following, EscapeStopsAPictureUntilItIsAskedForAgain) {
  const std::string start = "n = ";
  const std::string rest =
      "; for (j = [1 : ceil(n / 8000)], i = [1 : min(n, 8000)]) "
      "%translate(rands(-20, 20, 3, i + j / 99)) sphere(15);";
  const std::string design = folder_.write("a.scad", start + "9" + rest);
  open(design, {"--renderer=cpu"});
  next_of(9);
  const Picture good = shown();
  const int many = test_support::does_less() ? 8000 : 40'000;  // takes some seconds
  folder_.write("a.scad", start + std::to_string(many) + rest);
  const Area area = free_area();
  EXPECT_TRUE(wait_until([&] { return part(shown(), area) != part(good, area); }));
  key("Escape");
  expect_shown(good, area);
  key("F5");
  next_of(many);
}

TEST_F(Following, EchoesOfAReadingArePrintedOnce) {
  const std::string design = folder_.write("a.scad", "echo(1); cube(); sphere();");
  ProcessSetup setup;
  setup.output = folder_ / "output";
  open(design, {"--echo"}, setup);
  next_of(2);
  key("4");  // another picture of the same reading
  next();
  folder_.write("a.scad", "echo(\"a\\nb\"); cube();");
  next_of(1);
  key("F5");
  next();
  EXPECT_EQ(folder_.read("output"), "ECHO: 1\nECHO: \"a\nb\"\nECHO: \"a\nb\"\n");
}

TEST_F(Following, AnIncludedFile) {
  if (missing_program({"openscad"})) GTEST_SKIP() << "no openscad";
  folder_.write("part.scad", "module part() { cube(10); }\necho(\"one\");\n");
  const std::string design = folder_.write("a.scad", "include <part.scad>\npart();\n");
  open(design);
  EXPECT_THAT(next_of(1)["messages"].get<std::vector<std::string>>(),
              Contains(HasSubstr("ECHO: \"one\"")));
  folder_.write("part.scad", "module part() { cube(10); sphere(8); }\n");
  key("m");
  expect_drawn(design, next_of(2));
  const Picture good = shown();
  folder_.write("part.scad", "module part() { cube(10; }\n");
  EXPECT_THAT(next_error()["error"].get<std::string>(), HasSubstr("part.scad:1:"));
  wait_until_other(good);
  expect_shown(good, kAboveTheError);
  folder_.write("part.scad", "module part() { cube(10); sphere(8); sphere(9); }\n");
  expect_drawn(design, next_of(3));
}

TEST_F(Following, Reload) {
  const std::string design = folder_.write("a.csg", row_of(3));
  open(design);
  next();
  for (const int version : {2, 3}) {
    key(version == 2 ? "F5" : "F4");
    const json line = next();
    EXPECT_EQ(line["version"], version);
    EXPECT_EQ(line["edit"]["pixels_traced"], 0);
  }
}

}  // namespace
}  // namespace window_test
