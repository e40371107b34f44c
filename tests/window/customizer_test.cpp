// Tests the customizer without a display: its values, and the file of sets.
#include "customizer.hpp"

#include <gmock/gmock.h>

#include "language/customizer.hpp"
#include "temporary_folder.hpp"

namespace window {
namespace {

using language::ParameterSet;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::shared_ptr<const frontend::DesignParameters> parameters_of(const std::string& text) {
  return std::make_shared<const frontend::DesignParameters>(
      frontend::DesignParameters{text, *language::customizer_parameters(text)});
}

constexpr const char* kDesign =
    "/* [B] */\na = 1; // [9]\nb = true;\n/* [A] */\nc = \"x\";\n/* [Hidden] */\nh = 1;\n"
    "/* [B] */\nd = [1, 2];\n";

class CustomizerTest : public testing::Test {
 protected:
  CustomizerTest() { customizer_.take(parameters_of(kDesign)); }

  std::vector<std::string> names() const {
    std::vector<std::string> names;
    for (const auto& parameter : customizer_.parameters()) names.push_back(parameter.name);
    return names;
  }

  frontend::TemporaryFolder folder_;
  std::string design_ = folder_.write("a.scad", kDesign);
  Customizer customizer_{design_, {}};
};

TEST_F(CustomizerTest, ShowsTheParametersByGroups) {
  EXPECT_THAT(names(), ElementsAre("a", "b", "d", "c"));
  EXPECT_EQ(customizer_.inputs(), std::nullopt);
  Customizer fixed(design_, {"-D", " a =2", "-D", "b=false"});
  fixed.take(parameters_of(kDesign));
  EXPECT_EQ(fixed.parameters().size(), 2u) << "what -D assigns is not offered";
  fixed.take(nullptr);
  EXPECT_THAT(fixed.parameters(), IsEmpty());
}

TEST_F(CustomizerTest, GivesTheValuesThatAreNotTheDefaults) {
  customizer_.set(0, 2.5);
  customizer_.set(2, std::vector<double>{3, 4});
  EXPECT_EQ(customizer_.inputs(), (ParameterSet{{"a", "2.5"}, {"d", "[3, 4]"}}));
  EXPECT_TRUE(customizer_.is_changed(0));
  EXPECT_FALSE(customizer_.is_changed(1));
  customizer_.reset(0);
  EXPECT_EQ(customizer_.inputs(), (ParameterSet{{"d", "[3, 4]"}}));
  EXPECT_TRUE(customizer_.is_any_changed());
  customizer_.reset_all();
  EXPECT_FALSE(customizer_.is_any_changed());
  EXPECT_EQ(customizer_.inputs(), ParameterSet());
}

TEST_F(CustomizerTest, ValuesOutliveASaveIfTheirTypeDoes) {
  customizer_.set(0, 5.0);
  customizer_.set(1, false);
  customizer_.set(3, std::string("y"));
  customizer_.take(parameters_of("a = 3;\nb = 7;\n"));
  EXPECT_EQ(customizer_.inputs(), (ParameterSet{{"a", "5"}}));
  EXPECT_EQ(customizer_.value(0), Customizer::Value(5.0));
  EXPECT_EQ(customizer_.value(1), Customizer::Value(7.0));
}

TEST_F(CustomizerTest, SavesAndChoosesSets) {
  customizer_.set(0, 2.0);
  EXPECT_TRUE(customizer_.is_set_changed());
  EXPECT_EQ(customizer_.save("one"), "");
  EXPECT_EQ(customizer_.set_name(), "one");
  EXPECT_FALSE(customizer_.is_set_changed());
  EXPECT_EQ(folder_.read("a.json"), R"({
    "parameterSets": {
        "one": {
            "a": "2",
            "b": "true",
            "c": "x",
            "d": "[1, 2]",
            "h": "1"
        }
    },
    "fileFormatVersion": "1"
}
)");
  EXPECT_THAT(folder_.names(), ElementsAre("a.json", "a.scad"));
  EXPECT_EQ(folder_.read("a.scad"), kDesign);
  customizer_.set(0, 3.0);
  EXPECT_TRUE(customizer_.is_set_changed());
  customizer_.set(0, 2.0);
  EXPECT_FALSE(customizer_.is_set_changed());
  EXPECT_EQ(customizer_.choose(""), "");
  EXPECT_EQ(customizer_.inputs(), ParameterSet());
  EXPECT_FALSE(customizer_.is_set_changed());
  EXPECT_EQ(customizer_.choose("one"), "");
  EXPECT_EQ(customizer_.value(0), Customizer::Value(2.0));
  EXPECT_EQ(customizer_.erase("one"), "");
  EXPECT_THAT(customizer_.set_names(), IsEmpty());
  EXPECT_EQ(customizer_.set_name(), "");
  EXPECT_THAT(customizer_.choose("one"), HasSubstr("no set \"one\""));
  EXPECT_EQ(customizer_.value(0), Customizer::Value(2.0)) << "the values stay";
}

TEST_F(CustomizerTest, KeepsWhatOthersHaveWritten) {
  folder_.write("a.json", R"({"x": 1, "parameterSets": {"s": {"a": "4", "n": "5", "b": "no"}}})");
  EXPECT_EQ(customizer_.choose("s"), "");
  EXPECT_EQ(customizer_.inputs(), (ParameterSet{{"a", "4"}, {"n", "5"}, {"b", "no"}}));
  EXPECT_FALSE(customizer_.is_changed(1)) << "a text of another type does not count";
  folder_.write("a.json", R"({"x": 1, "parameterSets": {"s": {"m": "6"}, "t": {}}})");
  EXPECT_EQ(customizer_.save("s"), "");
  EXPECT_THAT(folder_.read("a.json"),
              AllOf(HasSubstr("\"x\": 1"), HasSubstr("\"m\": \"6\""), HasSubstr("\"n\": \"5\"")));
  EXPECT_THAT(customizer_.set_names(), ElementsAre("s", "t"));
}

TEST_F(CustomizerTest, LeavesFilesThatHoldNoSets) {
  folder_.write("a.json", "{");
  EXPECT_THAT(customizer_.save("s"), HasSubstr("a.json:1: error: this is no JSON"));
  EXPECT_EQ(folder_.read("a.json"), "{");
  folder_.write("a.json", "[]");
  EXPECT_THAT(customizer_.save("s"), HasSubstr("no file of parameter sets"));
  EXPECT_EQ(folder_.read("a.json"), "[]");
  Customizer design_as_sets(design_, {"-p", design_});
  EXPECT_NE(design_as_sets.save("s"), "");
  EXPECT_EQ(folder_.read("a.scad"), kDesign);
}

TEST_F(CustomizerTest, StartsWithTheSetOfTheCommandLine) {
  const std::string sets =
      folder_.write("s.json", R"({"parameterSets": {"s": {"a": "4"}, "t": {}}})");
  Customizer customizer(design_, {"-p", sets, "-P", "s"});
  customizer.take(parameters_of(kDesign));
  EXPECT_EQ(customizer.file(), sets);
  EXPECT_EQ(customizer.set_name(), "s");
  EXPECT_EQ(customizer.value(0), Customizer::Value(4.0));
  EXPECT_EQ(customizer.inputs(), std::nullopt) << "the options give it";
  customizer.reset(0);
  EXPECT_EQ(customizer.inputs(), ParameterSet());
}

NumberGrid grid_of(const std::string& assignment) {
  const auto parameters = *language::customizer_parameters(assignment);
  return {parameters.at(0), std::get<double>(parameters[0].value)};
}

TEST(NumberGrid, StepsAsTheCommentSays) {
  EXPECT_EQ(grid_of("x = 3; // [1:2:9]").snap(5.9), 5);
  EXPECT_EQ(grid_of("x = 3; // [1:2:9]").snap(6.1), 7);
  EXPECT_EQ(grid_of("x = 3; // [1:2:8]").snap(99), 8);
  EXPECT_EQ(grid_of("x = 3; // [1:2:8]").snap(-99), 1);
  EXPECT_EQ(grid_of("x = 0.5; // [0:.1:1]").snap(0.31), 0.3);
  EXPECT_EQ(grid_of("x = 3; // 5").snap(9), 8) << "from the default";
  EXPECT_EQ(grid_of("x = 3; // 5").snap(-1e6 - 1), -1000002);
}

TEST(NumberGrid, StepsByIntegersOrHundredthsOtherwise) {
  EXPECT_EQ(grid_of("x = 3; // [0:9]").snap(4.4), 4);
  EXPECT_EQ(grid_of("x = 3;").snap(4.4), 4);
  EXPECT_EQ(grid_of("x = 2.5; // [0:9]").snap(4.4321), 4.43);
  EXPECT_EQ(grid_of("x = 2.5; // [0:900]").snap(4.4321), 4);
  EXPECT_EQ(grid_of("x = 25.5;").snap(4.4321), 4.4);
  EXPECT_EQ(grid_of("x = 0.025;").snap(0.03141592), 0.0314);
  EXPECT_EQ(grid_of("x = 3; // [0:9]").clamp(4.4), 4.4);
  EXPECT_EQ(grid_of("x = 3; // [0:9]").clamp(10), 9);
}

}  // namespace
}  // namespace window
