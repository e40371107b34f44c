#include "outline.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

#include "syntax/parse_program.hpp"

namespace serve {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

Outline outline_of(const std::string& text) {
  return serve::outline_of(std::make_shared<const Text>(text));
}

std::vector<std::string> words(const std::string& text) {
  std::vector<std::string> list;
  for (const Token& token : tokens_of(text))
    list.push_back(text.substr(token.span.begin, token.span.end - token.span.begin));
  return list;
}

TEST(Tokens, AreThoseOfTheLanguage) {
  EXPECT_THAT(words("a<=1.5e3x//c\n/*d\n*/\"e\\\"f\"$g include <h i> use<j>include"),
              ElementsAre("a", "<=", "1.5e3", "x", "//c", "/*d\n*/", "\"e\\\"f\"", "$g",
                          "include <h i>", "use<j>", "include"));
  EXPECT_THAT(words("1.x 2b 0x1F .5 a.b 1e+ \xC2\xA0@"),
              ElementsAre("1.", "x", "2b", "0x1F", ".5", "a", ".", "b", "1e", "+", "@"));
}

TEST(Tokens, AStringWithoutEndEndsWithItsLine) {
  EXPECT_THAT(words("a = \"b;\nc = \"d\";"), ElementsAre("a", "=", "\"b;", "c", "=", "\"d\"", ";"));
  EXPECT_THAT(words("a = \"b\\"), ElementsAre("a", "=", "\"b\\"));
  EXPECT_THAT(words("include <a\nb"), ElementsAre("include <a", "b"));
  EXPECT_THAT(words("/* a"), ElementsAre("/* a"));
}

/// Everything that a text defines and refers to, as "kind name@offset".
using Facts = std::set<std::string>;

void add(Facts& facts, const char* kind, std::string_view name, uint32_t offset) {
  facts.insert(std::string(kind) + " " + std::string(name) + "@" + std::to_string(offset));
}

Facts facts_of(const Outline& outline) {
  Facts facts;
  for (const Definition& made : outline.definitions) {
    const char* const kind = made.kind == SymbolKind::kModule      ? "module"
                             : made.kind == SymbolKind::kFunction  ? "function"
                             : made.kind == SymbolKind::kParameter ? "parameter"
                                                                   : "variable";
    add(facts, kind, made.name, made.name_span.begin);
  }
  for (const Reference& reference : outline.references) {
    const char* const kind = reference.kind == ReferenceKind::kModule     ? "instance"
                             : reference.kind == ReferenceKind::kArgument ? "argument"
                                                                          : "read";
    add(facts, kind, reference.name, reference.span.begin);
  }
  return facts;
}

/// The same of a syntax tree.
class TreeFacts {
 public:
  TreeFacts(const std::string& path, const std::string& text)
      : messages_(program_.files, [](const language::Message&) {}) {
    language::ParseOptions options;
    options.text = text;
    is_parsed =
        parse_program(program_, messages_, path, options) == language::ParseOutcome::kParsed;
    if (is_parsed) read(*program_.units[0].scope);
  }

  Facts facts;
  bool is_parsed = false;

 private:
  void note(const char* kind, language::Name name, language::Place place) {
    // The files that it includes are not in the outline.
    if (place.file == 0) add(facts, kind, program_.names.text(name), place.offset);
  }
  /// Notes a definition, whose name is the second word behind its begin.
  void note_definition(const char* kind, language::Name name, language::Place place,
                       uint32_t begin) {
    if (place.file != 0) return;
    const std::string_view text = program_.files[0].text;
    const std::string_view word = program_.names.text(name);
    std::size_t at = text.find_first_of(" \t\r\n/", begin);
    for (const Token& token : tokens_of(text.substr(at))) {
      if (token.kind == TokenKind::kComment) continue;
      add(facts, kind, word, static_cast<uint32_t>(at + token.span.begin));
      return;
    }
  }

