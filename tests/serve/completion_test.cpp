#include "builtins.hpp"
#include "client.hpp"
#include "functions/builtin_functions.hpp"
#include "modules/builtin_modules.hpp"

namespace serve {
namespace {

using language::LanguageVersion;
using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

class CompletionTest : public testing::Test {
 protected:
  std::vector<std::string> labels(const std::string& marked) {
    std::vector<std::string> found;
    items_ = client_.ask("completion", folder_ / "a.scad", marked)["items"];
    for (const Json& item : items_) found.push_back(item["label"]);
    return found;
  }
  Json item(const std::string& label) const {
    for (const Json& item : items_)
      if (item["label"] == label) return item;
    return nullptr;
  }
  /// Returns the signature that is shown, with the active parameter in braces.
  std::string signature(const std::string& marked) {
    const Json help = client_.ask("signatureHelp", folder_ / "a.scad", marked);
    if (help.is_null()) return "";
    const Json& shown = help["signatures"][help["activeSignature"].get<std::size_t>()];
    std::string label = shown["label"];
    const std::size_t active = help["activeParameter"];
    if (active >= shown["parameters"].size()) return label;
    const std::string parameter = shown["parameters"][active]["label"];
    return label.replace(label.find(parameter), parameter.size(), "{" + parameter + "}");
  }

