#include "client.hpp"

namespace serve {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class Navigation : public testing::Test {
 protected:
  std::string hover(const std::string& marked) {
    const std::string path = folder_ / "a.scad";
    client_.open(path, Marked(marked).text);
    client_.settle();
    Json params = {{"textDocument", {{"uri", uri_of_path(path)}}},
                   {"position", json_of_position(Marked(marked).position)}};
    const Json found = client_.request("textDocument/hover", params);
    return found.is_null() ? "" : found["contents"]["value"].get<std::string>();
  }
  /// Returns places as "a.scad 1:2-1:3", sorted.
  std::vector<std::string> places(const Json& locations) const {
    std::vector<std::string> list;
    for (const Json& location : locations) {
      const std::string path = path_of_uri(location["uri"].get<std::string>());
      list.push_back(std::filesystem::path(path).filename().string() + " " +
                     Client::place(location["range"]));
    }
    std::ranges::sort(list);
    return list;
  }
  std::vector<std::string> definition(const std::string& marked) {
    return places(client_.ask("definition", folder_ / "a.scad", marked));
  }
  std::vector<std::string> references(const std::string& marked, bool with_definition = true) {
    return places(client_.ask("references", folder_ / "a.scad", marked,
                              {{"context", {{"includeDeclaration", with_definition}}}}));
  }
  /// Returns the texts of all files after a rename, one after another; of a failure, its message.
  std::string rename(const std::string& marked, const std::string& name) {
    const Json found = client_.ask("rename", folder_ / "a.scad", marked, {{"newName", name}});
    if (found.contains("message")) return found["message"];
    std::map<std::string, std::string> texts = {
        {uri_of_path(folder_ / "a.scad"), Marked(marked).text}};
    std::string all;
    for (const auto& [uri, edits] : found["changes"].items()) {
      if (!texts.contains(uri))
        texts[uri] = folder_.read(std::filesystem::path(path_of_uri(uri)).filename());
    }
    for (auto& [uri, bytes] : texts) {
      const Text text(bytes);
      std::map<uint32_t, uint32_t, std::greater<>> spans;
      for (const Json& edit : found["changes"].value(uri, Json::array())) {
        const Range range = range_of(edit["range"]);
        spans[text.offset_of(range.start, PositionEncoding::kUtf16)] =
            text.offset_of(range.end, PositionEncoding::kUtf16);
      }
      for (const auto& [begin, end] : spans) bytes.replace(begin, end - begin, name);
      all += bytes;
    }
    return all;
  }

