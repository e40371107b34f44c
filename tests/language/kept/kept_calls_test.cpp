// Which calls of modules an evaluation takes over from the one before, and that it shows the same.
#include <gtest/gtest.h>

#include <cstdlib>
#include <random>
#include <set>

#include "evaluation/evaluation_cache.hpp"
#include "kept/shown.hpp"

namespace language {
namespace {

/// Saves versions of a design.
class KeptCallsTest : public testing::Test {
 protected:
  /// Evaluates main.scad. Returns how many calls are those of the evaluation before.
  size_t save(const std::string& text) {
    folder_.write("main.scad", text);
    expect_same(cache_);
    std::set<const KeptCall*> now;
    size_t reused = 0;
    for (const KeptNodes& nodes : cache_.parts().calls.calls) {
      now.insert(nodes.call.get());
      reused += before_.count(nodes.call.get());
    }
    before_ = now;
    return reused;
  }
  size_t kept() const { return before_.size(); }

  DesignFolder folder_;
  EvaluationCache cache_;

 private:
  std::set<const KeptCall*> before_;
};

/// The statements of a body that is worth keeping.
const std::string kMany = "for (i = [1 : 30]) translate([i, 0, 0]) cube(i);";

TEST_F(KeptCallsTest, ACallThatAnEditDoesNotConcernIsTakenOver) {
  const std::string modules =
      "module a() {" + kMany + "}\nmodule b() { sphere(1); " + kMany + "}\n";
  EXPECT_EQ(save(modules + "a(); b(); cube(1);"), 0u);
  EXPECT_EQ(kept(), 2u);
  EXPECT_EQ(save(modules + "a(); b(); cube(2);"), 2u);
  EXPECT_EQ(save("// a line\n" + modules + "\n b(); cube(2);\n a();"), 2u);
  EXPECT_EQ(save("module a() {" + kMany + "}\nmodule b() { sphere(2); " + kMany + "}\na(); b();"),
            1u);
}

TEST_F(KeptCallsTest, AnErrorDoesNotForgetThem) {
  const std::string module = "module a() {" + kMany + "}\n";
  save(module + "a();");
  EXPECT_EQ(save(module + "a(); cube("), 1u);
  EXPECT_EQ(save(module + "a(); assert(false);"), 1u);
  EXPECT_EQ(save(module + "a(); cube(3);"), 1u);
}

TEST_F(KeptCallsTest, TheirArgumentsCount) {
  const std::string module = "module a(x, y = 2) { cube(len(str(x))); cube(y); " + kMany + "}\n";
  save(module + "a(1); a([1, \"t\"]); a(1, y = 0);");
  EXPECT_EQ(save(module + "a(1); a([1, \"t\"]); a(1, y = 0); cube();"), 3u);
  EXPECT_EQ(save(module + "a(2); a([1, \"u\"]); a(1, y = -0);"), 0u);
  EXPECT_EQ(save(module + "a(1, z = 1); a([1, \"u\"]); a(1);"), 1u);
}

TEST_F(KeptCallsTest, WhatTheirCodeReadsCounts) {
  const std::string modules =
      "function f(x) = x + v;\nmodule inner() { cube(f(1)); }\n"
      "module a() { inner(); " +
      kMany + "}\n";
  const std::string calls = "a(); let ($x = 1) a();\n";
  save("v = 1; w = 1;" + modules + calls);
  EXPECT_EQ(save("v = 1; w = 2;" + modules + calls), 2u);
  EXPECT_EQ(save("v = 2; w = 2;" + modules + calls), 0u);
  EXPECT_EQ(save("v = 2; w = 2;function f(x) = x - v;" + modules.substr(23) + calls), 0u);
  EXPECT_EQ(save("v = 2; w = 2; $fn = 9;" + modules + calls), 0u);
  EXPECT_EQ(save("v = 2; w = 2; $y = 9;" + modules + calls), 0u);
}

TEST_F(KeptCallsTest, OnlyTheDynamicVariablesThatAreReadCount) {
  const std::string module = "module a() { cube($x); " + kMany + "}\n";
  save("$x = 1; $y = 1;" + module + "a();");
  EXPECT_EQ(save("$x = 1; $y = 2;" + module + "a();"), 1u);
  EXPECT_EQ(save("$x = 2; $y = 2;" + module + "a();"), 0u);
  EXPECT_EQ(save("$x = 2; $y = 2;" + module + "a($x = 3);"), 0u);
  EXPECT_EQ(save("$x = 3; $y = 2;" + module + "a();"), 1u);
}

TEST_F(KeptCallsTest, NewMeaningsOfNamesCount) {
  const std::string module = "module a() { cube(abs(-3)); " + kMany + "}\n";
  save(module + "a();");
  EXPECT_EQ(save("function abs(x) = x;\n" + module + "a();"), 0u);
  folder_.write("lib.scad", "module cube(x) sphere(x);");
  EXPECT_EQ(save("use <lib.scad>\nfunction abs(x) = x;\n" + module + "a();"), 0u);
  folder_.write("lib.scad", "module cube(x) circle(x);");
  EXPECT_EQ(save("use <lib.scad>\nfunction abs(x) = x;\n" + module + "a();"), 0u);
}

TEST_F(KeptCallsTest, WhatSaysSomethingIsEvaluatedAnew) {
  const std::string modules = "module a() { echo(1); " + kMany + "}\nmodule b() { cube(unknown); " +
                              kMany +
                              "}\n"
                              "module c() { a(); }\nmodule d() { child(0); " +
                              kMany + "}\n";
  for (int i = 0; i < 3; ++i)
    EXPECT_EQ(save(modules + "a(); b(); c(); d(); cube(" + std::to_string(i) + ");"), 0u);
}

TEST_F(KeptCallsTest, WhatDependsOnMoreIsEvaluatedAnew) {
  const std::string modules =
      "module seeded() { cube(rands(0, 1, 1, 3)[0]); " + kMany +
      "}\n"
      "module named() { x = parent_module(1); if (x == \"outer\") cube(); " +
      kMany +
      "}\n"
      "module outer() { named(); }\nmodule other() { named(); }\n"
      "module of_function(f) { cube(f(1)); " +
      kMany +
      "}\n"
      "module of_file() { import(\"missing.stl\"); " +
      kMany +
      "}\n"
      "module of_children() { children(); " +
      kMany +
      "}\n"
      "f = function(x) x;\nmodule of_variable() { cube(f(2)); " +
      kMany +
      "}\n"
      "module tail() { cube(t(3)); " +
      kMany + "}\nfunction t(n, m = $x) = n == 0 ? m : t(n - 1);\n";
  for (int i = 0; i < 3; ++i) {
    const std::string number = std::to_string(i);
    const size_t reused =
        save(modules + "$x = 1; seeded(); of_function(function(x) x + " + number + "); of_file();" +
             "of_children() cube(" + number + "); of_variable(); tail(); outer(); other();");
    EXPECT_EQ(reused, i == 0 ? 0u : 2u);  // outer() and other()
  }
}

TEST_F(KeptCallsTest, CallsWithinOneThatWasTakenOverAreKept) {
  const std::string inner = "module inner(x) { cube(x); " + kMany + "}\n";
  const std::string call = "outer();";
  const auto outer = [](int size) {
    return "module outer() { inner(1); inner(2); cube(" + std::to_string(size) + "); }\n";
  };
  save(inner + outer(1) + call);
  EXPECT_EQ(save(inner + outer(1) + call + "cube();"), 3u);
  EXPECT_EQ(save(inner + outer(2) + call + "cube();"), 2u);
  EXPECT_EQ(save(inner + outer(2) + call + "cube();"), 3u);
}

TEST_F(KeptCallsTest, UsedFilesAreKnownByTheirTexts) {
  const std::string module = "module a() { cube(v); " + kMany + "}\n";
  folder_.write("lib.scad", "v = 1;\n" + module);
  folder_.write("reads.scad", "v = $x;\nmodule b() { cube(v); " + kMany + "}\n");
  const std::string main = "use <lib.scad>\nuse <reads.scad>\n$x = 1; a(); b();";
  save(main);
  EXPECT_EQ(save(main + "cube();"), 1u);  // what b() sees may depend on when it is called
  folder_.write("lib.scad", "v = 2;\n" + module);
  EXPECT_EQ(save(main + "cube();"), 0u);
}

TEST_F(KeptCallsTest, AnIncludeWithinADefinitionCounts) {
  folder_.write("part.scad", "cube(1);");
  const std::string main = "module a() { " + kMany + "\ninclude <part.scad>\n}\na();";
  save(main);
  folder_.write("part.scad", "cube(2);");
  EXPECT_EQ(save(main), 0u);
  EXPECT_EQ(save(main), 0u);
}

TEST_F(KeptCallsTest, InputsCount) {
  const std::string main = "n = 1;\nmodule a() { cube(n); sphere(1 + $t); " + kMany +
                           "}\n"
                           "module b() { cube(2); " +
                           kMany + "}\na(); b();";
  folder_.write("main.scad", main);
  const auto tree_at = [&](double time, EvaluationCache* cache) {
    EvaluationOptions options;
    options.time = time;
    options.definitions = {"n=" + std::to_string(time)};
    options.cache = cache;
    return csg_text(*evaluate("main.scad", options, [](std::string_view) {}).tree);
  };
  for (const double time : {0.0, 0.5, 0.5, 0.0})
    EXPECT_EQ(tree_at(time, &cache_), tree_at(time, nullptr));
}

/// Designs of modules that call each other, in which edits change little.
class RandomModules {
 public:
  explicit RandomModules(uint32_t seed) : random_(seed) {
    for (auto& part : parts_) part = statement();
    library_ = definitions("lib");
  }
  std::string main() {
    std::string text = "use <lib.scad>\n";
    for (const std::string& part : parts_) text += part;
    return text;
  }
  const std::string& library() const { return library_; }
  void edit() {
    std::string& text = pick(8) == 0 ? library_ : parts_[pick(std::size(parts_))];
    if (pick(5) == 0) {
      text = &text == &library_ ? definitions("lib") : statement();
    } else if (pick(5) == 0) {
      text.insert(0, "\n");
    } else if (const size_t digit = text.find_first_of("0123456789", pick(text.size()));
               digit != text.npos) {
      text[digit] = static_cast<char>('0' + pick(10));
    }
  }

