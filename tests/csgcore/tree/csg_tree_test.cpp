// Tests the tree's normal form, and its compilation to a Blist.
#include "csgcore/csg_tree.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "checks.hpp"
#include "csgcore/blist.hpp"
#include "support/evaluate_tree.hpp"

namespace csgcore {
namespace {

using test_support::evaluate_tree;

/// "0 1 2 -3" is primitives 0, 1, 2 and a difference over three operands; + union, * intersection.
std::string text_of(const CsgTree& tree) {
  std::string text;
  for (const CsgToken& token : tree.tokens()) {
    if (!text.empty()) text += ' ';
    if (!token.is_primitive) text += "+*-"[static_cast<int>(token.op)];
    text += std::to_string(token.value);
  }
  return text;
}

/// Builds from letters: u i d open an operation, digits are primitives, e is an empty operand and )
/// closes.
CsgTree build(std::string_view calls) {
  CsgTreeBuilder builder;
  for (const char c : calls) {
    if (c == 'u') builder.open(Op::kUnion);
    if (c == 'i') builder.open(Op::kIntersection);
    if (c == 'd') builder.open(Op::kDifference);
    if (c >= '0' && c <= '9') builder.primitive(static_cast<uint32_t>(c - '0'));
    if (c == 'e') builder.empty();
    if (c == ')') builder.close();
  }
  return builder.finish();
}

struct NormalFormCase {
  const char* calls;
  const char* postfix;
};

TEST(CsgTreeBuilder, NormalForm) {
  const NormalFormCase cases[] = {
      {"", ""},
      {"0", "0"},
      {"01", "0 1 +2"},              // the top level is a union
      {"u01)", "0 1 +2"},            // a union merges into it
      {"u01)2", "0 1 2 +3"},         //
      {"uuu0)))", "0"},              // a lone operand is itself
      {"u0u1u2)))", "0 1 2 +3"},     // union under union
      {"i01i23))", "0 1 2 3 *4"},    // intersection under intersection
      {"dd01)2)", "0 1 2 -3"},       // a difference that is the first operand
      {"d0d12))", "0 1 2 -2 -2"},    // but not one that is a later operand
      {"d0u12))", "0 1 2 -3"},       // a union as a later operand
      {"du01)2)", "0 1 +2 2 -2"},    // but not as the first
      {"i0u12))", "0 1 2 +2 *2"},    //
      {"d0ue))", "0"},               // an empty later operand leaves a difference
      {"de0)", ""},                  // an empty first operand empties it
      {"d)", ""},                    //
      {"u)0", "0"},                  //
      {"ue0e)", "0"},                // a union drops empty operands
      {"i0e1)", ""},                 // an intersection is emptied by one
      {"i0e1)2", "2"},               //
      {"i0d1)u)2)", ""},             //
      {"u0ie12))", "0"},             //
      {"u0i1e)2)", "0 2 +2"},        //
      {"i0)", "0"},                  // a lone child is itself
      {"id012))", "0 1 2 -3"},       // with its operation
      {"u0id12)))", "0 1 2 -2 +2"},  //
      {"d0iu12)))", "0 1 2 -3"},     // and then dissolves
      {"dd0e)1)", "0 1 -2"},         //
      {"ddd0)1)2)", "0 1 2 -3"},     //
      {"diu01)e)2)", ""},            // operands of an emptied operation are dropped
      {"u3diu01)e)2))", "3"},        //
      {"d0i1d2u3e)e)))", "0 1 2 3 -2 *2 -2"},
  };
  for (const NormalFormCase& c : cases) EXPECT_EQ(text_of(build(c.calls)), c.postfix) << c.calls;
}

TEST(CsgTreeBuilder, IsEmptyAfterFinish) {
  CsgTreeBuilder builder;
  builder.primitive(1);
  builder.primitive(2);
  EXPECT_EQ(text_of(builder.finish()), "1 2 +2");
  EXPECT_TRUE(builder.finish().empty());
  builder.primitive(3);
  EXPECT_EQ(text_of(builder.finish()), "3");
}

/// An operation of a random design, evaluated as OpenSCAD does.
struct Frame {
  Op op;
  int operands = 0;
  bool value = false;
};

void add_operand(Frame& frame, bool value) {
  if (frame.operands++ == 0) {
    frame.value = value;
  } else if (frame.op == Op::kUnion) {
    frame.value = frame.value || value;
  } else if (frame.op == Op::kIntersection) {
    frame.value = frame.value && value;
  } else {
    frame.value = frame.value && !value;
  }
}

std::string random_calls(std::mt19937& random) {
  std::string calls;
  int depth = 0;
  for (int i = 0; i < 40; ++i) {
    const double pick = checks::uniform(random, 0, 1);
    if (pick < 0.35) {
      calls += "uid"[random() % 3];
      ++depth;
    } else if (pick < 0.65) {
      calls += static_cast<char>('0' + random() % 10);
    } else if (pick < 0.7) {
      calls += 'e';
    } else if (depth > 0) {
      calls += ')';
      --depth;
    }
  }
  return calls.append(static_cast<size_t>(depth), ')');
}

bool evaluate_calls(std::string_view calls, uint32_t truth) {
  std::vector<Frame> stack{{Op::kUnion}};
  for (const char c : calls) {
    if (c == 'u') stack.push_back({Op::kUnion});
    if (c == 'i') stack.push_back({Op::kIntersection});
    if (c == 'd') stack.push_back({Op::kDifference});
    if (c >= '0' && c <= '9') add_operand(stack.back(), (truth >> (c - '0')) & 1);
    if (c == 'e') add_operand(stack.back(), false);
    if (c == ')') {
      const bool value = stack.back().value;
      stack.pop_back();
      add_operand(stack.back(), value);
    }
  }
  return stack.front().value;
}

/// Checks the rules that csg_tree.hpp states.
void expect_normal_form(const CsgTree& tree) {
  std::vector<const CsgToken*> roots;
  for (const CsgToken& token : tree.tokens()) {
    if (!token.is_primitive) {
      ASSERT_GE(token.value, 2u);
      ASSERT_GE(roots.size(), token.value);
      for (uint32_t i = 0; i < token.value; ++i) {
        const CsgToken& operand = *roots[roots.size() - token.value + i];
        if (operand.is_primitive) continue;
        if (token.op != Op::kDifference) {
          ASSERT_NE(operand.op, token.op);
        } else {
          ASSERT_NE(operand.op, i == 0 ? Op::kDifference : Op::kUnion);
        }
      }
      roots.resize(roots.size() - token.value);
    }
    roots.push_back(&token);
  }
  ASSERT_LE(roots.size(), 1u);
}

TEST(CsgTreeBuilder, RandomTreesKeepTheirMeaning) {
  std::mt19937 random(1);
  int not_empty = 0;
  for (int round = 0; round < 3000; ++round) {
    const std::string calls = random_calls(random);
    SCOPED_TRACE(calls);
    const CsgTree tree = build(calls);
    expect_normal_form(tree);
    not_empty += !tree.empty();
    for (int i = 0; i < 30; ++i) {
      const uint32_t truth = static_cast<uint32_t>(random());
      const bool value = evaluate_tree(tree.tokens(), [&](uint32_t p) { return (truth >> p) & 1; });
      ASSERT_EQ(value, evaluate_calls(calls, truth));
    }
  }
  EXPECT_GT(not_empty, 1500);
}

TEST(CsgTree, SubtractsOneMorePrimitive) {
  EXPECT_TRUE(subtract(CsgTree{}, 9).empty());
  EXPECT_EQ(text_of(subtract(build("0"), 9)), "0 9 -2");
  EXPECT_EQ(text_of(subtract(build("01"), 9)), "0 1 +2 9 -2");
  EXPECT_EQ(text_of(subtract(build("d01)"), 9)), "0 1 9 -3");
  EXPECT_EQ(text_of(subtract(build("i0d12))"), 9)), "0 1 2 -2 *2 9 -2");
}

TEST(CsgTree, SubtractedPrimitivesHoldNowhere) {
  std::mt19937 random(4);
  for (int round = 0; round < 1000; ++round) {
    const CsgTree tree = build(random_calls(random));
    const uint32_t cut = static_cast<uint32_t>(random() % 12);  // one of its own, or not
    const CsgTree less = subtract(tree, cut);
    expect_normal_form(less);
    for (int i = 0; i < 30; ++i) {
      const uint32_t truth = static_cast<uint32_t>(random());
      const auto inside = [&](uint32_t p) { return ((truth >> p) & 1) != 0; };
      const bool before = evaluate_tree(tree.tokens(), inside);
      ASSERT_EQ(evaluate_tree(less.tokens(), inside), before && !inside(cut));
    }
  }
}

TEST(Blist, CompiledTreesKeepTheirMeaning) {
  std::mt19937 random(2);
  for (int round = 0; round < 3000; ++round) {
    const CsgTree tree = build(random_calls(random));
    const Blist list = compile(tree);
    if (tree.empty()) {
      EXPECT_TRUE(list.tests.empty());
      EXPECT_FALSE(list.constant);
      continue;
    }
    for (uint32_t i = 0; i < list.tests.size(); ++i) {
      const BlistTest& test = list.tests[i];
      ASSERT_GT(test.if_inside, i);
      ASSERT_GT(test.if_outside, i);
      for (const uint32_t target : {test.if_inside, test.if_outside}) {
        ASSERT_TRUE(target >= kListFalse || target < list.tests.size());
      }
    }
    for (int i = 0; i < 30; ++i) {
      const uint32_t truth = static_cast<uint32_t>(random());
      const auto inside = [&](uint32_t p) { return ((truth >> p) & 1) != 0; };
      ASSERT_EQ(evaluate(std::span<const BlistTest>(list.tests), inside),
                evaluate_tree(tree.tokens(), inside));
    }
  }
}

TEST(Blist, ComplementsAreWhatIsTakenAway) {
  const Blist list = compile(build("d0d12)u34))"));  // 0 − (1 − 2) − 3 − 4
  std::vector<int> complements;
  for (const BlistTest& test : list.tests) complements.push_back(test.complement);
  EXPECT_THAT(complements, testing::ElementsAre(0, 1, 0, 1, 1));
}

TEST(Blist, KnowsUnions) {
  EXPECT_TRUE(is_union(compile(build("0")).tests));
  EXPECT_TRUE(is_union(compile(build("012")).tests));
  EXPECT_FALSE(is_union(compile(build("i01)")).tests));
  EXPECT_FALSE(is_union(compile(build("d01)")).tests));
  EXPECT_FALSE(is_union(compile(build("0i12)")).tests));
}

TEST(CsgTree, AMillionLevelsDeep) {
  constexpr uint32_t kLevels = 1'000'000;
  CsgTreeBuilder builder;
  for (uint32_t i = 0; i < kLevels; ++i) {
    builder.open(i % 2 == 0 ? Op::kDifference : Op::kUnion);
    if (i % 2 == 0) builder.primitive(2 * i);
  }
  builder.primitive(2 * kLevels);
  for (uint32_t i = 0; i < kLevels; ++i) {
    builder.primitive(2 * i + 1);
    builder.close();
  }
  const CsgTree tree = builder.finish();
  EXPECT_GT(tree.tokens().size(), size_t{kLevels});
  const Blist list = compile(tree);
  EXPECT_EQ(list.tests.size(), kLevels + kLevels / 2 + 1);
  std::mt19937 random(3);
  for (int i = 0; i < 5; ++i) {
    std::vector<bool> truth(2 * kLevels + 1);
    for (size_t p = 0; p < truth.size(); ++p) truth[p] = random() % 1000 < (p % 2 == 0 ? 999 : 1);
    const auto inside = [&](uint32_t p) { return static_cast<bool>(truth[p]); };
    EXPECT_EQ(evaluate(std::span<const BlistTest>(list.tests), inside),
              evaluate_tree(tree.tokens(), inside));
  }
}

}  // namespace
}  // namespace csgcore