  TemporaryFolder folder_;
  Client client_{language::LanguageVersion::k2021, Json::object(), folder_.path()};
};

TEST_F(Navigation, HoverShowsSignatureAndComment) {
  EXPECT_EQ(hover("// A box.\n//   of wood\nmodule box(w, h = [1,\n  2]) { cube(w); }\n\nb|ox(1);"),
            "```scad\nmodule box(w, h = [1, 2])\n```\n\nA box.\nof wood\n");
  EXPECT_EQ(hover("/* Adds. */\nfunction add(a) = a;\nx = |add(1);"),
            "```scad\nfunction add(a)\n```\n\nAdds.\n");
  EXPECT_EQ(hover("y = 1; // of y\nmodule m() {}\nm|();"), "```scad\nmodule m()\n```\n");
  EXPECT_EQ(hover("// far\n\nmodule m() {}\nm|();"), "```scad\nmodule m()\n```\n");
}

TEST_F(Navigation, HoverShowsTheValueOfAConstant) {
  EXPECT_EQ(hover("a = 2;\nb = a * [1, 2];\ncube(b|);"),
            "```scad\nb = a * [1, 2]\n// = [2, 4]\n```\n");
  EXPECT_EQ(hover("a| = 2;\n"), "```scad\na = 2\n```\n");
  EXPECT_EQ(hover("v| = [for (i = [1 : 100]) i];"),
            "```scad\nv = [for (i = [1 : 100]) i]\n// = vector of 100 elements\n```\n");
  EXPECT_EQ(hover("$fn = 5 * 4;\nsphere($f|n);"), "```scad\n$fn = 5 * 4\n// = 20\n```\n");
}

TEST_F(Navigation, HoverShowsBuiltins) {
  EXPECT_THAT(hover("cu|be(1);"), HasSubstr("cube(size = 1, center = false)"));
  EXPECT_THAT(hover("x = s|in(1);"), HasSubstr("sin(degrees)"));
  EXPECT_THAT(hover("x = PI|;"), HasSubstr("PI = 3.14159"));
  EXPECT_THAT(hover("sphere(1, $fn| = 3);"), HasSubstr("number of facets"));
  EXPECT_THAT(hover("i|f (true) cube();"), HasSubstr("if (condition)"));
  EXPECT_EQ(hover("x = \"cu|be\";"), "");
  EXPECT_EQ(hover("none|();"), "");
}

TEST_F(Navigation, ADefinitionMayHideABuiltin) {
  EXPECT_THAT(definition("module cube() {}\ncu|be();"), ElementsAre("a.scad 0:7-0:11"));
  EXPECT_THAT(definition("cu|be();"), IsEmpty());
}

TEST_F(Navigation, NamesMeanWhatTheirScopesSay) {
  EXPECT_THAT(definition("a = 1;\nmodule m(a) { cube(|a); }"), ElementsAre("a.scad 1:9-1:10"));
  EXPECT_THAT(definition("a = 1;\nmodule m(b) { cube(|a); }"), ElementsAre("a.scad 0:0-0:1"));
  EXPECT_THAT(definition("module m(b = 1) {}\nm(|b = 2);"), ElementsAre("a.scad 0:9-0:10"));
  EXPECT_THAT(definition("x = let(a = 1) a + |a;"), ElementsAre("a.scad 0:8-0:9"));
  EXPECT_THAT(definition("a = 1;\nx = [let(a = 2) a, |a];"), ElementsAre("a.scad 0:0-0:1"));
  EXPECT_THAT(definition("x = [for (i = [0 : 3]) if (i > 1) |i else 0];"),
              ElementsAre("a.scad 0:10-0:11"));
  EXPECT_THAT(definition("for (i = [0 : 3]) { j = i; cube(|j); }"),
              ElementsAre("a.scad 0:20-0:21"));
  EXPECT_THAT(definition("f = function (n) n < 1 ? 0 : |f(n - 1);"), ElementsAre("a.scad 0:0-0:1"));
  EXPECT_THAT(definition("function f(x) = x;\nf = 1;\ny = |f(2);"), ElementsAre("a.scad 1:0-1:1"));
  // An assignment reads what is around it.
  EXPECT_THAT(definition("a = 1;\nmodule m() { a = |a + 1; cube(a); }"),
              ElementsAre("a.scad 0:0-0:1"));
  EXPECT_THAT(definition("a = 1;\nx = let(a = |a + 1) a;"), ElementsAre("a.scad 0:0-0:1"));
}

TEST_F(Navigation, DefinitionsStandInOtherFiles) {
  folder_.write("lib.scad", "lib_a = 1;\nmodule lib_m() {}\ninclude <deep.scad>\n");
  folder_.write("deep.scad", "function deep() = 1;\n");
  EXPECT_THAT(definition("use <lib.scad>\nlib|_m();"), ElementsAre("lib.scad 1:7-1:12"));
  EXPECT_THAT(definition("use <lib.scad>\nx = lib|_a;"), IsEmpty());
  EXPECT_THAT(definition("include <lib.scad>\nx = lib|_a;"), ElementsAre("lib.scad 0:0-0:5"));
  EXPECT_THAT(definition("include <lib.scad>\nx = de|ep();"), ElementsAre("deep.scad 0:9-0:13"));
  EXPECT_THAT(definition("include <li|b.scad>"), ElementsAre("lib.scad 0:0-0:0"));
  EXPECT_THAT(definition("include <no|ne.scad>"), IsEmpty());
}

TEST_F(Navigation, AClosedFileIsReadAsItWasSaved) {
  // A file that has not changed for long, so that it is not read without need.
  const std::string file = std::filesystem::canonical(SCADRAY_EXAMPLES_DIR) / "bolt.scad";
  const std::string marked = "use <" + file + ">\nth|read();";
  const auto saved = definition(marked);
  EXPECT_EQ(saved.size(), 1u);
  client_.open(file, "module thread() {}\n");
  EXPECT_THAT(definition(marked), ElementsAre("bolt.scad 0:7-0:13"));
  client_.close(file);
  EXPECT_EQ(definition(marked), saved);
}

TEST_F(Navigation, AnIncludedFileKnowsWhatStandsAroundIt) {
  client_.open(folder_ / "main.scad", "width = 3;\ninclude <a.scad>\n");
  EXPECT_THAT(definition("cube(wid|th);"), ElementsAre("main.scad 0:0-0:5"));
}

TEST_F(Navigation, ReferencesAreFoundInAllFiles) {
  folder_.write("lib.scad", "function twice(x) = 2 * x;\nself = twice(1);\n");
  folder_.write("other.scad", "use <lib.scad>\nb = twice(2);\nmodule twice() {}\n");
  EXPECT_THAT(references("use <lib.scad>\na = tw|ice(3); // twice\nc = twice;\n"),
              ElementsAre("a.scad 1:4-1:9", "lib.scad 0:9-0:14", "lib.scad 1:7-1:12",
                          "other.scad 1:4-1:9"));
  EXPECT_THAT(references("use <lib.scad>\na = tw|ice(3);\n", false),
              ElementsAre("a.scad 1:4-1:9", "lib.scad 1:7-1:12", "other.scad 1:4-1:9"));
}

TEST_F(Navigation, ReferencesOfLocalNamesStayInTheirScope) {
  EXPECT_THAT(
      references("x = 1;\nmodule m(|x) { cube(x); *sphere(x); }\nm(x = x);\n"),
      ElementsAre("a.scad 1:19-1:20", "a.scad 1:31-1:32", "a.scad 1:9-1:10", "a.scad 2:2-2:3"));
}

TEST_F(Navigation, RenamesAVariable) {
  EXPECT_EQ(rename("w| = 1;\nmodule m(w) { cube(w); }\nm(w = w); *cube(w);\nw = 2;", "width"),
            "width = 1;\nmodule m(w) { cube(w); }\nm(w = width); *cube(width);\nwidth = 2;");
  EXPECT_EQ(rename("module m(|w = 1) { cube(w); }\nm(w = 3);\nw = 2;", "width"),
            "module m(width = 1) { cube(width); }\nm(width = 3);\nw = 2;");
  EXPECT_EQ(rename("module m() { x = $|s; }\nm($s = 1);", "$t2"),
            "module m() { x = $t2; }\nm($t2 = 1);");
}

TEST_F(Navigation, RenamesAcrossFiles) {
  folder_.write("b.scad", "include <a.scad>\nold();\n");
  EXPECT_EQ(rename("module o|ld() {}\n/* old */ old();\n", "fresh"),
            "module fresh() {}\n/* old */ fresh();\ninclude <a.scad>\nfresh();\n");
}

TEST_F(Navigation, RefusesARenameThatCannotBe) {
  EXPECT_THAT(rename("cu|be();", "x"), HasSubstr("OpenSCAD's own"));
  EXPECT_THAT(rename("sphere($f|n = 3);", "$x"), HasSubstr("OpenSCAD's own"));
  EXPECT_THAT(rename("a = n|one;", "x"), HasSubstr("nothing here defines none"));
  EXPECT_THAT(rename("a = |1;", "x"), HasSubstr("no name here"));
  for (const char* name : {"1a", "a b", "", "$", "for", "ä"})
    EXPECT_THAT(rename("a| = 1;", name), HasSubstr("is no name")) << name;
  EXPECT_THAT(rename("a| = 1;", "$a"), HasSubstr("has a $"));
  EXPECT_THAT(rename("$a| = 1;", "a"), HasSubstr("lacks the $"));
  EXPECT_THAT(rename("a| = 1; b = 2;", "b"), HasSubstr("has a meaning"));
  const TemporaryFolder elsewhere;
  const std::string lib = elsewhere.write("lib.scad", "module far() {}\n");
  EXPECT_THAT(rename("use <" + lib + ">\nf|ar();", "x"), HasSubstr("no file of the open folders"));
}

TEST_F(Navigation, PreparesARename) {
  const Json found = client_.ask("prepareRename", folder_ / "a.scad", "width = 1; cube(wi|dth);");
  EXPECT_EQ(found["placeholder"], "width");
  EXPECT_EQ(Client::place(found["range"]), "0:16-0:21");
  EXPECT_EQ(client_.ask("prepareRename", folder_ / "a.scad", "cu|be();")["code"], -32803);
}

}  // namespace
}  // namespace serve