 private:
  size_t pick(size_t count) { return random_() % count; }
  std::string number() { return std::to_string(pick(10)); }
  std::string name(char first = 'a', size_t count = 5) {
    return std::string(1, static_cast<char>(static_cast<size_t>(first) + pick(count)));
  }
  std::string value(int depth = 0) {
    switch (pick(depth > 2 ? 4 : 11)) {
      case 0:
      case 1:
        return number();
      case 2:
        return name('u', 3);
      case 3:
        return "$" + name('x', 3);
      case 4:
        return "f" + name() + "(" + value(depth + 1) + ")";
      case 5:
        return "lf(" + value(depth + 1) + ")";
      case 6:
        return "(" + value(depth + 1) + " + " + value(depth + 1) + ")";
      case 7:
        return "rands(0, 9, 1, " + number() + ")[0]";
      case 8:
        return "len([for (k = [0 : " + value(depth + 1) + " % 9]) k])";
      case 9:
        return "(function(q) q + " + value(depth + 1) + ")(" + value(depth + 1) + ")";
      default:
        return "len(str(parent_module(0)))";
    }
  }
  std::string call(int depth) {
    std::string arguments = pick(2) ? value() : "";
    if (pick(4) == 0) arguments += std::string(arguments.empty() ? "" : ", ") + "$x = " + number();
    std::string text = "m" + name() + "(" + arguments + ")";
    if (pick(3) == 0) text = "lm(" + value() + ")";
    if (pick(3) || depth > 2) return text + ";\n";
    return text + " { " + shape(depth + 1) + shape(depth + 1) + "}\n";
  }
  std::string shape(int depth) {
    switch (pick(depth > 2 ? 3 : 12)) {
      case 0:
        return "cube(" + value() + ");\n";
      case 1:
        return "sphere(" + value() + ", $fn = " + number() + ");\n";
      case 2:
        return "cylinder(r = 1, h = " + value() + ");\n";
      case 3:
        return "translate([" + value() + ", 0, 0]) { $z = " + value() + "; " + shape(depth + 1) +
               "}\n";
      case 4:
        return "if (" + value() + " > 4) { " + shape(depth + 1) + "} else " + shape(depth + 1);
      case 5:
        return "for (i = [0 : " + number() + " % 3]) { u = i + " + number() + "; " +
               shape(depth + 1) + "}\n";
      case 6:
        return "children(" + (pick(2) ? number() : "") + ");\n";
      case 7:
        return pick(4) ? "let ($y = " + value() + ") " + shape(depth + 1)
                       : "echo(" + value() + ");\n";
      case 8:
        return "text(str(" + value() + "));\n";
      default:
        return call(depth);
    }
  }
  std::string definitions(const std::string& prefix) {
    const bool reads = pick(3) == 0;
    return "w = " + (reads ? "$y" : number()) + ";\nfunction " + prefix.substr(0, 1) +
           "f(x) = x + w;\n" + "module " + prefix.substr(0, 1) +
           "m(x = 1) { cube(x + w); lcall(x); " + (pick(3) ? "" : "echo(x);") +
           "}\nmodule lcall(n) { for (i = [0 : 9]) sphere(i + n); }\n";
  }
  std::string statement() {
    switch (pick(8)) {
      case 0:
        return name('u', 3) + " = " + number() + ";\n";
      case 1:
        return "$" + name('x', 3) + " = " + number() + ";\n";
      case 2:
        return "function f" + name() + "(x = " + number() + ") = x > 9 ? x : x + " + number() +
               " + u;\n";
      case 3:
      case 4:
        return "module m" + name() + "(n = " + number() + ", $y = " + number() +
               ") { v = n + 1; module inner(o = v) { cube(o + n); " + shape(1) + "}\n" +
               "if ($parts < 1) { $parts = $parts + 1; " + shape(1) + "inner(); " + shape(1) +
               "} }\n";
      default:
        return shape(0);
    }
  }

  std::mt19937 random_;
  std::string parts_[24];
  std::string library_;
};

TEST_F(KeptCallsTest, RandomModulesShowWhatAFreshEvaluationShows) {
  constexpr size_t kEditsPerDesign = 25;
  const char* wanted = std::getenv("SCADRAY_KEPT_EDITS");
  const size_t edits = wanted ? std::stoul(wanted) : 300;
  size_t reused = 0, all = 0;
  for (size_t edit = 0; edit < edits;) {
    const auto seed = static_cast<uint32_t>(edit);
    RandomModules design(seed);
    for (size_t i = 0; i < kEditsPerDesign; ++i, ++edit) {
      folder_.write("lib.scad", design.library());
      reused += save("$parts = 0;\n" + design.main());
      all += kept();
      if (HasFailure()) FAIL() << "seed " << seed << ", edit " << i;
      design.edit();
    }
  }
  EXPECT_GT(reused, all / 4);
}

}  // namespace
}  // namespace language
