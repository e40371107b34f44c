#include "code/parameter_list.hpp"

#include <gtest/gtest.h>

namespace language {
namespace {

// The order in which a call's arguments are evaluated, by their numbers.
std::vector<uint32_t> order_of(const std::vector<std::string_view>& parameters,
                               const std::vector<std::string_view>& arguments,
                               std::vector<std::string>* warnings = nullptr) {
  NameTable names;
  std::vector<Name> declared;
  for (const auto parameter : parameters) declared.push_back(names.intern(parameter));
  ParameterList list(declared, names);
  std::vector<Argument> given;
  for (const auto argument : arguments)
    given.push_back({argument.empty() ? kNoName : names.intern(argument), nullptr, {}});
  const ArgumentPlan plan = plan_arguments(given, list, list.targets.size(), {}, names,
                                           dialect_of(LanguageVersion::k2021));
  std::vector<uint32_t> order;
  for (const ArgumentPlan::Step& step : plan.steps) order.push_back(step.argument);
  if (warnings)
    for (const ArgumentWarning& warning : plan.warnings) warnings->push_back(warning.text);
  return order;
}

using Order = std::vector<uint32_t>;

TEST(PlanArguments, KeepsTheOrderOfOpenscadsTable) {
  EXPECT_EQ(order_of({"a", "b", "c"}, {"", "", ""}), (Order{2, 1, 0}));
  // As OpenSCAD 2021.01 evaluates zz, aa, bb, ab, ba, a1, b1: b1 a1 ba bb ab aa zz.
  EXPECT_EQ(order_of({"zz", "aa", "bb", "ab", "ba", "a1", "b1"}, {"", "", "", "", "", "", ""}),
            (Order{6, 5, 4, 2, 3, 1, 0}));
}

TEST(PlanArguments, WarnsInTheOrderOfArguments) {
  std::vector<std::string> warnings;
  const Order order = order_of({"a"}, {"z", "a", "a", "", "", "$d"}, &warnings);
  EXPECT_EQ(order.size(), 3u);  // z, $d and the last of a
  EXPECT_EQ(warnings, (std::vector<std::string>{"variable z not specified as parameter",
                                                "argument a supplied more than once",
                                                "Too many unnamed arguments supplied"}));
}

TEST(PlanArguments, BindsDynamicNames) {
  NameTable names;
  EXPECT_TRUE(is_dynamic_name(names.intern("$fn"), names));
  EXPECT_FALSE(is_dynamic_name(names.intern("$children"), names));
  EXPECT_FALSE(is_dynamic_name(names.intern("fn"), names));
}

}  // namespace
}  // namespace language
