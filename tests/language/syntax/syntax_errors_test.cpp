#include "parsed_design.hpp"

namespace language {
namespace {

Lines syntax_error(int line) {
  return {"ERROR: Parser error: syntax error in file <stdin>, line " + std::to_string(line),
          "Can't parse file '<stdin>'!", ""};
}

TEST(SyntaxErrors, StandWhereOpenScadSeesThem) {
  const std::vector<std::pair<std::string, int>> rows = {
      {"x=1 2;", 1},
      {"\n\nx=f(,);", 3},
      {"x=f(1,,);", 1},
      {"x=[,1];", 1},
      {"x=[(for(i=1) i)];", 1},
      {"x=[1,((for(i=1) i))];", 1},
      {"x=[assert(true) for(i=1) i];", 1},
      {"x=1?2;", 1},
      {"x=1e400;", 1},
      {"x=1..5;", 1},
      {"x=1.5x;", 1},
      {"a$b=1;", 1},
      {"$ =1;", 1},
      {"x=1;\n\x0cy=2;", 2},
      {"é", 1},
      {"if(1) a=1;", 1},
      {"cube() { module m() {} }", 1},
      {"cube() \n", 3},  // the byte behind the file is no child
      {"let=1;", 1},
      {"module if() {}", 1},
      {"x=\"a\nb\nc\" \"d\n\ne\";", 5},
      {"/* \n */ x=1\r\n\r\n}", 4},
      {"#{}", 1},
      {"x=a.if;", 1},
  };
  for (const auto& [text, line] : rows)
    EXPECT_EQ(parse_text(text).lines, syntax_error(line)) << text;
}

TEST(SyntaxErrors, EndChainsOfCalls) {
  const auto lines_of = [](int calls) {
    std::string text = "x=f";
    for (int i = 0; i < calls; ++i) text += "()";
    return parse_text(text + ";").lines;
  };
  EXPECT_EQ(lines_of(20'000), Lines{});
  ASSERT_FALSE(lines_of(20'001).empty());
  EXPECT_EQ(lines_of(20'001)[0], "ERROR: Parser error: memory exhausted in file <stdin>, line 1");
}

TEST(SyntaxErrors, AreNone) {
  for (const std::string text :
       {"", ";", "{}", "module m()", "module m() function f(a,)=1;", "0x10=1;2x=1e5;",
        "use=1;include=2;", "f(,1);", "cube() {;{}};", "!#%*if(1) cube(); else {a=1;}", "each(1);",
        "x=5 .x;", "module m(,a,,b=1,){}", "\xC2\xA0\xA0x=1;", "\xEF\xBB\xBFx=1;", "x=[1,1e400,2];",
        "x=1;\xE9 (((", "echo(1) assert(true) for(i=1) let(a=1) cube();"}) {
    EXPECT_EQ(parse_text(text).lines, Lines{}) << text;
  }
}

TEST(SyntaxErrors, TellWhatIsNotTerminated) {
  for (const auto& [text, what] :
       std::vector<std::pair<std::string, std::string>>{{"x=\"a", "string, line 4"},
                                                        {"/* *", "comment, line 4"},
                                                        {"include <a", "include statement, line 1"},
                                                        {"use <a\n", "use statement, line 1"}}) {
    const size_t comma = what.find(',');
    const Lines lines = parse_text(text + (what.back() == '4' ? "\n" : "")).lines;
    ASSERT_EQ(lines.size(), 4u) << text;
    EXPECT_EQ(lines[0], "ERROR: Parser error: Unterminated " + what.substr(0, comma) +
                            " in file <stdin>" + what.substr(comma));
  }
}

std::string repeated(const std::string& text, int count) {
  std::string all;
  for (int i = 0; i < count; ++i) all += text;
  return all;
}

TEST(SyntaxErrors, EndDeepNesting) {
  constexpr int kDeep = 19'900;
  EXPECT_EQ(parse_text("x=" + repeated("(", kDeep) + "1" + repeated(")", kDeep) + ";").lines,
            Lines{});
  for (const std::string part :
       {"(", "[", "-", "f(", "2^", "1?", "let(a=1) ", "1+(", "function(a) "}) {
    const Lines lines = parse_text("x=" + repeated(part, 100'000)).lines;
    ASSERT_FALSE(lines.empty()) << part;
    EXPECT_EQ(lines[0], "ERROR: Parser error: memory exhausted in file <stdin>, line 1") << part;
  }
  for (const std::string part : {"{", "if(1) ", "#", "cube() ", "cube(){", "module m() "}) {
    const Lines lines = parse_text(repeated(part, 100'000)).lines;
    ASSERT_FALSE(lines.empty()) << part;
    EXPECT_EQ(lines[0], "ERROR: Parser error: memory exhausted in file <stdin>, line 1") << part;
  }
}

TEST(SyntaxErrors, NeedAReadableFile) {
  const ParsedDesign design("/no such file.scad");
  EXPECT_EQ(design.outcome, ParseOutcome::kUnreadable);
  EXPECT_EQ(design.lines, (Lines{"Can't open input file '/no such file.scad'!", ""}));
}

}  // namespace
}  // namespace language
