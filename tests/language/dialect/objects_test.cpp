// Objects of 2026's dialect, import() of JSON, and what measures texts. What 2026 says and makes
// was found by running OpenSCAD 2025.07.18; len() of objects and methods are those of July 2026.
#include <filesystem>
#include <memory>

#include "dialect/said.hpp"

namespace language {
namespace {

std::string warned(const std::string& text) {
  return "WARNING: " + text + " in file design.scad, line 1\n";
}

void expect_echo(const std::string& expression, const std::string& shown) {
  EXPECT_EQ(said_2026("echo(" + expression + ");"), "ECHO: " + shown + "\n") << expression;
}

TEST(Objects, AreMadeOfNamesListsAndObjects) {
  expect_echo("object()", "{ }");
  expect_echo("object(a=1,c=[3])", "{ a = 1; c = [3]; }");
  expect_echo("object(a=1,[[\"k\",1],[\"m m\",2]],b=3)", "{ a = 1; k = 1; m m = 2; b = 3; }");
  expect_echo("object(object(a=1),b=2,a=3)", "{ a = 3; b = 2; }");
  expect_echo("object(a=1,b=2,[[\"a\"],[\"x\"]],a=3)", "{ b = 2; a = 3; }");
  expect_echo("object($fn=3,this=5,u=undef)", "{ $fn = 3; this = 5; u = undef; }");
  expect_echo("object(o=object(p=object(q=1))).o.p.q", "1");
}

TEST(Objects, SayWhatCannotBeTheirMembers) {
  const std::string help =
      " In an unnamed list, entries must be [key,value] to set or [key] to delete. The key must be "
      "<string>.";
  const auto expect = [](const std::string& arguments, const std::string& text) {
    EXPECT_EQ(said_2026("x = object(" + arguments + ");"), warned(text)) << arguments;
  };
  expect("a=1,\"x\"",
         "object(Argument 1 <string>) An unnamed argument must be either <object> or <list>, it is "
         "<string>. ");
  expect(
      "[1]",
      "object( Argument 0 [Element 0 <number>] ) Entry type is not a list, it is <number>." + help);
  expect("[[\"a\",1],[]]", "object(Argument 0 [Element 1 []]) Entry is empty." + help);
  expect(
      "[[\"a\",1,2]]",
      "object(Argument 0 [Element 0 [...]]) Entry length is 3, must be 1 [key] or 2 [key,value]." +
          help);
  expect("[[1,2]]",
         "object(Argument 0 [Element 0 [<number>,value]]) The key of the entry is not <string> but "
         "<number>." +
             help);
  expect("[[undef]]",
         "object(Argument 0 [Element 0 [<undefined>]]) The key of the entry is not <string> but "
         "<undefined>." +
             help);
}

TEST(Objects, HaveMembers) {
  const std::string o = "let(o=object([[\"a\",1],[\"b b\",\"x\"]])) ";
  expect_echo(o + "[o.a,o.zz,o[\"a\"],o[\"b b\"],o[\"zz\"],o[0],o[undef]]",
              "[1, undef, 1, \"x\", undef, undef, undef]");
  expect_echo(o + "[for(k=o) [k,o[k]]]", "[[\"a\", 1], [\"b b\", \"x\"]]");
  expect_echo(o + "[each o]", "[{ a = 1; b b = \"x\"; }]");
  expect_echo(
      o + "[len(o),has_key(o,\"a\"),has_key(o,\"b\"),is_object(o),is_object([]),is_list(o)]",
      "[2, true, false, true, false, false]");
  EXPECT_EQ(said_2026("for(k=object(a=1,b=2)) echo(k);"), "ECHO: \"a\"\nECHO: \"b\"\n");
  EXPECT_EQ(said_2026("x = has_key(1,\"a\");"),
            warned("has_key() parameter could not be converted: argument 0: expected object, found "
                   "number (1)"));
  EXPECT_EQ(said_2026("x = has_key(object(),1);"),
            warned("has_key() parameter could not be converted: argument 1: expected string, found "
                   "number (1)"));
}

TEST(Objects, OfManyMembersFindEach) {
  expect_echo(
      "let(o=object([for(i=[0:999]) [str(i),i]],[for(i=[0:3:999]) [str(i)]],"
      "[for(i=[0:9:999]) [str(i),-i]])) "
      "[len(o),o[\"1\"],o[\"3\"],o[\"999\"],o[\"9\"],[for(k=o) k][len(o)-1]]",
      "[778, 1, undef, -999, -9, \"999\"]");
}

TEST(Objects, AreShownWithEscapes) {
  expect_echo("object(s=\"a\\\"b\\\\c\\nd\\te\\rf\")", R"({ s = "a\"b\\c\nd\te\rf"; })");
  expect_echo("[object(s=\"a\\\"b\",v=[\"c\\\"d\"])]", R"([{ s = "a\"b"; v = ["c"d"]; }])");
  expect_echo("str(object(a=\"x\"),1)", R"("{ a = "x"; }1")");
}

TEST(Objects, CompareAndCountAsTrue) {
  expect_echo("[!object(),!object(a=1)]", "[true, false]");
  expect_echo(
      "[object(a=1)==object(a=1),object(a=1,b=2)==object(b=2,a=1),object(a=1)!=object(a=2),"
      "object(a=[1,object(b=2)])==object(a=[1,object(b=2)]),object()==[],object(a=0/0)==object(a=0/"
      "0)]",
      "[true, false, true, true, false, false]");
  EXPECT_EQ(said_2026("x = object()<object();"), warned("operation undefined (object < object)"));
  EXPECT_EQ(said_2026("x = object()+1;"), warned("undefined operation (object + number)"));
}

TEST(Objects, NestDeeply) {
  EXPECT_EQ(
      said_2026("function f(n,o)=n==0?o:f(n-1,object(o=[o])); x=f(200000,1); echo(is_object(x));"),
      "ECHO: true\n");
}

TEST(Objects, PassThemselvesToTheirFunctions) {
  const std::string o =
      "let(o=object(v=5,get=function(this) this.v,add=function(this,x) this.v+x,"
      "late=function(x,this) [x,this.v])) ";
  expect_echo(o + "[o.get(),o.add(3),o[\"add\"](4),o.late(1),o.get(this=object(v=6))]",
              "[5, 8, 9, [1, 5], 6]");
  expect_echo(o + "object(o,v=7).get()", "7");
  expect_echo("[function(this) this][0](3)", "3");  // which is no member of an object
  EXPECT_EQ(said_2026("o=object(f=function(this) this); function g()=o.f(); echo(g()==o);"),
            "ECHO: true\n");
  EXPECT_EQ(said_2026("x=object(a=1).a();"), warned("Can't call function on number"));
}

TEST(Objects, AreNotThereIn2021) {
  for (const std::string name : {"object", "has_key", "is_object", "import", "textmetrics"}) {
    EXPECT_EQ(said_2021("x = " + name + "(1);"),
              warned("Ignoring unknown function '" + name + "'"));
  }
  EXPECT_EQ(said_2026("function object(x)=x; echo(object(3));"), "ECHO: 3\n");
}

std::string said_of_json(const std::string& text) {
  return said_2026("echo(import(\"a.json\"));", {{"a.json", text}});
}

TEST(Json, BecomesValues) {
  EXPECT_EQ(said_of_json(R"({"z":1,"a":[1,2.5,-3,1e5],"n":null,"t":true,"s":"x\"\u00e9",)"
                         R"("o":{"p":{}},"d":1,"d":2})"),
            "ECHO: { a = [1, 2.5, -3, 100000]; d = 2; n = undef; o = { p = { }; }; s = \"x\\\"é\"; "
            "t = true; z = 1; }\n");
  EXPECT_EQ(said_of_json("5 and more"), "ECHO: 5\n");
  const std::string deep = std::string(100'000, '[') + std::string(100'000, ']');
  EXPECT_EQ(said_of_json(deep).substr(0, 6), "ERROR:");  // too deep to be shown
}

TEST(Json, SaysWhatCannotBeRead) {
  const std::filesystem::path path = std::filesystem::temp_directory_path() /
                                     ("dialect-test-" + std::to_string(getpid())) / "a.json";
  for (const std::string text :
       {"", "{\"a\":1,}", "[1,2", "[NaN]", "{\"a\":1e400}", "\"\\ud800\""}) {
    EXPECT_EQ(said_of_json(text),
              warned("Failed to parse file '" + path.string() + "': %s") + "ECHO: undef\n")
        << text;
  }
  EXPECT_EQ(said_2026("x = import(\"a.json\");"),
            warned("Could not read file '" + path.string() + "'"));
  const std::string nothing = warned("Could not read file ''");
  const std::string undeclared = warned("variable \"foo\" not specified as parameter");
  EXPECT_EQ(said_2026("x = import(foo=1);"), undeclared + nothing);
  EXPECT_EQ(said_2026("x = import(\"\",2);"),
            warned("Too many unnamed arguments supplied") + nothing);
  EXPECT_EQ(said_2026("import=1; x = import(5,foo=2);"), undeclared + nothing);
}

/// Tells what it is asked.
class OneFont final : public TextMeter {
 public:
  std::optional<TextMetrics> measure(const TextRequest& text,
                                     std::span<const std::string>) override {
    if (text.font == "none") return std::nullopt;
    asked = text;
    TextMetrics metrics;
    metrics.has_ink = text.text.find_first_not_of(' ') != std::string::npos;
    metrics.size = {text.size, 2};
    metrics.descent = -1;
    return metrics;
  }
  std::optional<FontMetrics> measure_font(const std::string& font, double size,
                                          std::span<const std::string>) override {
    if (font == "none") return std::nullopt;
    return FontMetrics{size, -1, 3, -2, 4, "F", "S"};
  }
  TextRequest asked;
};

std::string measured(const std::string& expression, const std::shared_ptr<OneFont>& font) {
  EvaluationOptions options;
  options.language = LanguageVersion::k2026;
  options.text_meter = font;
  std::string lines;
  evaluate(
      "design.scad", options, [&](std::string_view line) { (lines += line) += '\n'; },
      "echo(" + expression + ");");
  return lines;
}

TEST(Metrics, AskTheFonts) {
  const auto font = std::make_shared<OneFont>();
  EXPECT_EQ(
      measured("textmetrics(\"ab\",12,\"F\",\"rtl\",halign=\"top\",spacing=2)", font),
      warned("Unknown value for the halign parameter (use \"left\", \"right\" or \"center\"): "
             "'top'") +
          "ECHO: { position = [0, 0]; size = [12, 2]; ascent = 0; descent = -1; offset = [0, 0]; "
          "advance = [0, 0]; }\n");
  EXPECT_EQ(font->asked.text, "ab");
  EXPECT_EQ(font->asked.direction, "rtl");
  EXPECT_EQ(font->asked.script, "Latn");
  EXPECT_EQ(font->asked.language, "en");
  EXPECT_EQ(font->asked.spacing, 2);
  EXPECT_EQ(font->asked.valign, "default");
  EXPECT_EQ(measured("textmetrics(em=50).size", font), "ECHO: [36, 2]\n");
  EXPECT_EQ(measured("textmetrics(\" \",size=0,halign=\"top\").size", font), "ECHO: [0, 2]\n");
  EXPECT_EQ(measured("fontmetrics(7,\"F\")", font),
            "ECHO: { nominal = { ascent = 7; descent = -1; }; max = { ascent = 3; descent = -2; }; "
            "interline = 4; font = { family = \"F\"; style = \"S\"; }; }\n");
}

TEST(Metrics, SayWhatIsWrong) {
  const auto font = std::make_shared<OneFont>();
  EXPECT_EQ(measured("textmetrics(1,\"a\",\"none\")", font),
            warned("textmetrics(..., size=\"a\") Invalid type: expected number, found string") +
                warned("textmetrics(..., text=1) Invalid type: expected string, found number") +
                warned("Can't get font none") + "ECHO: undef\n");
  EXPECT_EQ(measured("fontmetrics(\"x\",\"none\",3)", font),
            warned("Too many unnamed arguments supplied") +
                warned("fontmetrics(..., size=\"x\") Invalid type: expected number, found string") +
                warned("Can't get font none") + "ECHO: undef\n");
  EXPECT_EQ(said_2026("x=textmetrics(\"a\",font=\"F\");"), warned("Can't get font F"));
}

}  // namespace
}  // namespace language
