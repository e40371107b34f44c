#include "language/parameter_set_file.hpp"

#include <gtest/gtest.h>

namespace language {
namespace {

using Names = std::vector<std::string>;

TEST(ParameterSetFile, AnEmptyOneIsWrittenAsOpenScadDoes) {
  ParameterSetFile file;
  EXPECT_EQ(file.names(), Names{});
  ASSERT_TRUE(file.put("a \"b\"", {{"x", "1"}, {"s", "é/\n"}}));
  EXPECT_EQ(file.text(), R"({
    "parameterSets": {
        "a \"b\"": {
            "s": "é/\n",
            "x": "1"
        }
    },
    "fileFormatVersion": "1"
}
)");
}

TEST(ParameterSetFile, KeepsWhatItDoesNotKnow) {
  ParameterSetFile file(R"({"z": [1, {"y": null}], "parameterSets": {"b": {"x": "1", "o": "2"},
    "a": {"n": 1.50, "t": true, "v": [1]}}, "w": "é", "fileFormatVersion": "1"})");
  EXPECT_EQ(file.names(), (Names{"b", "a"}));
  EXPECT_EQ(file.find("a"), (ParameterSet{{"n", "1.5"}, {"t", "true"}}));
  EXPECT_EQ(file.find("c"), std::nullopt);
  ASSERT_TRUE(file.put("b", {{"x", "3"}}));
  ASSERT_TRUE(file.put("c", {{"x", "4"}}));
  file.erase("a");
  file.erase("none");
  const ParameterSetFile again(file.text());
  EXPECT_EQ(again.names(), (Names{"b", "c"}));
  EXPECT_EQ(again.find("b"), (ParameterSet{{"x", "3"}, {"o", "2"}}));
  EXPECT_EQ(again.find("c"), (ParameterSet{{"x", "4"}}));
  const std::string text = file.text();
  EXPECT_NE(text.find("\"y\": null"), text.npos);
  EXPECT_LT(text.find("\"z\""), text.find("\"parameterSets\""));
  EXPECT_LT(text.find("\"parameterSets\""), text.find("\"w\""));
}

TEST(ParameterSetFile, SetsReplaceTheEmptyTextThatOpenScadWritesForNone) {
  ParameterSetFile file(R"({"parameterSets": "", "fileFormatVersion": "1"})");
  EXPECT_EQ(file.names(), Names{});
  ASSERT_TRUE(file.put("a", {{"x", "1"}}));
  EXPECT_EQ(file.names(), Names{"a"});
}

TEST(ParameterSetFile, OtherFilesAreRefused) {
  try {
    ParameterSetFile file("{\n\"a\": \n}");
    FAIL();
  } catch (const ParameterSetFile::ParseError& error) {
    EXPECT_EQ(error.line, 3u);
  }
  EXPECT_THROW(ParameterSetFile(R"({"parameterSets": {"a": {"x": 1e999}}})"),
               ParameterSetFile::ParseError);
  EXPECT_THROW(ParameterSetFile(std::string(200'000, '[') + std::string(200'000, ']')),
               ParameterSetFile::ParseError)
      << "deeper than can be written";
  EXPECT_EQ(ParameterSetFile("{\"" + std::string(200, '[') + "\\\"\": 1}").names(), Names{});
  ParameterSetFile list("[1]");
  EXPECT_FALSE(list.put("a", {}));
  EXPECT_EQ(list.text(), "[\n    1\n]\n");
}

}  // namespace
}  // namespace language
