#include "functions/builtin_functions.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <initializer_list>
#include <vector>

#include "language/make.hpp"
#include "values/range.hpp"
#include "values/value_text.hpp"

namespace language {
namespace {

Value list(std::initializer_list<Value> elements) {
  return make_vector(std::span(elements.begin(), elements.size()));
}

Value text(std::string_view characters) { return make_string(characters); }

constexpr double kInfinity = std::numeric_limits<double>::infinity();
const Value kNan = 0.0 / 0.0;

class BuiltinFunctions : public ::testing::Test {
 protected:
  // Calls a function as the evaluator does. Returns the value as echo() shows it, and what is said.
  std::string call(std::string_view name, std::vector<Value> written) {
    said_.clear();
    const auto functions = builtin_functions();
    const auto function = std::find_if(functions.begin(), functions.end(),
                                       [&](const auto& known) { return known.name == name; });
    if (function == functions.end()) return "no such function";
    evaluated_.clear();
    FunctionCall call{name, written.size(), {}, {0, 0}, environment_};
    for (size_t next = next_of(*function, call); next != kNoArgument;
         next = next_of(*function, call)) {
      evaluated_.push_back(written[next]);
      call.arguments = evaluated_;
    }
    const std::string shown = echo_text(function->call(call));
    return shown + said_;
  }

  size_t evaluated() const { return evaluated_.size(); }

  std::vector<std::string_view> modules_;

 private:
  static size_t next_of(const BuiltinFunction& function, const FunctionCall& call) {
    if (function.next_argument) return function.next_argument(call);
    return call.arguments.size() < call.written ? call.arguments.size() : kNoArgument;
  }
  static SourceFiles one_file() {
    SourceFiles files;
    files.add("/folder/x.scad", "call();");
    return files;
  }

  std::string said_;
  std::vector<Value> evaluated_;
  SourceFiles files_ = one_file();
  Messages messages_{files_, [this](const Message& message) { said_ += " | " + message.text; }};

