#include "syntax/parameter_set.hpp"

#include "parsed_design.hpp"

namespace language {
namespace {

ValueType type_of_literal(const Expression& expression) {
  switch (expression.kind) {
    case ExpressionKind::kBool:
      return ValueType::kBool;
    case ExpressionKind::kNumber:
      return ValueType::kNumber;
    case ExpressionKind::kString:
      return ValueType::kString;
    case ExpressionKind::kVector:
      return ValueType::kVector;
    case ExpressionKind::kRange:
      return ValueType::kRange;
    default:
      return ValueType::kUndef;
  }
}

void apply_set(ParsedDesign& design, const std::string& file, const std::string& set) {
  const auto values = read_parameter_set(file, set, design.messages);
  if (values) apply_parameter_set(design.program, design.messages, *values, type_of_literal);
}

/// Returns what `x` is assigned where a set gives it a value (JSON) instead of the default.
std::string applied(const std::string& fallback, const std::string& value) {
  const DesignFolder folder;
  folder.write("main.scad", "x=" + fallback + ";y=1;");
  folder.write("sets.json", R"({"parameterSets": {"s": {"x": )" + value + "}}}");
  ParsedDesign design;
  apply_set(design, "sets.json", "s");
  EXPECT_EQ(design.assignments()[1], "y = 1");
  return design.lines.empty() ? design.assignments()[0].substr(4) : design.lines[0];
}

TEST(ParameterSets, GiveValuesOfTheDefaultsType) {
  EXPECT_EQ(applied("7", R"(" 1.5e1 ")"), "15");
  EXPECT_EQ(applied("7", "5.50"), "5.5");
  EXPECT_EQ(applied("7", R"x("-(5)")x"), "7");
  EXPECT_EQ(applied("7", R"x("((5))")x"), "5");
  EXPECT_EQ(applied("7", R"("1+1")"), "7");
  EXPECT_EQ(applied("7", R"("0x10")"), "7");
  EXPECT_EQ(applied("\"s\"", R"("a\"b")"), R"("a\"b")");
  EXPECT_EQ(applied("\"s\"", "5"), R"("5")");
  EXPECT_EQ(applied("true", R"("false")"), "false");
  EXPECT_EQ(applied("false", R"("1")"), "true");
  EXPECT_EQ(applied("true", R"("False")"),
            "ERROR: Cannot apply Parameter Set 'conversion of data to type \"b\" failed'");
  EXPECT_EQ(applied("[1]", R"("[ 1 , -2, \"a,b\", c d]")"), R"([1, -2, "a,b", "c d"])");
  EXPECT_EQ(applied("[7]", R"("[[1],2]")"), "[7]");
  EXPECT_EQ(applied("[7]", R"("[]")"), "[7]");
  EXPECT_EQ(applied("[7]", "[1,2]"), "[7]");
  EXPECT_EQ(applied("[1:2]", R"("[3:4]")"), "[3 : 4]");
  EXPECT_EQ(applied("f(1)", R"("5")"), "f(1)");
}

TEST(ParameterSets, TellWhatIsWrongWithTheFile) {
  const DesignFolder folder;
  folder.write("main.scad", "x=1;");
  folder.write("bad.json", "\n{");
  ParsedDesign design;
  apply_set(design, "none.json", "s");
  apply_set(design, "bad.json", "s");
  EXPECT_EQ(design.lines,
            (Lines{"ERROR: Cannot open Parameter Set 'none.json': none.json: cannot open file",
                   "ERROR: Cannot open Parameter Set 'bad.json': bad.json(2): expected value"}));
  folder.write("good.json", R"({"parameterSets": {"s": {"x": "2"}}})");
  apply_set(design, "good.json", "other");
  apply_set(design, "good.json", "");
  EXPECT_EQ(design.assignments(), Lines{"x = 1"});
}

}  // namespace
}  // namespace language