  TemporaryFolder folder_;
  Client client_;
  Json items_;
};

TEST(Builtins, AllOfTheLanguageAreDocumented) {
  for (const LanguageVersion version : {LanguageVersion::k2021, LanguageVersion::k2026}) {
    const bool is_new = version == LanguageVersion::k2026;
    for (const auto& function : language::builtin_functions()) {
      if (function.is_experimental && !is_new) continue;
      EXPECT_TRUE(find_builtin(version, BuiltinKind::kFunction, function.name)) << function.name;
    }
    for (const auto& module : language::builtin_modules(version)) {
      const Builtin* const known = find_builtin(version, BuiltinKind::kModule, module.name);
      ASSERT_TRUE(known) << module.name;
      EXPECT_EQ(known->is_deprecated, !module.successor.empty()) << module.name;
    }
    for (const Builtin& builtin : builtins(version)) {
      EXPECT_FALSE(builtin.about.empty()) << builtin.name;
      if (builtin.kind == BuiltinKind::kWord || builtin.kind == BuiltinKind::kVariable) continue;
      EXPECT_TRUE(builtin.signatures.starts_with(std::string(builtin.name) + "(")) << builtin.name;
    }
  }
}

TEST_F(CompletionTest, AStatementBeginsWithAModule) {
  const auto found = labels("module cuboid() {}\nfunction cuber(x) = x;\ncu|\n");
  EXPECT_THAT(found, AllOf(Contains("cube"), Contains("cuboid"), Not(Contains("cuber"))));
  EXPECT_EQ(item("cube")["textEdit"]["newText"], "cube");
  EXPECT_EQ(Client::place(item("cube")["textEdit"]["range"]), "2:0-2:2");
  EXPECT_EQ(item("cube")["detail"], "cube(size = 1, center = false)");
}

TEST_F(CompletionTest, AnExpressionHasFunctionsAndVariables) {
  const auto found = labels(
      "// The width of it.\nwidth = 3;\nmodule wide() {}\nfunction win(a, b = 2) = a;\n"
      "x = wi|;\n");
  EXPECT_THAT(found, AllOf(Contains("width"), Contains("win"), Not(Contains("wide"))));
  EXPECT_EQ(item("win")["detail"], "win(a, b = 2)");
  EXPECT_EQ(item("width")["documentation"]["value"], "The width of it.\n");
}

TEST_F(CompletionTest, NamesAreThoseOfTheirScopes) {
  const auto found = labels(
      "module a(first) { inner = 1; cube(|); }\nmodule b(second) {}\n"
      "z = let(hidden = 1) 2;\n");
  EXPECT_THAT(found, AllOf(Contains("first"), Contains("inner"), Contains("z"),
                           Not(Contains("second")), Not(Contains("hidden"))));
}

TEST_F(CompletionTest, AnArgumentMayHaveAName) {
  EXPECT_THAT(labels("module box(width, height = 2) {}\nbox(1, h|);"), Contains("height"));
  EXPECT_EQ(item("height")["textEdit"]["newText"], "height = ");
  EXPECT_THAT(labels("cylinder(h = 1, r|);"), AllOf(Contains("r1"), Contains("r")));
  EXPECT_THAT(labels("cylinder(h = 1, r = |);"), Not(Contains("r1")));
}

TEST_F(CompletionTest, SpecialVariablesBeginWithDollar) {
  EXPECT_THAT(labels("sphere(1, $f|);"), AllOf(Contains("$fn"), Contains("$fa"), Contains("$fs")));
  EXPECT_EQ(Client::place(item("$fn")["textEdit"]["range"]), "0:10-0:12");
}

TEST_F(CompletionTest, LettersMayBeLeftOut) {
  EXPECT_THAT(labels("trsl|"), ElementsAre("translate"));
  EXPECT_THAT(labels("TRANSL|"), ElementsAre("translate"));
}

TEST_F(CompletionTest, TextsAndNewNamesHaveNone) {
  for (const char* marked : {"// cu|", "/* cu| */", "x = \"cu|\";", "x = \"cu|", "module cu|",
                             "module m(cu|", "function cu|", "x = 12|"}) {
    EXPECT_THAT(labels(marked), IsEmpty()) << marked;
  }
  EXPECT_THAT(labels("/* a */ cu|"), Contains("cube"));
  EXPECT_THAT(labels("x = \"a\"; cu|"), Contains("cube"));
}

TEST_F(CompletionTest, GoesOnAfterASyntaxError) {
  EXPECT_THAT(labels("module mine() {}\nx = ;\ncube([1, 2;\nmi|\nmodule more() {"),
              AllOf(Contains("mine"), Contains("minkowski")));
  EXPECT_THAT(labels("module mine() {}\necho(\"abc);\nmi|\n"), Contains("mine"));
}

TEST_F(CompletionTest, KnowsOtherFiles) {
  folder_.write("lib.scad",
                "lib_size = 1;\nmodule lib_part() {}\nfunction lib_f() = 1;\n"
                "include <deep.scad>\n");
  folder_.write("deep.scad", "lib_deep = 1;\n");
  EXPECT_THAT(labels("include <lib.scad>\nx = lib_|;"),
              AllOf(Contains("lib_size"), Contains("lib_f"), Contains("lib_deep")));
  EXPECT_THAT(labels("use <lib.scad>\nx = lib_|;"), ElementsAre("lib_f"));
  EXPECT_THAT(labels("use <lib.scad>\nlib_|"), ElementsAre("lib_part"));
}

TEST_F(CompletionTest, ListsFilesToInclude) {
  folder_.write("lib.scad", "");
  folder_.write("note.txt", "");
  std::filesystem::create_directory(folder_ / "parts");
  folder_.write("parts/bolt.scad", "");
  EXPECT_THAT(labels("include <|"),
              AllOf(Contains("lib.scad"), Contains("parts/"), Not(Contains("note.txt"))));
  EXPECT_THAT(labels("use <parts/b|>"), ElementsAre("bolt.scad"));
  EXPECT_EQ(Client::place(item("bolt.scad")["textEdit"]["range"]), "0:11-0:12");
}

TEST_F(CompletionTest, MembersAreAxes) { EXPECT_THAT(labels("v = [1]; x = v.|"), Contains("z")); }

TEST_F(CompletionTest, TheNewLanguageHasMore) {
  EXPECT_THAT(labels("roo|"), Not(Contains("roof")));
  Client client(LanguageVersion::k2026);
  const Json found = client.ask("completion", folder_ / "a.scad", "roo|");
  EXPECT_TRUE(std::ranges::any_of(found["items"],
                                  [](const Json& item) { return item["label"] == "roof"; }));
}

TEST_F(CompletionTest, ASignatureHasItsActiveParameter) {
  EXPECT_EQ(signature("cube(|"), "cube({size = 1}, center = false)");
  EXPECT_EQ(signature("cube([1, 2, 3], |"), "cube(size = 1, {center = false})");
  EXPECT_EQ(signature("cylinder(r1 = |"), "cylinder(h, {r1}, r2, center = false)");
  EXPECT_EQ(signature("translate([1, |"), "translate({v}) { … }");
  EXPECT_EQ(signature("x = pow(max(1, 2), |"), "pow(base, {exponent})");
  EXPECT_EQ(signature("x = pow(max(1, |"), "max(a, {b}, …)");
  EXPECT_EQ(signature("function f(a, b = [1, 2]) = a;\nx = f(1, |);"), "f(a, {b = [1, 2]})");
  EXPECT_EQ(signature("f = function (a, b) a;\nx = f(1, |);"), "f(a, {b})");
  EXPECT_EQ(signature("module m(a) {}\nm(1, |);"), "m(a)");
  EXPECT_EQ(signature("cube(1);|"), "");
  EXPECT_EQ(signature("none(|"), "");
}

}  // namespace
}  // namespace serve