  void read(const language::Scope& scope) {
    for (const language::Assignment& made : scope.assignments) {
      note("variable", made.name, made.place);
      read(made.value);
    }
    for (const language::FunctionDefinition& made : scope.functions) {
      note_definition("function", made.name, made.place, made.begin);
      if (made.place.file != 0) continue;
      read(made.content->parameters);
      read(made.content->body);
    }
    for (const language::ModuleDefinition& made : scope.modules) {
      note_definition("module", made.name, made.place, made.begin);
      if (made.place.file != 0) continue;
      read(made.content->parameters);
      read(*made.content->body);
    }
    for (const language::ModuleCall& call : scope.calls) {
      if (call.name != language::kNoName) note("instance", call.name, call.place);
      read(call.condition);
      const std::string_view name =
          call.name == language::kNoName ? "" : program_.names.text(call.name);
      read(call.arguments,
           name == "for" || name == "let" || name == "intersection_for" || name == "assign");
      read(*call.children);
      if (call.else_children) read(*call.else_children);
    }
  }
  void read(std::span<const language::Parameter> parameters) {
    for (const language::Parameter& parameter : parameters) {
      note("parameter", parameter.name, parameter.place);
      read(parameter.value);
    }
  }
  void read(std::span<const language::Argument> arguments, bool defines) {
    for (const language::Argument& argument : arguments) {
      if (argument.name != language::kNoName)
        note(defines ? "variable" : "argument", argument.name, argument.place);
      read(argument.value);
    }
  }
  void read(const language::Expression* expression) {
    using language::as;
    using Kind = language::ExpressionKind;
    if (!expression) return;
    switch (expression->kind) {
      case Kind::kUndef:
      case Kind::kBool:
      case Kind::kNumber:
      case Kind::kString:
        return;
      case Kind::kVariable:
        return note("read", as<language::VariableExpression>(*expression).name, expression->place);
      case Kind::kUnary:
        return read(as<language::UnaryExpression>(*expression).operand);
      case Kind::kBinary:
        read(as<language::BinaryExpression>(*expression).left);
        return read(as<language::BinaryExpression>(*expression).right);
      case Kind::kTernary:
        read(as<language::TernaryExpression>(*expression).condition);
        read(as<language::TernaryExpression>(*expression).then_value);
        return read(as<language::TernaryExpression>(*expression).else_value);
      case Kind::kIndex:
        read(as<language::IndexExpression>(*expression).container);
        return read(as<language::IndexExpression>(*expression).index);
      case Kind::kMember:
        return read(as<language::MemberExpression>(*expression).container);
      case Kind::kCall:
        read(as<language::CallExpression>(*expression).callee);
        return read(as<language::CallExpression>(*expression).arguments, false);
      case Kind::kVector:
        for (const auto* element : as<language::VectorExpression>(*expression).elements)
          read(element);
        return;
      case Kind::kRange:
        read(as<language::RangeExpression>(*expression).begin);
        read(as<language::RangeExpression>(*expression).step);
        return read(as<language::RangeExpression>(*expression).end);
      case Kind::kFunction:
        read(as<language::FunctionExpression>(*expression).parameters);
        return read(as<language::FunctionExpression>(*expression).body);
      case Kind::kLet:
      case Kind::kFor:
      case Kind::kAssert:
      case Kind::kEcho: {
        const bool defines = expression->kind == Kind::kLet || expression->kind == Kind::kFor;
        read(as<language::BodyExpression>(*expression).arguments, defines);
        return read(as<language::BodyExpression>(*expression).body);
      }
      case Kind::kForC:
        read(as<language::ForCExpression>(*expression).init, true);
        read(as<language::ForCExpression>(*expression).condition);
        read(as<language::ForCExpression>(*expression).increment, true);
        return read(as<language::ForCExpression>(*expression).body);
      case Kind::kIf:
        read(as<language::IfExpression>(*expression).condition);
        read(as<language::IfExpression>(*expression).then_element);
        return read(as<language::IfExpression>(*expression).else_element);
      case Kind::kEach:
        return read(as<language::EachExpression>(*expression).element);
    }
  }

