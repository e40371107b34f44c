// Tests rules, as the installed make reads them.
#include "follow/make_rule.hpp"

#include <gmock/gmock.h>

#include <cstdio>
#include <cstdlib>
#include <random>
#include <set>

#include "frontend/error.hpp"
#include "temporary_folder.hpp"

namespace frontend {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(MakeRule, OfPlainNamesIsAsOpenScadWritesIt) {
  EXPECT_EQ(make_rule({"a.png"}, {"/d/b.scad", "c.scad"}), "a.png: \\\n\t/d/b.scad \\\n\tc.scad\n");
  EXPECT_EQ(make_rule({"a.png", "x y.exr"}, {"b c.scad"}), "a.png x\\ y.exr: \\\n\tb\\ c.scad\n");
  EXPECT_EQ(make_rule({"<stdout>"}, {}), "<stdout>:\n");
}

TEST(MakeRule, ThatOpenScadWroteGivesItsNames) {
  EXPECT_THAT(prerequisites_of("a.csg: \\\n\t/b/c\\ d.scad \\\n\te#$:.scad\n"),
              ElementsAre("/b/c d.scad", "e#$:.scad"));
  EXPECT_THAT(prerequisites_of("a.csg: \\\n\tb\nc.scad \\\n\td.scad\n"),
              ElementsAre("b\nc.scad", "d.scad"));
  EXPECT_THAT(prerequisites_of("a.csg:\n"), IsEmpty());
  EXPECT_THAT(prerequisites_of(""), IsEmpty());
}

TEST(MakeRule, NamesThatNoRuleCanHold) {
  const auto error_of = [](const std::string& target, const std::string& prerequisite) {
    try {
      return make_rule({target}, {prerequisite});
    } catch (const Error& error) {
      return std::string(error.what());
    }
  };
  EXPECT_EQ(
      error_of("a\nb.png", "c"),
      "error: no rule for make can name 'a\\nb.png': it has a line break (rename it, or leave "
      "out -d)");
  EXPECT_THAT(error_of("a", "c\n.scad"), HasSubstr("'c\\n.scad': it has a line break"));
  EXPECT_THAT(error_of("a", "design(1)"), HasSubstr("it ends in ')'"));
  EXPECT_THAT(error_of("%[", "a"), HasSubstr("it has both % and a wildcard"));
  EXPECT_THAT(error_of("a", "%["), HasSubstr("a: "));
  EXPECT_THAT(error_of("a(1).png", "b (2).scad"), HasSubstr("b\\ (2).scad"));
}

/// Returns what a makefile that includes the rule of the two targets makes for the first: every
/// prerequisite and the target, each shown as "<NAME>".
std::string made_by_make(const TemporaryFolder& folder, const std::vector<std::string>& targets,
                         const std::vector<std::string>& prerequisites) {
  for (const std::vector<std::string>* names : {&targets, &prerequisites}) {
    for (const std::string& name : *names) folder.write(name, "");
  }
  folder.write("x.d", make_rule(targets, prerequisites));
  folder.write("makefile",
               "include x.d\n%: .FORCE\n\t$(info <$@>)@:\n.FORCE: ;\nx.d makefile: ;\n");
  const std::string command =
      "LC_ALL=C make -k -r -R -s -C '" + folder.path() + "' >'" + folder / "said" + "' 2>&1";
  (void)std::system(command.c_str());
  return folder.read("said");
}

/// All bytes that make, a shell or a programmer may take for special, and some plain letters.
constexpr std::string_view kBytes =
    ":;#$ %\\\t=|&*?[]~({}!\"'`<>@+,-.^\r\v\f\x01"
    "ab\xC3\xA4";

TEST(MakeRule, IsReadByMakeWithTheseVeryNames) {
  if (std::system("command -v make >/dev/null") != 0) GTEST_SKIP() << "no make";
  std::mt19937 random(1);
  const auto any_name = [&random](std::size_t longest) {
    std::string name;
    const std::size_t length = 1 + random() % longest;
    while (name.size() < length) name += kBytes[random() % kBytes.size()];
    return name;
  };
  // make does not by itself take a target with % for its goal.
  const auto any_target = [&](const std::string& first) {
    const std::string name = first + any_name(6);
    return name.find('%') == std::string::npos ? name : first + "%:;=" + first;
  };
  constexpr int kRules = 60;
  for (int i = 0; i < kRules; ++i) {
    const std::string goal = "T" + std::to_string(i) + (i % 2 == 0 ? "; =|*&" : "[?#:\\");
    const std::vector<std::string> targets = {goal, any_target("U") + ".png"};
    std::vector<std::string> prerequisites;
    std::set<std::string> seen = {".", ".."};
    while (prerequisites.size() < 12) {
      const std::string name = any_name(5);
      if (seen.insert(name).second) prerequisites.push_back(name);
    }
    std::string expected;
    for (const std::string& name : prerequisites) expected += '<' + name + ">\n";
    expected += '<' + goal + ">\n";
    const TemporaryFolder folder;
    ASSERT_EQ(made_by_make(folder, targets, prerequisites), expected)
        << make_rule(targets, prerequisites);
  }
}

TEST(MakeRule, EveryByteInEveryPlace) {
  if (std::system("command -v make >/dev/null") != 0) GTEST_SKIP() << "no make";
  for (const char c : std::string(":;#$ %\\\t=|&*?[]~({}\r\v\f")) {
    std::vector<std::string> prerequisites;
    std::string expected;
    for (const char* form : {"_a", "a_b", "_", "a\\_b", "a__b_c", "a_"}) {
      std::string name;
      for (const char* p = form; *p != 0; ++p) name += *p == '_' ? c : *p;
      prerequisites.push_back(name);
      expected += '<' + name + ">\n";
    }
    // With % it would not be a goal by itself.
    const std::string target = c == '%' ? "T" : std::string("T") + c;
    const TemporaryFolder folder;
    EXPECT_EQ(made_by_make(folder, {target}, prerequisites), expected + '<' + target + ">\n")
        << make_rule({target}, prerequisites);
  }
}

}  // namespace
}  // namespace frontend
