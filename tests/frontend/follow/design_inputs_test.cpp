// Tests the inputs that a followed design is read with besides its files: parameters and $t.
#include <gmock/gmock.h>

#include "follow/followed.hpp"
#include "follow/input_turn.hpp"
#include "frontend/design_file_options.hpp"
#include "temporary_folder.hpp"

namespace frontend {
namespace {

using std::chrono::milliseconds;
using testing::ElementsAre;

DesignInputs with_parameter(const std::string& name, const std::string& value) {
  return {language::ParameterSet{{name, value}}, std::nullopt};
}

FollowOptions by_own_evaluator() {
  FollowOptions options = by_inotify();
  options.evaluator = Evaluator::kOwn;
  return options;
}

constexpr const char* kSpheres =
    "n = 1; // [1:99]\nk = 1 + $t * 10;\nfor (i = [1 : n * k]) translate([3 * i, 0]) sphere();\n";

class Inputs : public testing::Test {
 protected:
  TemporaryFolder folder_;
};

TEST_F(Inputs, TheDesignIsReadWithThem) {
  Followed design(folder_.write("a.scad", kSpheres), by_own_evaluator());
  EXPECT_EQ(design.next_of(1).inputs, DesignInputs());
  const auto before = std::chrono::steady_clock::now();
  design->set_inputs(with_parameter("n", "3"));
  const DesignVersion changed = design.next_of(3);
  EXPECT_EQ(changed.inputs, with_parameter("n", "3"));
  EXPECT_GE(changed.noticed, before);
  design->set_inputs({language::ParameterSet{{"n", "2"}}, 0.5});
  design.next_of(12);
  folder_.write("a.scad", "n = 1;\nfor (i = [1 : n]) translate([3 * i, 0]) sphere();\n");
  EXPECT_EQ(design.next_of(2).inputs.time, 0.5) << "a save keeps them";
  design->set_inputs({});
  design.next_of(1);
  design.wait_until_idle();
}

TEST_F(Inputs, TheNewestAreShownInTheEnd) {
  Followed design(folder_.write("a.scad", kSpheres), by_own_evaluator());
  for (int n = 2; n <= 90; ++n) design->set_inputs(with_parameter("n", std::to_string(n)));
  design.next_of(90);
  EXPECT_LT(design.passed().size(), 80u) << "those between are skipped";
  design.wait_until_idle();
}

TEST_F(Inputs, ReplaceTheSetOfTheCommandLine) {
  const std::string sets = folder_.write("s.json", R"({"parameterSets": {"s": {"n": "4"}}})");
  FollowOptions options = by_own_evaluator();
  options.openscad_arguments = {"-p", sets, "-P", "s"};
  Followed design(folder_.write("a.scad", kSpheres), options);
  design.next_of(4);
  design->set_inputs({language::ParameterSet(), std::nullopt});
  design.next_of(1);
}

TEST_F(Inputs, OfTheCommandLineMakeAnyFileAScad) {
  FollowOptions options = by_own_evaluator();
  options.openscad_arguments = {"-D", "sphere();"};
  Followed design(folder_.write("design", "n = 1; // [1:9]\n"), options);
  EXPECT_NE(design.next_of(1).parameters, nullptr);
  folder_.write("design", "sphere(r = 1);");  // which is a .csg, too
  design.next_of(2);
}

TEST_F(Inputs, AreGivenToOpenScad) {
  if (std::system("command -v openscad > /dev/null") != 0) GTEST_SKIP() << "no openscad";
  FollowOptions options = by_inotify();
  options.openscad_arguments = {"-p", folder_ / "none.json", "-P", "x", "-D", "d=1"};
  const std::string path =
      folder_.write("a.scad",
                    "n = 1; d = 0; s = \"\"; echo(s);\n"
                    "for (i = [1 : n + d + 10 * $t]) translate([3 * i, 0]) sphere();\n");
  Followed design(path, options);
  design.next_error();  // there is no such file of sets
  design->set_inputs({language::ParameterSet{{"n", "2"}, {"s", "é \"\\"}}, 0.5});
  EXPECT_THAT(design.next_of(8).messages, ElementsAre("ECHO: \"é \"\\\""));
}

TEST_F(Inputs, TellWhatTheDesignOffers) {
  Followed design(folder_.write("a.scad", "a = 1; // [5]\nassert(a == 2);\nsphere();"),
                  by_own_evaluator());
  const DesignVersion failed = design.next_error();
  ASSERT_NE(failed.parameters, nullptr);
  ASSERT_EQ(failed.parameters->list.size(), 1u);
  EXPECT_EQ(failed.parameters->list[0].name, "a");
  design->set_inputs(with_parameter("a", "2"));
  EXPECT_EQ(design.next_of(1).parameters, failed.parameters) << "the text is the same";
  folder_.write("a.scad", "a = 1; // [5]\nsphere(;");
  EXPECT_EQ(design.next_error().parameters, failed.parameters) << "those of the last that parses";
  folder_.write("a.scad", "b = 1; sphere(1, $fn = 9); sphere();");
  EXPECT_EQ(design.next_of(2).parameters->list[0].name, "b");
}

TEST_F(Inputs, TellTheCameraOfEachTime) {
  Followed design(folder_.write("a.scad", "$vpr = [0, 0, 360 * $t]; sphere();"),
                  by_own_evaluator());
  EXPECT_EQ(design.next_of(1).camera.rotation_deg, csgcore::Vec3(0, 0, 0));
  design->set_inputs({std::nullopt, 0.25});
  const DesignVersion turned = design.next();
  EXPECT_EQ(turned.camera.rotation_deg, csgcore::Vec3(0, 0, 90));
}

TEST_F(Inputs, OfWhatIsReadOnceCountForItsKeptText) {
  Followed design("/dev/null", by_own_evaluator());
  design.next();
  design.wait_until_idle();
  design->set_inputs({std::nullopt, 0.5});
  EXPECT_EQ(design.next().inputs.time, 0.5);
}

// Plays a reading that takes a while and inputs that change all the time.
std::vector<int64_t> ends_of_readings(milliseconds needed, milliseconds end) {
  std::vector<int64_t> ends;
  InputTurn turn;
  std::optional<InputTurn::Clock::time_point> since;
  for (InputTurn::Clock::time_point now{}; now.time_since_epoch() < end; now += milliseconds(1)) {
    turn.notice(now);
    if (since && now - *since >= needed) {
      turn.finish();
      since.reset();
      ends.push_back(std::chrono::floor<milliseconds>(now.time_since_epoch()).count());
    }
    if (const auto due = turn.due(since); due && now >= *due) {
      turn.start(since.has_value());
      since = now;
    }
  }
  return ends;
}

TEST(InputTurn, LetsShortReadingsEnd) {
  EXPECT_EQ(ends_of_readings(milliseconds(20), milliseconds(2000)).size(), 99u);
}

TEST(InputTurn, StopsLongReadingsButNotForEver) {
  EXPECT_THAT(ends_of_readings(milliseconds(900), milliseconds(3500)), ElementsAre(1400, 2800));
  EXPECT_THAT(ends_of_readings(milliseconds(3000), milliseconds(8000)), ElementsAre(6500));
}

TEST(InputTurn, IsDueOnlyIfInputsHaveChanged) {
  InputTurn turn;
  const InputTurn::Clock::time_point now{};
  EXPECT_EQ(turn.due({}), std::nullopt);
  turn.notice(now);
  turn.notice(now + milliseconds(5));
  EXPECT_EQ(turn.noticed(), now);
  EXPECT_LT(*turn.due({}), now);
  EXPECT_EQ(turn.due(now), now + InputTurn::kPatience);
  turn.give_up();
  EXPECT_EQ(turn.due({}), std::nullopt);
}

}  // namespace
}  // namespace frontend