  language::Program program_;
  language::Messages messages_;
};

/// What the tree does not hold: the words of expressions that are called like functions.
Facts without_words(Facts facts) {
  std::erase_if(facts, [](const std::string& fact) {
    return fact.starts_with("read assert@") || fact.starts_with("read echo@");
  });
  return facts;
}

TEST(Outline, IsThatOfTheSyntaxTree) {
  const std::string text =
      "a = 1; module m(p, q = a) { b = p; cube([b, q]); function f(x) = x + b; }\n"
      "function g(x, y = [1, 2]) = let (z = x, w = z) w ? g(y) : a;\n"
      "h = function (n) n < 1 ? 0 : h(n - 1);\n"
      "v = [for (i = [0 : a : 9], j = v2) if (i > j) each [i, j] else let (k = i) k];\n"
      "c = [for (i = 0; i < 3; i = i + 1) i], v2 = [1];\n";
  EXPECT_FALSE(TreeFacts("-", text).is_parsed);  // of the comma
  const std::string right =
      text.substr(0, text.rfind(", v2")) +
      ";\nfor (i = [0 : 3], j = [i]) translate([i, 0]) { d = i; m(p = d); }\n"
      "if (a > 1) cube(a); else if (c) { e = 1; sphere(e); } else m();\n"
      "let (x = 1) m(x) #cube(x); intersection_for (n = a) cube(n);\n"
      "x = assert(a) echo(b = c) a.x[v[0]](a)(b) + (function (s) s)(a) ^ -a;\n"
      "{ y = 2; { echo(y); } } $fn = 3; sphere($fn = $fn);\n";
  TreeFacts tree("-", right);
  ASSERT_TRUE(tree.is_parsed);
  EXPECT_EQ(without_words(facts_of(outline_of(right))), tree.facts);
}

TEST(Outline, HoldsTheSyntaxTreesOfTheExamples) {
  int count = 0;
  for (const char* folder : {SCADRAY_EXAMPLES_DIR, "/usr/share/openscad"}) {
    std::error_code none;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder, none)) {
      if (entry.path().extension() != ".scad") continue;
      std::ifstream file(entry.path(), std::ios::binary);
      std::ostringstream text;
      text << file.rdbuf();
      const TreeFacts tree(entry.path(), text.str());
      if (!tree.is_parsed) continue;
      ++count;
      const Facts found = facts_of(outline_of(text.str()));
      std::vector<std::string> missing;
      std::ranges::set_difference(tree.facts, found, std::back_inserter(missing));
      EXPECT_THAT(missing, IsEmpty()) << entry.path();
    }
  }
  EXPECT_GT(count, 10);
}

TEST(Outline, HasWhatTheTreeDrops) {
  EXPECT_THAT(facts_of(outline_of("a = 1; *cube(a); a = 2; module m() {} module m() {}")),
              ElementsAre("instance cube@8", "module m@31", "module m@45", "read a@13",
                          "variable a@0", "variable a@17"));
}

TEST(Outline, GoesOnAtTheNextStatement) {
  for (const char* broken :
       {"x = ;\n", "cube([1, 2);\n", "cube([1, 2];\n", "module (a) {}\n", "function f(x = ;\n",
        "x = [for (i = [1 : 2]) i;\n", "translate([1\n", "if (x > \n", "m(a = 1, b = \n", "}}}\n",
        ")]\n", "x = function (a, \n", "let (a = 1\n", "else\n", "x = a ? b\n", "@ # % €\n",
        "module m() { cube(\n}\n", "x = \"abc\n", "use <x\n"}) {
    const std::string text = std::string(broken) + "module next(p) { cube(p); }\nlast = 1;\n";
    const Outline outline = outline_of(text);
    const auto has = [&](const char* name, SymbolKind kind) {
      return std::ranges::any_of(outline.definitions, [&](const Definition& made) {
        return made.name == name && made.kind == kind;
      });
    };
    EXPECT_TRUE(has("next", SymbolKind::kModule)) << broken;
    EXPECT_TRUE(has("p", SymbolKind::kParameter)) << broken;
    EXPECT_TRUE(has("last", SymbolKind::kVariable)) << broken;
  }
}

TEST(Outline, DoesNotRecurseOverNesting) {
  std::string deep;
  for (int i = 0; i < 100'000; ++i) deep += "a([{let(x=1)";
  EXPECT_GT(outline_of(deep).scopes.size(), 100'000u);
}

}  // namespace
}  // namespace serve
