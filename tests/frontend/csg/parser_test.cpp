#include "frontend/parser.hpp"

#include <gmock/gmock.h>

#include <bit>
#include <charconv>
#include <chrono>
#include <clocale>
#include <cmath>
#include <limits>
#include <random>

#include "csg/argument_value.hpp"
#include "frontend/stop.hpp"

namespace frontend {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;

// ---- A tree as text, for comparison: node names with modifiers, arguments and children.

std::string shown(const ArgumentValue& value) {
  switch (value.kind()) {
    case ValueKind::kUndef:
      return "undef";
    case ValueKind::kBool:
      return value.boolean() ? "true" : "false";
    case ValueKind::kString:
      return std::string("<").append(value.text()) + '>';
    case ValueKind::kNumber: {
      char text[64];
      return {text, std::to_chars(text, text + sizeof text, value.number()).ptr};
    }
    case ValueKind::kList:
      break;
  }
  std::string text = "[";
  for (const ArgumentValue element : value.elements()) {
    if (text.size() > 1) text += ' ';
    text += shown(element);
  }
  return text + ']';
}

std::string shown(const NodeTree& tree, uint32_t begin, uint32_t end) {
  std::string text;
  for (uint32_t i = begin; i < end; i = tree.nodes[i].end) {
    const Node& node = tree.nodes[i];
    if (i > begin) text += ' ';
    if (node.modifiers & language::kBackgroundModifier) text += '%';
    if (node.modifiers & language::kHighlightModifier) text += '#';
    if (node.modifiers & language::kRootModifier) text += '!';
    text += std::string(name_of(node.kind)) + '(';
    bool first = true;
    for (const language::NodeArgument& argument : tree.arguments_of(node)) {
      text += std::exchange(first, false) ? "" : ", ";
      const std::string name(argument.name.text());
      if (!argument.name.is_positional()) text += (name.empty() ? "?" : name) + '=';
      text += shown(ArgumentValue(tree, argument));
    }
    text += ')';
    if (node.end > i + 1) text += '{' + shown(tree, i + 1, node.end) + '}';
  }
  return text;
}

std::string shown(const DesignTree& tree) { return shown(*tree.nodes, 0, tree.nodes->size()); }

std::string parsed(std::string_view text) { return shown(parse(text, "x.csg")); }

/// Returns the first argument of the first node.
ArgumentValue first_argument(const DesignTree& tree) {
  return {*tree.nodes, tree.nodes->arguments[0]};
}

/// Returns the message of the error that `text` gives; fails if it gives none.
std::string error_of(std::string_view text) {
  try {
    parse(text, "x.csg");
  } catch (const Error& error) {
    return error.what();
  }
  ADD_FAILURE() << "no error for: " << text.substr(0, 200);
  return "";
}

double number_of(std::string_view text) {
  const std::string file = "sphere(" + std::string(text) + ");";
  const DesignTree tree = parse(file, "x.csg");
  EXPECT_EQ(first_argument(tree).kind(), ValueKind::kNumber) << text;
  return first_argument(tree).number();
}

std::string repeated(std::string_view text, size_t times) {
  std::string all;
  all.reserve(text.size() * times);
  for (size_t i = 0; i < times; ++i) all += text;
  return all;
}

// ---- What OpenSCAD writes

TEST(Parser, EmptyDesign) {
  EXPECT_EQ(parsed(""), "");
  EXPECT_EQ(parsed("\n"), "");
  EXPECT_EQ(parsed("\xEF\xBB\xBF\r\n"), "");
  EXPECT_EQ(parsed("group();\n"), "group()");
}

struct Spelling {
  const char* written;
  const char* expected;
};

class NodeKinds : public testing::TestWithParam<Spelling> {};

TEST_P(NodeKinds, AreParsed) { EXPECT_EQ(parsed(GetParam().written), GetParam().expected); }

constexpr Spelling kSpellings[] = {
    {"sphere($fn = 0, $fa = 12, $fs = 2, r = 0.632456);\n",
     "sphere($fn=0, $fa=12, $fs=2, r=0.632456)"},
    {"cylinder($fn = 6, $fa = 12, $fs = 2, h = 20, r1 = 10, r2 = 1e-07, center = true);\n",
     "cylinder($fn=6, $fa=12, $fs=2, h=20, r1=10, r2=1e-07, center=true)"},
    {"cube(size = [3, 3.5, -3], center = false);\n", "cube(size=[3 3.5 -3], center=false)"},
    {"polyhedron(points = [[0, 0, 0], [1, 0, 0]], faces = [[0, 1, 2]], convexity = 1);\n",
     "polyhedron(points=[[0 0 0] [1 0 0]], faces=[[0 1 2]], convexity=1)"},
    {"polyhedron(points = [], triangles = [], convexity = 1);\n",
     "polyhedron(points=[], triangles=[], convexity=1)"},
    {"circle($fn = 0, $fa = 12, $fs = 2, r = 2);\n", "circle($fn=0, $fa=12, $fs=2, r=2)"},
    {"square(size = [2, 3], center = false);\n", "square(size=[2 3], center=false)"},
    {"polygon(points = [[0, 0], [1, 0]], paths = undef, convexity = 1);\n",
     "polygon(points=[[0 0] [1 0]], paths=undef, convexity=1)"},
    {"text(text = \"hi\", size = 4, spacing = 1, font = \"Liberation Sans\", halign = \"left\", "
     "$fn "
     "= 0);\n",
     "text(text=<hi>, size=4, spacing=1, font=<Liberation Sans>, halign=<left>, $fn=0)"},
    {"multmatrix([[1, 0, 0, 5.12345], [0, 1, 0, -3.2], [0, 0, 1, 7], [0, 0, 0, 1]]) {\n}\n",
     "multmatrix([[1 0 0 5.12345] [0 1 0 -3.2] [0 0 1 7] [0 0 0 1]])"},
    {"color([-1, -1, -1, 1]) {\n\tgroup();\n}\n", "color([-1 -1 -1 1]){group()}"},
    {"group() {\n\tgroup();\n}\n", "group(){group()}"},
    {"union() {\n\tgroup();\n}\n", "union(){group()}"},
    {"difference();\n", "difference()"},
    {"intersection() {\n}\n", "intersection()"},
    {"hull() {\n}\n", "hull()"},
    {"fill() {\n}\n", "fill()"},
    {"render(convexity = 3) {\n}\n", "render(convexity=3)"},
    {"minkowski(convexity = 0) {\n}\n", "minkowski(convexity=0)"},
    {"projection(cut = true, convexity = 0) {\n}\n", "projection(cut=true, convexity=0)"},
    {"offset(r = 1, $fn = 0, $fa = 12, $fs = 2) {\n}\n", "offset(r=1, $fn=0, $fa=12, $fs=2)"},
    {"offset(delta = 1, chamfer = true) {\n}\n", "offset(delta=1, chamfer=true)"},
    {"resize(newsize = [3,4,5], auto = [0,0,0], convexity = 0) {\n}\n",
     "resize(newsize=[3 4 5], auto=[0 0 0], convexity=0)"},
    // 2015.03 and 2019.05 to 2021.01 from a file; master only writes what is not a default
    {"linear_extrude(file = \"q.dxf\", layer = \"\", origin = [0, 0], timestamp = 0, height = 2, "
     "center = false, convexity = 1, scale = [1, 1], $fn = 0, $fa = 12, $fs = 2);\n",
     "linear_extrude(file=<q.dxf>, layer=<>, origin=[0 0], timestamp=0, height=2, center=false, "
     "convexity=1, scale=[1 1], $fn=0, $fa=12, $fs=2)"},
    {"linear_extrude(height = 3, center = false, convexity = 1, twist = 20, slices = 7, scale = "
     "[1, 2]) {\n}\n",
     "linear_extrude(height=3, center=false, convexity=1, twist=20, slices=7, scale=[1 2])"},
    {"linear_extrude(height = 3, v = [0, 0, 1], segments = 4, $fe = 0.1) {\n}\n",
     "linear_extrude(height=3, v=[0 0 1], segments=4, $fe=0.1)"},
    {"rotate_extrude(angle = 90, start = 180, convexity = 2, $fn = 0, $fa = 12, $fs = 2) {\n}\n",
     "rotate_extrude(angle=90, start=180, convexity=2, $fn=0, $fa=12, $fs=2)"},
    {"rotate_extrude(convexity = 2, $fn = 0, $fa = 12, $fs = 2) {\n}\n",
     "rotate_extrude(convexity=2, $fn=0, $fa=12, $fs=2)"},
    {"import(file = \"a\\\\b.dxf\", layer = \"l\\\"1\", origin = [0, 0], scale = 1, convexity = 1, "
     "$fn = 0, $fa = 12, $fs = 2, timestamp = 0);\n",
     "import(file=<a\\b.dxf>, layer=<l\"1>, origin=[0 0], scale=1, convexity=1, $fn=0, $fa=12, "
     "$fs=2, timestamp=0)"},
    {"import(file = \"a.svg\", id = \"x\\ty\\nz\\r\", center = true, dpi = 72);\n",
     "import(file=<a.svg>, id=<x\ty\nz\r>, center=true, dpi=72)"},
    {"surface(file = \"x\\\"y.dat\", center = false, invert = false, timestamp = 0);\n",
     "surface(file=<x\"y.dat>, center=false, invert=false, timestamp=0)"},
    {"roof(method = \"straight\", convexity = 1, $fn = 0) {\n}\n",
     "roof(method=<straight>, convexity=1, $fn=0)"},
};
INSTANTIATE_TEST_SUITE_P(Written, NodeKinds, testing::ValuesIn(kSpellings));

TEST(Parser, TheSpellingsAboveHaveEveryNodeKind) {
  for (uint8_t i = 0; i < language::kNodeNames.size(); ++i) {
    const std::string_view name = language::kNodeNames[i];
    const bool has = std::any_of(std::begin(kSpellings), std::end(kSpellings), [&](auto& spelling) {
      return std::string_view(spelling.written).starts_with(std::string(name) + '(');
    });
    EXPECT_TRUE(has) << name;
  }
}

TEST(Parser, NodeNamesStandInTheOrderOfTheKinds) {
  EXPECT_EQ(name_of(NodeKind::kSphere), "sphere");
  EXPECT_EQ(name_of(NodeKind::kText), "text");
  EXPECT_EQ(name_of(NodeKind::kMultmatrix), "multmatrix");
  EXPECT_EQ(name_of(NodeKind::kHull), "hull");
  EXPECT_EQ(name_of(NodeKind::kRotateExtrude), "rotate_extrude");
  EXPECT_EQ(name_of(NodeKind::kRoof), "roof");
}

TEST(Parser, The2015FormInOneGroup) {
  EXPECT_EQ(parsed("group() {\n\tdifference() {\n\t\tcube(size = [1, 1, 1], center = false);\n\t\t"
                   "sphere($fn = 0, $fa = 12, $fs = 2, r = 1);\n\t}\n}\n"),
            "group(){difference(){cube(size=[1 1 1], center=false) "
            "sphere($fn=0, $fa=12, $fs=2, r=1)}}");
}

TEST(Parser, ModifiersBeforeAndAfterTheTabs) {
  EXPECT_EQ(parsed("group() {\n%\tsphere(r = 1);\n%#\tsphere(r = 2);\n\t#!sphere(r = 3);\n% "
                   "\tunion() {\n\t}\n\tcube();\n}\n"),
            "group(){%sphere(r=1) %#sphere(r=2) #!sphere(r=3) %union() cube()}");
}

TEST(Parser, DropsDisabledSubtreesAndKeepsRoots) {
  EXPECT_EQ(
      parsed("union() { *group() { sphere([1, 2]); *cube(\"a\"); } !cube([2, 3]); } circle(3);"),
      "union(){!cube([2 3])} circle(3)");
  EXPECT_EQ(parsed("* % !hull() #group() { sphere(1); } *cube(2);"), "");
  EXPECT_EQ(parsed("hull() *group() sphere(1); cube([1, 2]);"), "hull() cube([1 2])");
  EXPECT_THAT(error_of("cube(1); *sphere(r = oops);"), StartsWith("x.csg:1:22: error:"));
}

TEST(Parser, ChildrenAreFoundThroughTheEnds) {
  const DesignTree tree = parse("union(){sphere();group(){cube();circle();}}text();", "x.csg");
  std::vector<uint32_t> ends;
  for (const Node& node : tree.nodes->nodes) ends.push_back(node.end);
  EXPECT_THAT(ends, ElementsAre(5, 2, 5, 4, 5, 6));
}

// ---- The text of a text node stands raw

TEST(RawText, QuotesLineBreaksAndBackslashesStandRaw) {
  const DesignTree tree = parse(
      "\ttext(text = \"say (\"hi\");\nline\\2\\n\", size = 4, spacing = 1);\n\tcube(size = 1);\n",
      "x.csg");
  EXPECT_EQ(shown(tree), "text(text=<say (\"hi\");\nline\\2\\n>, size=4, spacing=1) cube(size=1)");
  EXPECT_EQ(tree.location_of(tree.nodes->nodes[1].place).line,
            3u);  // the line break within the text counts
}

TEST(RawText, OddTexts) {
  EXPECT_EQ(parsed("text(text = \"\", size = 4);"), "text(text=<>, size=4)");
  EXPECT_EQ(parsed("text(text = \"\"\", size = 4);"), "text(text=<\">, size=4)");
  EXPECT_EQ(parsed("text(text = \"\\\", size = 4);"), "text(text=<\\>, size=4)");
  EXPECT_EQ(parsed("text(text = \"a\", b\", size = 4);"), "text(text=<a\", b>, size=4)");
  EXPECT_EQ(parsed("text(text = \"f(\"x\");\", size = 4);"), "text(text=<f(\"x\");>, size=4)");
  EXPECT_EQ(parsed("text(text = \"} // /* {\", size = 4);"), "text(text=<} // /* {>, size=4)");
  EXPECT_EQ(parsed("text(text = \"\xC3\xA9\xFF\", size = 4);"),
            "text(text=<\xC3\xA9\xFF>, size=4)");
}

TEST(RawText, ByHandAStringEndsAtItsQuote) {
  EXPECT_EQ(parsed("text(\"a\\\"b\\\\\", 4);"), "text(<a\"b\\>, 4)");
  EXPECT_EQ(parsed("text(text = \"a\"); text(text = \"b\", size = 5);"),
            "text(text=<a>) text(text=<b>, size=5)");
  EXPECT_EQ(parsed("text(text = \"a\", font = \"b\", size = 5);"),
            "text(text=<a>, font=<b>, size=5)");
  EXPECT_EQ(parsed("text(text = \"a\");"), "text(text=<a>)");
  EXPECT_EQ(parsed("text(text=\"a\\\"\", size = 5);"), "text(text=<a\">, size=5)");
  EXPECT_EQ(parsed("text(text = \"\\u00e9\");"), "text(text=<\\u00e9>)");  // unknown: unchanged
}

// ---- Numbers

TEST(Numbers, EverySpelling) {
  EXPECT_EQ(number_of("0.1"), 0.1);
  EXPECT_EQ(number_of("1e-07"), 1e-7);
  EXPECT_EQ(number_of("1e-7"), 1e-7);
  EXPECT_EQ(number_of("1.23457e+06"), 1.23457e6);
  EXPECT_EQ(number_of("1E3"), 1000);
  EXPECT_EQ(number_of(".5"), 0.5);
  EXPECT_EQ(number_of("5."), 5);
  EXPECT_EQ(number_of("007"), 7);
  EXPECT_EQ(number_of("-3"), -3);
  EXPECT_EQ(number_of("+3"), 3);
  EXPECT_EQ(number_of("- - 3"), 3);
  EXPECT_EQ(number_of("-+.5e1"), -5);
  EXPECT_TRUE(std::signbit(number_of("-0")));
  EXPECT_EQ(number_of("inf"), std::numeric_limits<double>::infinity());
  EXPECT_EQ(number_of("-inf"), -std::numeric_limits<double>::infinity());
  EXPECT_TRUE(std::isnan(number_of("nan")));
  EXPECT_TRUE(std::isnan(number_of("-nan")));
}

TEST(Numbers, AtTheEndsOfDouble) {
  EXPECT_EQ(number_of("1.7976931348623157e308"), std::numeric_limits<double>::max());
  EXPECT_EQ(number_of("5e-324"), std::numeric_limits<double>::denorm_min());
  EXPECT_EQ(number_of("1e-400"), 0);
  EXPECT_EQ(number_of("1e-99999999999999999999"), 0);
  EXPECT_EQ(number_of("0e99999999999999999999"), 0);
  EXPECT_EQ(number_of("1e-9223372036854775808"), 0);
  EXPECT_EQ(number_of("0." + repeated("0", 400) + "1"), 0);
  EXPECT_EQ(number_of("0." + repeated("0", 400) + "1e401"), 1);
  EXPECT_EQ(number_of("1" + repeated("0", 400) + "e-400"), 1);
  const std::string too_large = "x.csg:1:8: error: the number is too large (";
  EXPECT_THAT(error_of("sphere(1e309);"), StartsWith(too_large));
  EXPECT_THAT(error_of("sphere(1e99999999999999999999);"), StartsWith(too_large));
  EXPECT_THAT(error_of("sphere(50e9223372036854775807);"), StartsWith(too_large));
  EXPECT_THAT(error_of("sphere(" + repeated("9", 400) + ");"), StartsWith(too_large));
  EXPECT_THAT(error_of("sphere(1" + repeated("0", 400) + "e-10);"), StartsWith(too_large));
}

TEST(Numbers, AreCorrectlyRounded) {
  // Halfway cases, and the limits of the fast conversion: 15 digits, 2^53 + 1, 22 decimals.
  EXPECT_EQ(number_of("9007199254740993"), 9007199254740992.0);
  EXPECT_EQ(number_of("9007199254740993.0000000000000000000000000001"), 9007199254740994.0);
  EXPECT_EQ(number_of("999999999999999"), 999999999999999.0);
  EXPECT_EQ(number_of("0.00000000000001"), 1e-14);
  EXPECT_EQ(number_of("0.0000000000000000000000000000001"), 1e-31);
  std::mt19937_64 random(7);
  for (int i = 0; i < 20'000; ++i) {
    const double exact = std::bit_cast<double>(random());
    if (!std::isfinite(exact)) continue;
    char text[64];
    const char* end = std::to_chars(text, text + sizeof text, exact).ptr;
    ASSERT_EQ(number_of({text, static_cast<size_t>(end - text)}), exact) << text;
  }
  for (int i = 0; i < 20'000; ++i) {
    const double value = static_cast<double>(static_cast<int64_t>(random())) / 1e15;
    char text[64];
    std::snprintf(text, sizeof text, i % 2 ? "%g" : "%.12f", value);
    ASSERT_EQ(number_of(text), std::strtod(text, nullptr)) << text;
  }
}

TEST(Numbers, DoNotDependOnTheLocale) {
  const char* const with_comma = std::setlocale(LC_ALL, "de_DE.UTF-8");
  EXPECT_EQ(number_of("1.5e1"), 15) << (with_comma ? with_comma : "no such locale installed");
  EXPECT_EQ(parsed("cube([1,5]);"), "cube([1 5])");
  std::setlocale(LC_ALL, "C");
}

// ---- What a person writes

TEST(ByHand, CommentsAndWhiteSpace) {
  EXPECT_EQ(
      parsed("// head\n/* a\n*/union/**/(/*x*/) // }\n{sphere\t(r\v=\f1 /*,*/ , d=2)\r\n;}//"),
      "union(){sphere(r=1, d=2)}");
  EXPECT_EQ(parsed("sphere(r=[1/**/,/***/2//\n]);/**/"), "sphere(r=[1 2])");
}

TEST(ByHand, PositionalNamedAndTrailingCommas) {
  EXPECT_EQ(parsed("cylinder(20,d=3,d1=4,d2=5,$fn=8,);cube([1,2,[],[3,],],true);sphere(r=inf);"),
            "cylinder(20, d=3, d1=4, d2=5, $fn=8) cube([1 2 [] [3]], true) sphere(r=inf)");
  EXPECT_EQ(parsed("text(nan, undef, false, \"\");"), "text(nan, undef, false, <>)");
}

TEST(ByHand, UnknownArgumentNamesAreNotAnothers) {
  EXPECT_EQ(parsed("cube(undefined=1, truely=2, $preview=3, sizes=4, 5);"),
            "cube(?=1, ?=2, ?=3, ?=4, 5)");
}

TEST(ByHand, ListsOfAnyLength) {
  const DesignTree tree = parse("cube([" + repeated("1,", 70'000) + "2]);", "x.csg");
  const ValueList list = first_argument(tree).elements();
  ASSERT_EQ(list.size(), 70'001u);
  EXPECT_EQ(list[69'999].number(), 1);
  EXPECT_EQ(list[70'000].number(), 2);
}

TEST(ByHand, MatricesOfAnyShape) {
  EXPECT_EQ(parsed("multmatrix([[1,0,0,0],[0,1,0,0],[0,0,1,0]]);"),
            "multmatrix([[1 0 0 0] [0 1 0 0] [0 0 1 0]])");
  EXPECT_EQ(parsed("multmatrix([[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1],[5]]);"),
            "multmatrix([[1 0 0 0] [0 1 0 0] [0 0 1 0] [0 0 0 1] [5]])");
  EXPECT_EQ(parsed("multmatrix([[1,0,0,0],[0,1,0,0],\n[0,0,1,0],[0,0,0,1e0]]);"),
            "multmatrix([[1 0 0 0] [0 1 0 0] [0 0 1 0] [0 0 0 1]])");
}

TEST(ByHand, SemicolonsAloneAndOneChildWithoutBraces) {
  EXPECT_EQ(parsed(";;sphere(1);;union(){;};"), "sphere(1) union()");
  EXPECT_EQ(parsed("union() color([1,0,0]) %sphere(1); difference() { hull() cube(); cube(); }"),
            "union(){color([1 0 0]){%sphere(1)}} difference(){hull(){cube()} cube()}");
  EXPECT_EQ(parse("union() sphere(1);", "x.csg").nodes->nodes[0].modifiers, 0);
  EXPECT_EQ(parsed("hull() group() { sphere(1); } cube();"), "hull(){group(){sphere(1)}} cube()");
}

TEST(ByHand, ByteOrderMarkAndCarriageReturns) {
  const DesignTree tree =
      parse("\xEF\xBB\xBFunion() {\r\n\tsphere(r = 1);\r\n}\r\ncube();\r\n", "x.csg");
  EXPECT_EQ(shown(tree), "union(){sphere(r=1)} cube()");
  EXPECT_EQ(tree.location_of(tree.nodes->nodes[0].place).column, 1u);
  EXPECT_EQ(tree.location_of(tree.nodes->nodes[2].place).line, 4u);
}

// ---- Places

TEST(Locations, AreThoseOfTheNames) {
  const DesignTree tree = parse(
      "// é\nunion() {\n#\t sphere(r = 1); cube(size = [\n1]);\n} /*\n*/ text(\"a\nb\"); circle();",
      "x.csg");
  std::vector<std::pair<uint32_t, uint32_t>> places;
  for (const Node& node : tree.nodes->nodes) {
    const Location location = tree.location_of(node.place);
    places.emplace_back(location.line, location.column);
  }
  EXPECT_THAT(places, ElementsAre(std::pair(2, 1), std::pair(3, 4), std::pair(3, 19),
                                  std::pair(6, 4), std::pair(7, 6)));
}

struct Malformed {
  std::string_view text;
  std::string_view message;  // how it begins
};

class MalformedFile : public testing::TestWithParam<Malformed> {};

TEST_P(MalformedFile, IsAnErrorWithItsPlaceThatSaysWhatToDo) {
  EXPECT_THAT(error_of(GetParam().text),
              AllOf(StartsWith(std::string(GetParam().message) + " ("), EndsWith(")")));
}

using namespace std::string_view_literals;

INSTANTIATE_TEST_SUITE_P(
    Files, MalformedFile,
    testing::Values(
        Malformed{"\n  translate([1,2,3]) sphere();", "x.csg:2:3: error: unknown node 'translate'"},
        Malformed{"spher(r=1);", "x.csg:1:1: error: unknown node 'spher'"},
        Malformed{"$fn = 8;", "x.csg:1:1: error: unknown node '$fn'"},
        Malformed{"sphere;", "x.csg:1:7: error: expected '(', found ';'"},
        Malformed{"sphere(1)\nsphere(2);", "x.csg:2:1: error: expected ';', found 'sphere'"},
        Malformed{"union()", "x.csg:1:8: error: expected ';' or '{', found the end of the file"},
        Malformed{"union() ]", "x.csg:1:9: error: expected ';' or '{', found ']'"},
        Malformed{"union() {\n{ sphere(); }\n}", "x.csg:2:1: error: expected a node, found '{'"},
        Malformed{"union() {\n\tsphere(r = 1);\n",
                  "x.csg:3:1: error: the '{' of the union in line 1 is not closed"},
        Malformed{"sphere();\n}\n", "x.csg:2:1: error: '}' without a '{'"},
        Malformed{"union() { # }",
                  "x.csg:1:13: error: expected a node after its modifier, found '}'"},
        Malformed{"union() %;", "x.csg:1:10: error: expected a node after its modifier, found ';'"},
        Malformed{
            "union() {} *",
            "x.csg:1:13: error: expected a node after its modifier, found the end of the file"},
        Malformed{"sphere(r = );", "x.csg:1:12: error: expected a value, found ')'"},
        Malformed{"sphere(r = 1",
                  "x.csg:1:13: error: expected ',' or ')', found the end of the file"},
        Malformed{"sphere(r = 1 2);", "x.csg:1:14: error: expected ',' or ')', found '2'"},
        Malformed{"sphere(r = 1+2);", "x.csg:1:13: error: expected ',' or ')', found '+'"},
        Malformed{"sphere(r = 12mm);", "x.csg:1:14: error: expected ',' or ')', found 'mm'"},
        Malformed{"sphere(r = 1.2.3);", "x.csg:1:15: error: expected ',' or ')', found '.'"},
        Malformed{"sphere(r = 1e);", "x.csg:1:13: error: expected ',' or ')', found 'e'"},
        Malformed{"sphere(r = .);", "x.csg:1:12: error: expected a number, found '.'"},
        Malformed{"sphere(r = -);", "x.csg:1:13: error: expected a value, found ')'"},
        Malformed{"sphere(r = -true);", "x.csg:1:12: error: no value is called 'true'"},
        Malformed{"sphere(r = big);", "x.csg:1:12: error: no value is called 'big'"},
        Malformed{"sphere(big);", "x.csg:1:8: error: no value is called 'big'"},
        Malformed{"sphere(,);", "x.csg:1:8: error: expected a value, found ','"},
        Malformed{"sphere(1,,2);", "x.csg:1:10: error: expected a value, found ','"},
        Malformed{"cube([1 2]);", "x.csg:1:9: error: expected ',' or ']', found '2'"},
        Malformed{"cube([1,,2]);", "x.csg:1:9: error: expected a value, found ','"},
        Malformed{"cube([0:1:2]);", "x.csg:1:8: error: expected ',' or ']', found ':'"},
        Malformed{"cube([[1, 2)", "x.csg:1:12: error: expected ',' or ']', found ')'"},
        Malformed{"cube([[1, 2]",
                  "x.csg:1:13: error: expected ',' or ']', found the end of the file"},
        Malformed{"cube([", "x.csg:1:7: error: expected a value, found the end of the file"},
        Malformed{"cube(1/2);", "x.csg:1:7: error: '/' outside a comment"},
        Malformed{"\n /* x", "x.csg:2:2: error: the comment is not closed"},
        Malformed{"/*/", "x.csg:1:1: error: the comment is not closed"},
        Malformed{"import(file = \"a\nb\\\");\n", "x.csg:1:15: error: the string is not closed"},
        Malformed{"text(text = \"a\", size",
                  "x.csg:1:22: error: expected a value, found the end"
                  " of the file"},
        Malformed{"sphere(1);\n\0"sv, "x.csg:2:1: error: expected a node, found '\\x00'"},
        Malformed{"sphere(\0);"sv, "x.csg:1:8: error: expected a value, found '\\x00'"},
        Malformed{"sph\0ere();"sv, "x.csg:1:1: error: unknown node 'sph'"},
        Malformed{"\xFF\xFEs\0p\0"sv, "x.csg:1:1: error: expected a node, found '\\xFF'"},
        Malformed{"cube(size\xC2\xA0= 1);", "x.csg:1:6: error: no value is called 'size'"}));

TEST(Malformed, MessagesDoNotRepeatALongWord) {
  EXPECT_LT(error_of(repeated("x", 100'000) + "();").size(), 300u);
  EXPECT_LT(error_of("sphere(r = " + repeated("x", 100'000) + ");").size(), 300u);
  EXPECT_LT(error_of("sphere() " + repeated("x", 100'000)).size(), 300u);
}

constexpr std::string_view kDesign =
    "group() {\n%\tmultmatrix([[1, 0, 0, -1e-07], [nan, inf]]) {\n\t\ttext(text = \"a\"b\n\", size "
    "= 4, font = \"F\");\n\t}\n\timport(file = \"x\\\"\"); // c\n/* d */}\nsphere(r = 1);\n";

TEST(Malformed, TruncatedAnywhereIsATreeOrAnError) {
  for (size_t length = 0; length <= kDesign.size(); ++length) {
    const std::string cut(kDesign.substr(0, length));  // on the heap, so that asan sees reads past
                                                       // its end
    try {
      const DesignTree tree = parse(cut, "x.csg");
      // A text may be cut only where nothing is open: before the design, or after its one group.
      EXPECT_TRUE(cut.empty() || cut.find("*/}") != std::string::npos) << cut;
    } catch (const Error& error) {
      EXPECT_THAT(error.what(), AllOf(StartsWith("x.csg:"), HasSubstr(": error: ")));
    }
  }
}

TEST(Malformed, EveryByteEverywhereIsATreeOrAnError) {
  for (size_t at = 0; at < kDesign.size(); ++at) {
    for (int byte = 0; byte < 256; ++byte) {
      std::string changed(kDesign);
      changed[at] = static_cast<char>(byte);
      try {
        parse(changed, "x.csg");
      } catch (const Error& error) {
        ASSERT_THAT(error.what(), StartsWith("x.csg:"));
      }
    }
  }
}

// ---- Sizes

TEST(BeyondRepair, IsWhatFailsBeforeItsEnd) {
  const std::string more(20, ' ');
  for (const std::string& start :
       {std::string("y\ny\n"), std::string("sphere(;"), std::string("sphere(r = 1e400);"),
        std::string("}"), std::string("/ "), std::string(1, '\0')}) {
    EXPECT_TRUE(is_beyond_repair(start + more)) << start;
    EXPECT_FALSE(is_beyond_repair(start)) << start;  // too near to the end to be certain
  }
}

TEST(BeyondRepair, IsNothingThatMayGoOn) {
  const std::string more(100, 'x');
  for (const std::string& start :
       {std::string(), std::string(100, ' '), "sphere(r = 1);" + more, "/* " + more, "// " + more,
        "text(text = \"a\" b" + more, "text(text = \"" + more, "cube(size = \"" + more,
        "union() { " + std::string(100, ';'), "cube(size = " + std::string(400, '9'),
        "cube(size = [" + std::string(100, '[')}) {
    EXPECT_FALSE(is_beyond_repair(start)) << start;
  }
}

/// No start of a good text is beyond repair, wherever it is cut.
TEST(BeyondRepair, IsNoStartOfAGoodText) {
  const std::string text =
      "\xEF\xBB\xBF// a comment\n%group() { /* another one */ multmatrix([[1, 0, 0, -1e+02], [0, "
      "1, 0, 2.5e-300], [0, 0, 1, nan], [0, 0, 0, 1]]) sphere($fn = 0, r = 1e-7); }\n"
      "text(text = \"a \"quoted\"\nword, 1/2\", size = 10, font = \"\", direction = \"ltr\");\n"
      "cube(size = [1, 2, 3], center = true);\n";
  ASSERT_NO_THROW(parse(text, "a.csg"));
  for (std::size_t length = 0; length <= text.size(); ++length) {
    EXPECT_FALSE(is_beyond_repair(text.substr(0, length))) << length;
  }
}

TEST(Sizes, AMillionLevelsOfNodes) {
  constexpr size_t kLevels = 1'000'000;
  const std::string head = repeated("union(){", kLevels);
  const DesignTree tree = parse(head + "sphere(1);" + repeated("}", kLevels), "x.csg");
  ASSERT_EQ(tree.nodes->size(), kLevels + 1);
  EXPECT_EQ(tree.nodes->nodes[0].end, kLevels + 1);
  EXPECT_EQ(tree.nodes->nodes[kLevels].kind, NodeKind::kSphere);
  EXPECT_THAT(error_of(head), HasSubstr("the '{' of the union in line 1 is not closed"));
  EXPECT_EQ(parse(repeated("union()", kLevels) + ";", "x.csg").nodes->size(), kLevels);
}

TEST(Sizes, AMillionLevelsOfLists) {
  constexpr size_t kLevels = 1'000'000;
  const std::string head = "cube(" + repeated("[", kLevels);
  const DesignTree tree = parse(head + repeated("]", kLevels) + ");", "x.csg");
  size_t depth = 1;
  for (ValueList list = first_argument(tree).elements(); list.size() == 1;
       list = list[0].elements()) {
    ++depth;
  }
  EXPECT_EQ(depth, kLevels);
  EXPECT_THAT(error_of(head), HasSubstr("expected a value, found the end of the file"));
  EXPECT_THAT(error_of(head + "x;"), StartsWith("x.csg:1:1000006: error: no value is called 'x'"));
  EXPECT_THAT(error_of("cube(" + repeated("[", 2 * kLevels)),
              HasSubstr("nested more than 1048576"));
}

TEST(Sizes, ListsSideBySideDoNotCountAsNesting) {
  const DesignTree tree = parse("cube([" + repeated("[],", 2'000'000) + "]);", "x.csg");
  EXPECT_EQ(first_argument(tree).elements().size(), 2'000'000u);
}

TEST(Sizes, FilesTooLargeFor32BitsAreRefusedUnread) {
  const char one = 's';
  try {
    parse({&one, (size_t{1} << 32) - 1}, "x.csg");
    FAIL();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), StartsWith("x.csg: error: the file has 4294967295 bytes ("));
  }
}

/// Texts that would take quadratic time if the parser looked ahead repeatedly.
TEST(Sizes, NothingIsReadTwice) {
  constexpr size_t kTimes = 100'000;
  // 1 to 4 MB take at most 0.1 s, under asan too; looking ahead in vain to the end would take 10 s
  // and more.
  constexpr std::chrono::seconds kLimit(3);
  for (const std::string_view piece :
       {"text(text = \"a\");", "text(text = \"a\\\"b\", size = 1);",
        "text(text = \"a\" x\", size = 1);", "text(text = \"a\", font = \"b\", size = 1);", "/**/",
        "//\n", "%", "cube(x=1);", "[", "{", "text(text = \"", "\"", "/*", "- "}) {
    const std::string text = repeated(piece, kTimes);
    for (const char* end : {"", "text(text = \"a\", size = 1);"}) {
      for (const char* start : {"", "cube(", "text(text = \"a\"); text text "}) {
        const auto begin = std::chrono::steady_clock::now();
        try {
          parse(start + text + end, "x.csg");
        } catch (const Error&) {
        }
        ASSERT_LT(std::chrono::steady_clock::now() - begin, kLimit) << start << piece << end;
      }
    }
  }
}

TEST(Parser, StopsWhenAsked) {
  std::stop_source stop;
  EXPECT_EQ(parse(FileText("sphere(r = 1);"), "x.csg", "", stop.get_token()).nodes->size(), 1u);
  stop.request_stop();
  EXPECT_THROW(parse(FileText("sphere(r = 1);"), "x.csg", "", stop.get_token()), Stopped);
}

TEST(ErrorText, LeavesOutWhatIsNotKnown) {
  EXPECT_STREQ(Error("f.csg", {3, 7}, "what", "do it").what(), "f.csg:3:7: error: what (do it)");
  EXPECT_STREQ(Error("f.csg", {3, 0}, "what", "").what(), "f.csg:3: error: what");
  EXPECT_STREQ(Error("f.csg", {}, "what", "do it").what(), "f.csg: error: what (do it)");
  EXPECT_STREQ(Error("", {}, "what", "").what(), "error: what");
  EXPECT_EQ(make_warning("f.csg", {3, 7}, "what", "do it").text,
            "f.csg:3:7: warning: what (do it)");
}

}  // namespace
}  // namespace frontend
