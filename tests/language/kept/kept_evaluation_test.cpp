// Random edits of random designs: an evaluation with a cache yields what one without it does.
#include <gtest/gtest.h>

#include <cstdlib>
#include <map>
#include <random>

#include "kept/shown.hpp"
#include "syntax/kept_sources.hpp"

namespace language {
namespace {

class RandomDesign {
 public:
  explicit RandomDesign(uint32_t seed) : random_(seed) {
    for (const char* name : kFiles) files_[name] = file(name);
  }
  void write(const DesignFolder& folder) const {
    for (const auto& [name, text] : files_) folder.write(name, text);
  }
  void edit() {
    std::string& text = files_[kFiles[pick(std::size(kFiles))]];
    switch (pick(6)) {
      case 0:
        text += statement();
        break;
      case 1:
        text = statement() + text;
        break;
      case 2:
        if (!text.empty()) text.erase(pick(text.size()), pick(12));
        break;
      case 3:
        text.insert(pick(text.size() + 1), kPieces[pick(std::size(kPieces))]);
        break;
      default:
        if (const size_t digit = text.find_first_of("0123456789", pick(text.size() + 1));
            digit != text.npos) {
          text[digit] = static_cast<char>('0' + pick(10));
        }
    }
  }

 private:
  static constexpr const char* kFiles[] = {"main.scad", "a.scad", "b.scad", "c.scad", "sub/d.scad"};
  static constexpr const char* kPieces[] = {"\n",
                                            "\r\n",
                                            "// c\n",
                                            "// c",
                                            "use\r\n<c.scad>",
                                            "/* x\n */",
                                            ";",
                                            "}",
                                            "{",
                                            "include <b.scad>\n",
                                            "use <c.scad>\n",
                                            "$x = 3;",
                                            "else",
                                            "\"s\n\"",
                                            "include <sub/d.scad>"};

  size_t pick(size_t count) { return count ? random_() % count : 0; }
  std::string number() { return std::to_string(pick(10)); }
  std::string name() { return std::string(1, static_cast<char>('p' + pick(5))); }

  std::string statement() {
    switch (pick(15)) {
      case 0:
        return name() + " = " + name() + " + " + number() + ";\n";
      case 1:
        return "function " + name() + "(x = 1) = x * " + name() + " + $x;\n";
      case 2:
        return "module " + name() + "(x = " + number() + ") { cube(x + " + name() +
               "); children(); }\n";
      case 3:
        return name() + "(" + number() + ") sphere($x);\n";
      case 4:
        return "if (" + name() + " > 3) cube(" + number() + ");\n";
      case 5:
        return "echo(" + name() + "(" + number() + "), " + name() + ");\n";
      case 6:
        return "include <b.scad>\n";
      case 7:
        return "use <c.scad>\n";
      case 8:
        return "use <sub/d.scad>\n";
      case 9:
        return "{ " + name() + " = 1; cube(" + name() + "); }\n";
      case 10:
        return "$x = " + number() + ";\n";
      case 11:
        return "module " + name() + "() { y = 1; y = 2; for (i = [0:" + number() +
               "]) translate([i, y, 0]) cube(i); }\n";
      case 12:
        return "include <missing.scad>" + std::string(pick(2) ? "\n" : " // c");
      case 13:
        return name() + " = [for (i = [" + number() + ":" + number() + "]) [i, \"t\"]];\n";
      default:
        return name() + " = " + number() + "; // comment\n";
    }
  }
  std::string file(const std::string& name) {
    std::string text = name == "main.scad" ? "include <a.scad>\nuse <c.scad>\n" : "";
    for (size_t count = 2 + pick(8); count > 0; --count) text += statement();
    return text;
  }

  std::mt19937 random_;
  std::map<std::string, std::string> files_;
};

size_t wanted_edits() {
  const char* wanted = std::getenv("SCADRAY_KEPT_EDITS");
  return wanted ? std::stoul(wanted) : 300;
}

TEST(KeptEvaluation, YieldsWhatAFreshOneDoes) {
  constexpr size_t kEditsPerDesign = 20;
  const DesignFolder folder;
  for (size_t edit = 0; edit < wanted_edits();) {
    const auto seed = static_cast<uint32_t>(edit);
    EvaluationCache cache;
    RandomDesign design(seed);
    for (size_t i = 0; i < kEditsPerDesign; ++i, ++edit) {
      design.write(folder);
      expect_same(cache);
      if (HasFailure()) FAIL() << "seed " << seed << ", edit " << i;
      design.edit();
    }
  }
}

TEST(KeptEvaluation, DoesNotGrow) {
  const DesignFolder folder;
  folder.write("lib.scad", "v = 1; module m(x) cube(x);\n");
  EvaluationCache cache;
  size_t most = 0;
  for (int save = 0; save < 2000; ++save) {
    folder.write("main.scad", "use <lib.scad>\nname" + std::to_string(save) + " = 1; m(2);\n");
    shown(&cache);
    most = std::max(most, cache.sources()->size());
  }
  EXPECT_LT(most, 2000u);
}

TEST(KeptEvaluation, TellsZerosApart) {
  const DesignFolder folder;
  folder.write("lib.scad", "inverse = 1 / $x; function f() = inverse;\n");
  folder.write("main.scad", "use <lib.scad>\nlet ($x = 0) echo(f()); let ($x = -0) echo(f());\n");
  EvaluationCache cache;
  EXPECT_EQ(shown(&cache).lines, shown(nullptr).lines);
  EXPECT_EQ(shown(nullptr).lines, (Lines{"ECHO: inf", "ECHO: -inf"}));
}

TEST(KeptEvaluation, StopsAtWarningsInTheSameLine) {
  const DesignFolder folder;
  folder.write("a.scad", "\n\nx = 2;\n");
  folder.write("b.scad", "{\nx = 2;\n\n}\n");
  EvaluationCache cache;
  for (const std::string name : {"a", "b"}) {
    folder.write("main.scad", "include <" + name + ".scad>\n");
    shown(&cache);
    folder.write("main.scad", "x = 1;\ninclude <" + name + ".scad>\n");
    EvaluationOptions options;
    options.hard_warnings = true;
    const auto lines_of = [&](EvaluationCache* kept) {
      Lines lines;
      options.cache = kept;
      evaluate("main.scad", options, [&](std::string_view line) { lines.emplace_back(line); });
      return lines;
    };
    EXPECT_EQ(lines_of(&cache), lines_of(nullptr)) << name;
  }
}

}  // namespace
}  // namespace language
