// Tests how a solid is divided by its colours, against the definition.
#include "export/colored_parts.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>
#include <string>

#include "support/evaluate_tree.hpp"

namespace frontend {
namespace {

using csgcore::CsgToken;
using csgcore::CsgTree;
using csgcore::CsgTreeBuilder;
using csgcore::Op;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

/// Solids of a line: each primitive is an interval of whole numbers, with a colour or none.
struct Line {
  struct Part {
    int begin, end;
    int color;  // 0: none
  };
  std::vector<Part> parts;
  CsgTree tree;

  bool is_inside(uint32_t part, int cell) const {
    return parts[part].begin <= cell && cell < parts[part].end;
  }
  std::vector<csgcore::Box> boxes() const {
    std::vector<csgcore::Box> boxes;
    for (const Part& part : parts) {
      boxes.push_back({csgcore::Vec3(part.begin, 0, 0), csgcore::Vec3(part.end, 1, 1)});
    }
    return boxes;
  }
  std::vector<ColoredTree> divided() const {
    return colored_trees(tree, boxes(), [&](uint32_t part) { return color(parts[part].color); });
  }
  static std::optional<csgcore::Color> color(int number) {
    if (number == 0) return std::nullopt;
    return csgcore::Color{static_cast<float>(number), 0, 0, 1};
  }
};

constexpr int kOutside = -1;

/// Returns the colour of a cell by the definition; kOutside: it is not in the solid.
int color_at(const Line& line, int cell) {
  std::vector<int> values;
  for (const CsgToken& token : line.tree.tokens()) {
    if (token.is_primitive) {
      values.push_back(line.is_inside(token.value, cell) ? line.parts[token.value].color
                                                         : kOutside);
      continue;
    }
    const std::vector<int> operands(values.end() - token.value, values.end());
    values.resize(values.size() - token.value);
    int value = operands.front();
    for (size_t i = 1; i < operands.size(); ++i) {
      const bool is_inside = operands[i] != kOutside;
      if (token.op == Op::kUnion && is_inside) value = operands[i];
      if (token.op == Op::kIntersection && !is_inside) value = kOutside;
      if (token.op == Op::kDifference && is_inside) value = kOutside;
    }
    values.push_back(value);
  }
  return values.empty() ? kOutside : values.front();
}

void expect_division(const Line& line, int cells) {
  const std::vector<ColoredTree> parts = line.divided();
  for (int cell = 0; cell < cells; ++cell) {
    const int color = color_at(line, cell);
    int holders = 0;
    for (const ColoredTree& part : parts) {
      if (part.tree.empty() ||
          !test_support::evaluate_tree(part.tree.tokens(), [&](uint32_t primitive) {
            return line.is_inside(primitive, cell);
          })) {
        continue;
      }
      ++holders;
      EXPECT_EQ(part.color, Line::color(color)) << "cell " << cell;
    }
    EXPECT_EQ(holders, color == kOutside ? 0 : 1) << "cell " << cell;
  }
}

TEST(ColoredParts, OneColourIsTheWholeTree) {
  Line line{{{0, 4, 1}, {2, 6, 1}}, {}};
  CsgTreeBuilder builder;
  builder.primitive(0);
  builder.primitive(1);
  line.tree = builder.finish();
  ASSERT_THAT(line.divided(), SizeIs(1));
  EXPECT_EQ(line.divided()[0].color, Line::color(1));
  EXPECT_THAT(colored_trees({}, {}, [](uint32_t) { return std::nullopt; }), IsEmpty());
}

TEST(ColoredParts, TheLastOfAUnionKeepsItsVolume) {
  Line line{{{0, 4, 1}, {2, 6, 2}, {5, 9, 1}}, {}};
  CsgTreeBuilder builder;
  for (uint32_t i = 0; i < 3; ++i) builder.primitive(i);
  line.tree = builder.finish();
  std::string colors;
  for (int cell = 0; cell < 10; ++cell) colors += std::to_string(color_at(line, cell)) + ' ';
  EXPECT_EQ(colors, "1 1 2 2 2 1 1 1 1 -1 ");
  expect_division(line, 10);
}

TEST(ColoredParts, ASubtractedColourIsNoPart) {
  Line line{{{0, 8, 0}, {2, 4, 1}}, {}};
  CsgTreeBuilder builder;
  builder.open(Op::kDifference);
  builder.primitive(0);
  builder.primitive(1);
  builder.close();
  line.tree = builder.finish();
  ASSERT_THAT(line.divided(), SizeIs(1));
  EXPECT_EQ(line.divided()[0].color, std::nullopt);
  expect_division(line, 10);
}

TEST(ColoredParts, RandomTrees) {
  std::mt19937 random(7);
  const auto below = [&](int end) { return std::uniform_int_distribution(0, end - 1)(random); };
  for (int run = 0; run < 2000; ++run) {
    SCOPED_TRACE(run);
    constexpr int kCells = 24;
    Line line;
    CsgTreeBuilder builder;
    int depth = 0;
    const int steps = 2 + below(24);
    for (int i = 0; i < steps; ++i) {
      if (depth < 5 && below(3) == 0) {
        builder.open(static_cast<Op>(below(3)));
        ++depth;
      } else if (depth > 0 && below(4) == 0) {
        builder.close();
        --depth;
      } else {
        const int begin = below(kCells);
        builder.primitive(static_cast<uint32_t>(line.parts.size()));
        line.parts.push_back({begin, begin + 1 + below(kCells / 2), below(3)});
      }
    }
    for (; depth > 0; --depth) builder.close();
    line.tree = builder.finish();
    expect_division(line, 2 * kCells);
  }
}

/// A long union whose colours alternate makes no deep recursion, and takes no time.
TEST(ColoredParts, AlternatingColours) {
  Line line;
  CsgTreeBuilder builder;
  for (int i = 0; i < 20000; ++i) {
    builder.primitive(static_cast<uint32_t>(i));
    line.parts.push_back({i, i + 2, i % 2 + 1});
  }
  line.tree = builder.finish();
  EXPECT_THAT(line.divided(), SizeIs(2));
}

}  // namespace
}  // namespace frontend
