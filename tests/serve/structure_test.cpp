#include "client.hpp"

namespace serve {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

class Structure : public testing::Test {
 protected:
  Json ask(const std::string& method, const std::string& text) {
    return client_.ask(method, folder_ / "a.scad", text);
  }
  static void append(std::vector<std::string>& lines, const Json& symbols, std::string indent) {
    for (const Json& symbol : symbols) {
      lines.push_back(indent + symbol["name"].get<std::string>() + symbol.value("detail", "") +
                      " " + Client::place(symbol["range"]));
      append(lines, symbol.value("children", Json::array()), indent + "  ");
    }
  }
  std::vector<std::string> symbols(const std::string& text) {
    std::vector<std::string> lines;
    append(lines, ask("documentSymbol", text), "");
    return lines;
  }
  std::vector<std::string> folds(const std::string& text) {
    std::vector<std::string> lines;
    for (const Json& fold : ask("foldingRange", text))
      lines.push_back(std::to_string(fold["startLine"].get<int>()) + "-" +
                      std::to_string(fold["endLine"].get<int>()) + fold.value("kind", ""));
    return lines;
  }
  std::vector<std::string> colors(const std::string& text) {
    std::vector<std::string> lines;
    for (const Json& found : ask("documentColor", text)) {
      std::string line = Client::place(found["range"]);
      for (const char* channel : {"red", "green", "blue", "alpha"})
        line += " " + std::to_string(found["color"][channel].get<double>()).substr(0, 4);
      lines.push_back(line);
    }
    return lines;
  }

  TemporaryFolder folder_;
  Client client_;
};

TEST_F(Structure, SymbolsNestAsModulesDo) {
  EXPECT_THAT(symbols("a = 1;\nmodule m(x, y) {\n  b = 2;\n  function f(z) = z;\n"
                      "  translate(x) { c = 3; cube(c); }\n}\nfunction g() = 1;\nm() { d = 4; }\n"),
              ElementsAre("a 0:0-0:6", "m(x, y) 1:0-5:1", "  b 2:2-2:8", "  f(z) 3:2-3:20",
                          "  c 4:17-4:23", "g 6:0-6:17", "d 7:6-7:12"));
}

TEST_F(Structure, SymbolsOutliveSyntaxErrors) {
  EXPECT_THAT(symbols("x = ;\nmodule m( {\ncube([1, 2);\nmodule n() { y = \n}\nz = 3;\n"),
              testing::Contains(testing::HasSubstr("z 5:0")));
}

TEST_F(Structure, FoldsBracketsCommentsAndIncludes) {
  EXPECT_THAT(folds("include <a.scad>\nuse <b.scad>\n\n// one\n// two\nmodule m() {\n  x = [\n"
                    "    1];\n}\n/* a\n b */\ncube(\n);\n"),
              ElementsAre("0-1imports", "3-4comment", "5-7", "9-10comment"));
  EXPECT_THAT(folds("module m() { }\nx = [1,\n"), IsEmpty());
}

TEST_F(Structure, FindsColors) {
  EXPECT_THAT(colors("color(\"red\") cube();\ncolor([0, 0.5, 1]) cube();\n"
                     "color(c = \"#0f0\", alpha = 0.5) cube();\ncolor([1, 1, 1, 0.25], 1) cube();\n"
                     "color(x) color(\"none\") color([1, a, 0]) cube(); // color(\"red\")\n"),
              ElementsAre("0:6-0:11 1.00 0.00 0.00 1.00", "1:6-1:17 0.00 0.50 1.00 1.00",
                          "2:10-2:16 0.00 1.00 0.00 0.50", "3:6-3:21 1.00 1.00 1.00 1.00"));
}

TEST_F(Structure, SpellsColorsAsTheyStand) {
  const auto spelled = [&](const char* text, int begin, int end, double alpha) {
    ask("documentColor", text);
    const Json found =
        client_.request("textDocument/colorPresentation",
                        {{"textDocument", {{"uri", uri_of_path(folder_ / "a.scad")}}},
                         {"color", {{"red", 1}, {"green", 0.5}, {"blue", 0}, {"alpha", alpha}}},
                         {"range",
                          {{"start", {{"line", 0}, {"character", begin}}},
                           {"end", {{"line", 0}, {"character", end}}}}}});
    std::vector<std::string> labels;
    for (const Json& one : found) labels.push_back(one["label"]);
    return labels;
  };
  EXPECT_THAT(spelled("color(\"red\") cube();", 6, 11, 1),
              ElementsAre("\"#ff8000\"", "[1, 0.5, 0]"));
  EXPECT_THAT(spelled("color([1, 0, 0]) cube();", 6, 15, 0.5),
              ElementsAre("[1, 0.5, 0, 0.5]", "\"#ff800080\""));
}

}  // namespace
}  // namespace serve
