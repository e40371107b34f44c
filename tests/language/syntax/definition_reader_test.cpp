// Definitions of libraries, whose trees are made when they are asked for.
#include "parsed_design.hpp"
#include "syntax/parse_program.hpp"

namespace language {
namespace {

class ReadDesign : public ParsedDesign {
 public:
  const Scope& scope() const { return *program.units[0].scope; }
  std::string body_of(const FunctionDefinition& function) {
    std::string text;
    append_expression_text(text, *reader_.content_of(function).body, program.names);
    return text;
  }
  const ModuleDefinition::Content& content_of(const ModuleDefinition& module) {
    return reader_.content_of(module);
  }

 private:
  DefinitionReader reader_{program, messages, {}};
};

TEST(DefinitionReader, ReadsWhatHasBeenPreparsed) {
  const DesignFolder folder;
  folder.write("main.scad", "include <lib.scad>\nfunction g() = 1;");
  folder.write(
      "lib.scad",
      "function f(x, y = [1, 2]) = let (z = x) [for (i = y) if (i > z) \"\\\"\\x41\", z];\n"
      "module m(a, b = 3) { c = a; function h() = c; cube(b); sphere(); }\n");
  ReadDesign design;
  const auto& functions = design.scope().functions;
  ASSERT_EQ(functions.size(), 2u);
  EXPECT_FALSE(functions[0].content->body);
  EXPECT_TRUE(functions[1].content->body) << "of the main file";
  EXPECT_EQ(design.body_of(functions[0]), "let(z = x) [for(i = y) (if((i > z)) (\"\\\"A\")), z]");
  const Expression* const body = functions[0].content->body;
  EXPECT_EQ(functions[0].content->parameters.size(), 2u);
  design.body_of(functions[0]);
  EXPECT_EQ(functions[0].content->body, body) << "read once";

  const ModuleDefinition& module = design.scope().modules[0];
  EXPECT_FALSE(module.content->body);
  const auto& content = design.content_of(module);
  EXPECT_EQ(content.parameters.size(), 2u);
  EXPECT_EQ(content.body->assignments.size(), 1u);
  EXPECT_TRUE(content.body->functions[0].content->body);
  EXPECT_EQ(content.body->calls.size(), 2u);
  EXPECT_EQ(design.lines, Lines{});
}

TEST(DefinitionReader, LeavesOutWhatDependsOnMoreThanItsBytes) {
  const DesignFolder folder;
  folder.write("main.scad", "include <lib.scad>\nsphere(); }");
  folder.write("lib.scad",
               "module includes() { include <rest.scad> }\n"
               "module warns() { x = 1;\nx = 2; }\n"
               "module ends_behind() if (true) cube();\n"
               "include <rest.scad>\n"
               "function includes() = include <rest.scad>\n(1);\n"
               "module alone() {}\n"
               "module is_open() { cube();");
  folder.write("rest.scad", "/* nothing */");
  ReadDesign design;
  EXPECT_EQ(design.lines, Lines{"WARNING: x was assigned on line 2 of \"lib.scad\" but was "
                                "overwritten in file lib.scad, line 3"});
  std::vector<bool> are_read;
  for (const ModuleDefinition& module : design.scope().modules)
    are_read.push_back(module.content->body);
  EXPECT_EQ(are_read, (std::vector<bool>{true, true, true, false, true}));
  ASSERT_EQ(design.scope().functions.size(), 1u);
  EXPECT_EQ(design.body_of(design.scope().functions[0]), "1");
  EXPECT_EQ(design.scope().modules[4].content->body->calls.size(), 2u);
}

TEST(DefinitionReader, LeavesOutWhatStandsBehindTheFile) {
  const DesignFolder folder;
  folder.write("main.scad", "use <lib.scad>");
  folder.write("lib.scad", "module m() {}");
  ParseOptions options;
  options.definitions = {"module n() { x = 1; x = 2; }"};
  const ParsedDesign design("main.scad", options);
  const auto& modules = design.program.units[1].scope->modules;
  ASSERT_EQ(modules.size(), 2u);
  EXPECT_FALSE(modules[0].content->body);
  EXPECT_TRUE(modules[1].content->body) << "it would be warned of later";
}

TEST(DefinitionReader, ChangesNoErrorOfALibrary) {
  const DesignFolder folder;
  folder.write("main.scad", "include <lib.scad>");
  const auto lines_with = [&](const std::string& text) {
    folder.write("lib.scad", text);
    return ParsedDesign().lines;
  };
  const auto error = [](const std::string& text, int line) {
    return "ERROR: Parser error: " + text + " in file lib.scad, line " + std::to_string(line);
  };
  EXPECT_EQ(lines_with("module m() {\n cube(;\n}")[0], error("syntax error", 2));
  EXPECT_EQ(lines_with("module m() {\n use <none.scad>\n}")[0],
            "WARNING: Can't open library 'none.scad'.");
  EXPECT_EQ(lines_with("function f() = \"a\\n;\n")[0], error("Unterminated string", 2));
}

}  // namespace
}  // namespace language
