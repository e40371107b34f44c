#include "parsed_design.hpp"
#include "syntax/syntax.hpp"

namespace language {
namespace {

struct Row {
  std::string written, printed;
};

class ExpressionText : public testing::TestWithParam<Row> {};

TEST_P(ExpressionText, IsOpenScads) {
  const auto& [written, printed] = GetParam();
  const ParsedDesign design = parse_text("x = " + written + ";");
  EXPECT_EQ(design.lines, Lines{});
  ASSERT_EQ(design.outcome, ParseOutcome::kParsed);
  EXPECT_EQ(design.assignments(), Lines{"x = " + printed});
}

// The right sides are what `openscad -o x.ast` writes.
INSTANTIATE_TEST_SUITE_P(
    All, ExpressionText,
    testing::Values(
        Row{"-2^3*(1+2)/f(1,b=2)[3].x", "((-(2 ^ 3) * (1 + 2)) / f(1, b = 2)[3].x)"},
        Row{"2^3^2", "(2 ^ (3 ^ 2))"}, Row{"-a^-b", "-(a ^ -b)"}, Row{"!-+a", "!-a"},
        Row{"1-2-3%4", "((1 - 2) - (3 % 4))"}, Row{"1<2<3==4>=5", "(((1 < 2) < 3) == (4 >= 5))"},
        Row{"true&&false||!undef", "((true && false) || !undef)"},
        Row{"a?b:c?d:e", "(a ? b : (c ? d : e))"}, Row{"(f)(1)", "f(1)"},
        Row{"f(a=1,,2)(3)", "(f(a = 1, 2))(3)"}, Row{"((a)).x(1).y", "(a.x)(1).y"},
        Row{"a[1](2)[3]", "(a[1])(2)[3]"}, Row{"(function(x) x)(1)", "(function(x) x)(1)"},
        Row{"f(function(x=1,,y,) x)", "f(function(x = 1, y) x)"},
        Row{"(let(a=1) a)+1", "(let(a = 1) a + 1)"}, Row{"let() 1", "let() 1"},
        Row{"echo() assert(1,\"x\") 2", "echo() assert(1, \"x\") 2"},
        Row{"assert(true)", "assert(true)"}, Row{"[-1:-a:2]", "[-1 : -a : 2]"},
        Row{"[0:1]", "[0 : 1]"}, Row{"[,,]", "[]"}, Row{"[1,,[],2,]", "[1, [], 2]"},
        Row{"[for(i=1,j=2) 1]", "[for(i = 1) (for(j = 2) (1))]"},
        Row{"[for() 1, if(1) 2]", "[1, if(1) (2)]"},
        Row{"[if(1) if(2) 3 else 4]", "[if(1) (if(2) (3) else (4))]"},
        Row{"[let(x=1) x, let(c=1) each each i]", "[let(x = 1) x, let(c = 1) (each (each (i)))]"},
        Row{"[for(i=1;i<2;i=i+1,j=2) (let(x=i) if(x) x)]",
            "[for(i = 1;(i < 2);i = (i + 1), j = 2) let(x = i) (if(x) (x))]"},
        Row{"[1,(for(i=1) (i))]", "[1, for(i = 1) (i)]"}, Row{"[1,(a)+(b)]", "[1, (a + b)]"},
        Row{"[1,(a)^2*3?4:5]", "[1, (((a ^ 2) * 3) ? 4 : 5)]"},
        Row{"1e10+0.1234567+1e-7", "((1e+10 + 0.123457) + 1e-7)"},
        Row{R"("\u00e9\x41\U01F600\t\r\n\\\"\q")", "\"éA😀\\t\\r\\n\\\\\\\"q\""}));

// What OpenSCAD 2021.01 does not know.
INSTANTIATE_TEST_SUITE_P(Later, ExpressionText,
                         testing::Values(Row{"f(1,)", "f(1)"}, Row{"let(a=1,) a", "let(a = 1) a"},
                                         Row{"~a|b&c<<1<d>>2",
                                             "((~a | (b & (c << 1))) < (d >> 2))"}));

TEST(ExpressionText, PrintsLongChainsWithoutRecursion) {
  std::string text = "x=1";
  for (int i = 0; i < 100'000; ++i) text += "+1";
  const ParsedDesign design = parse_text(text + ";");
  EXPECT_EQ(design.assignments()[0].size(), 4 + 1 + 6 * 100'000);
}

}  // namespace
}  // namespace language