 protected:
  NamedFiles named_files_{messages_, "/folder", nullptr};
  FunctionEnvironment environment_{dialect_of(LanguageVersion::k2021), messages_, named_files_,
                                   std::mt19937()};
};

TEST_F(BuiltinFunctions, AreSortedByName) {
  const auto functions = builtin_functions();
  for (size_t i = 1; i < functions.size(); ++i) EXPECT_LT(functions[i - 1].name, functions[i].name);
}

TEST_F(BuiltinFunctions, ComputeWithNumbers) {
  EXPECT_EQ(call("abs", {-5}), "5");
  EXPECT_EQ(call("sign", {kNan}), "0");
  EXPECT_EQ(call("round", {-2.5}), "-3");
  EXPECT_EQ(call("ln", {0}), "-inf");
  EXPECT_EQ(call("log", {2, 8}), "3");
  EXPECT_EQ(call("sin", {30}), "0.5");
  EXPECT_EQ(call("atan2", {0, -1}), "180");
  EXPECT_EQ(call("pow", {2, 3}), "8");
  EXPECT_EQ(call("abs", {text("a")}), "undef | abs() parameter could not be converted");
}

TEST_F(BuiltinFunctions, StopEvaluatingAtWhatIsNoNumber) {
  EXPECT_EQ(call("log", {text("a"), 1}), "undef | log() parameter could not be converted");
  EXPECT_EQ(evaluated(), 1u);
  EXPECT_EQ(call("pow", {text("a"), 1}), "undef | pow() parameter could not be converted");
  EXPECT_EQ(evaluated(), 2u);
  call("version", {1});
  EXPECT_EQ(evaluated(), 0u);
}

TEST_F(BuiltinFunctions, MinAndMaxChoose) {
  EXPECT_EQ(call("min", {kNan, 1}), "nan");
  EXPECT_EQ(call("min", {1, kNan}), "1");
  EXPECT_EQ(call("max", {list({1, text("a"), 3})}), "3");
  EXPECT_EQ(call("min", {list({text("b"), text("a")})}), "\"a\"");
  EXPECT_EQ(call("min", {list({})}), "undef | min() parameter could not be converted");
  EXPECT_EQ(call("min", {list({1, 2}), 3}), "undef | min() parameter could not be converted");
}

TEST_F(BuiltinFunctions, MeasureVectors) {
  EXPECT_EQ(call("norm", {list({3, 4})}), "5");
  EXPECT_EQ(call("norm", {list({1, text("a")})}), "undef | Incorrect arguments to norm()");
  EXPECT_EQ(call("norm", {1}), "undef");
  EXPECT_EQ(call("len", {text("aé")}), "2");
  EXPECT_EQ(call("len", {5}), "undef | len() parameter could not be converted");
}

TEST_F(BuiltinFunctions, CrossMultiplies) {
  const Value a = list({1, 2, 3});
  EXPECT_EQ(call("cross", {list({1, 2}), list({3, 4})}), "-2");
  EXPECT_EQ(call("cross", {list({1, 2}), list({text("a"), 4})}), "4");
  EXPECT_EQ(call("cross", {a, list({4, 5, 6})}), "[-3, 6, -3]");
  EXPECT_EQ(call("cross", {a}), "undef | Invalid number of parameters for cross()");
  EXPECT_EQ(call("cross", {a, 3}), "undef | Invalid type of parameters for cross()");
  EXPECT_EQ(call("cross", {a, list({1})}), "undef | Invalid vector size of parameter for cross()");
  EXPECT_EQ(call("cross", {a, list({1, 2, text("a")})}),
            "undef | Invalid value in parameter vector for cross()");
  EXPECT_EQ(call("cross", {a, list({1, kNan, 2})}),
            "undef | Invalid value (NaN) in parameter vector for cross()");
  EXPECT_EQ(call("cross", {a, list({1, kInfinity, 2})}),
            "undef | Invalid value (INF) in parameter vector for cross()");
}

TEST_F(BuiltinFunctions, MakeTexts) {
  EXPECT_EQ(call("str", {1, text("a"), list({text("b")})}), "\"1a[\"b\"]\"");
  EXPECT_EQ(call("chr", {65.9, list({66, list({67})}), make_range(68, 1, 70), text("x")}),
            "\"ABCDEF\"");
  EXPECT_EQ(call("chr", {0, -1, 55296, 1114112, 4294967361.0, 8364}), "\"A€\"");
  EXPECT_EQ(call("chr", {make_range(0, 1, 10000)}),
            "\"\" | Bad range parameter in for statement: too many elements (10001).");
  EXPECT_EQ(call("ord", {text("é")}), "233");
  EXPECT_EQ(call("ord", {text("")}), "undef");
  EXPECT_EQ(call("ord", {text("a"), 1}),
            "undef | ord() called with 2 arguments, only 1 argument expected");
  EXPECT_EQ(call("ord", {list({1})}), "undef | ord() argument [1] is not of type string");
  EXPECT_EQ(call("ord", {text("\xff")}),
            "undef | ord() argument '\xff' is not a valid utf8 string");
}

TEST_F(BuiltinFunctions, Concatenate) {
  EXPECT_EQ(call("concat", {}), "[]");
  EXPECT_EQ(call("concat", {1, list({2, list({3})}), text("a")}), "[1, 2, [3], \"a\"]");
}

TEST_F(BuiltinFunctions, LookUp) {
  const Value table = list({list({1, 2}), text("x"), list({3, 4}), list({3, 9})});
  EXPECT_EQ(call("lookup", {2, table}), "3");
  EXPECT_EQ(call("lookup", {0, table}), "2");
  EXPECT_EQ(call("lookup", {3, table}), "4");
  EXPECT_EQ(call("lookup", {5, table}), "4");
  EXPECT_EQ(call("lookup", {1, list({1})}), "undef");
  EXPECT_EQ(call("lookup", {kNan, table}),
            "undef | lookup(nan, ...) first argument is not a number");
  EXPECT_EQ(evaluated(), 2u);  // the key, twice
}

TEST_F(BuiltinFunctions, Search) {
  const Value table = list({list({text("abc"), 1}), list({text("b"), 2}), list({text("a"), 3})});
  EXPECT_EQ(call("search", {3, list({1, 3, 3})}), "[1]");
  EXPECT_EQ(call("search", {3, list({1, 3, 3}), 0}), "[1, 2]");
  EXPECT_EQ(call("search", {text("ab"), text("abcab"), 0}), "[[0, 3], [1, 4]]");
  EXPECT_EQ(call("search", {text("zb"), text("abcab")}), "[1]");
  EXPECT_EQ(call("search", {text("za"), table, 0}), "[[], [0, 2]] | search term not found: \"z\"");
  EXPECT_EQ(call("search", {list({text("b"), 9}), table}), "[1, []]");
  EXPECT_EQ(call("search", {text("a"), list({text("abc")})}),
            "[] | Invalid entry in search vector at index 0, required number of values in the "
            "entry: 1. Invalid entry: \"abc\"");
  EXPECT_EQ(call("search", {text("a"), list({list({text("a long text of 23 bytes")})})}),
            "[] | search term not found: \"a\"");
  EXPECT_EQ(call("search", {Value(), table}), "undef");
}

TEST_F(BuiltinFunctions, RandomNumbersFollowTheirSeed) {
  EXPECT_EQ(call("rands", {0, 1, 3, 42}), "[0.796543, 0.183435, 0.779691]");
  EXPECT_EQ(call("rands", {0, 1, 2}), "[0.59685, 0.445833]");
  EXPECT_EQ(call("rands", {5, 1, 3, 1}), "[4.98874, 4.73023, 1.5125]");
  EXPECT_EQ(call("rands", {2, 2, 3, 42}), "[2, 2, 2]");
  EXPECT_EQ(call("rands", {0, 1, 1}), "[0.796543]");
  EXPECT_EQ(call("rands", {0, text("a"), 1}), "undef");
  EXPECT_EQ(call("rands", {0, 1, kInfinity, 1}),
            "[0.997185] | rands() cannot create an infinite number of results"
            " | resetting number of results to 1");
}

TEST_F(BuiltinFunctions, SeedsAreNumbersModuloAPrime) {
  const auto first = [&](double seed) { return call("rands", {0, 1, 1, seed}); };
  EXPECT_EQ(first(0.5), "[0.421193]");
  EXPECT_EQ(first(-1), "[0.111607]");
  EXPECT_EQ(first(2147483648.0), first(1));
  EXPECT_EQ(first(1e300), "[0.73142]");
  EXPECT_EQ(first(-1e300), "[0.319918]");
  EXPECT_EQ(first(kInfinity), "[0.0776717]");
  EXPECT_EQ(first(-kInfinity), "[0.458262]");
  EXPECT_EQ(first(0.1), "[0.855521]");
}

TEST_F(BuiltinFunctions, TellFacts) {
  EXPECT_EQ(call("version", {}), "[2021, 1, 0]");
  EXPECT_EQ(call("version_num", {}), "2.02101e+7");
  EXPECT_EQ(call("version_num", {list({2019, 5})}), "2.01905e+7");
  EXPECT_EQ(call("version_num", {list({1})}), "undef");
  EXPECT_EQ(call("is_num", {kNan}), "false");
  EXPECT_EQ(call("is_list", {list({})}), "true");
  EXPECT_EQ(call("is_list", {make_range(0, 1, 2)}), "false");
}

TEST_F(BuiltinFunctions, NameTheModulesOnTheStack) {
  EXPECT_EQ(call("parent_module", {}),
            "undef | Parent module index (1) greater than the number of modules on the stack");
  modules_ = {"outer", "inner"};
  environment_.module_names = modules_;
  EXPECT_EQ(call("parent_module", {}), "\"outer\"");
  EXPECT_EQ(call("parent_module", {0.9}), "\"inner\"");
  EXPECT_EQ(call("parent_module", {-1}), "undef | Negative parent module index (-1) not allowed");
}

}  // namespace
}  // namespace language
