#include "language/node_tree.hpp"

#include <gtest/gtest.h>

#include <array>
#include <utility>

#include "language/make.hpp"

namespace language {
namespace {

constexpr std::array<double, 3> kSizes = {1, 2, 3};

/// Returns two nodes, the second of which is a child of the first.
NodeTree tree_of_two(double radius = 4, uint32_t offset = 7) {
  NodeTree tree;
  const uint32_t cube = tree.open(NodeKind::kCube, 0, {0, 3});
  tree.add("size", kSizes, ArgumentStyle::kGeneral);
  const uint32_t sphere = tree.open(NodeKind::kSphere, kHighlightModifier, {0, offset});
  tree.add("r", radius, ArgumentStyle::kGeneral);
  tree.add("origin", kSizes, ArgumentStyle::kGeneral);
  tree.close(sphere);
  tree.close(cube);
  return tree;
}

TEST(NodeTree, KeepsArgumentsApart) {
  const NodeTree tree = tree_of_two();
  EXPECT_EQ(tree.nodes[0].end, 2u);
  ASSERT_EQ(tree.arguments_of(tree.nodes[0]).size(), 1u);
  ASSERT_EQ(tree.arguments_of(tree.nodes[1]).size(), 2u);
  EXPECT_EQ(tree.numbers_of(tree.arguments_of(tree.nodes[0])[0])[2], 3);
  EXPECT_EQ(tree.arguments_of(tree.nodes[1])[0].value.number(), 4);
  EXPECT_TRUE(tree.numbers_of(tree.arguments_of(tree.nodes[1])[0]).empty());
}

TEST(NodeTree, RemovesNodesWithWhatTheyHave) {
  NodeTree tree = tree_of_two();
  tree.remove(1);
  EXPECT_EQ(tree.size(), 1u);
  EXPECT_EQ(tree.arguments.size(), 1u);
  EXPECT_EQ(tree.numbers.size(), 3u);
  EXPECT_EQ(tree.arguments_of(tree.nodes[0]).size(), 1u);
  tree.remove(0);
  EXPECT_EQ(tree.size() + tree.arguments.size() + tree.numbers.size(), 0u);
}

TEST(NodeTree, HasSubtrees) {
  NodeTree tree = tree_of_two();
  tree.close(tree.open(NodeKind::kCube, 0, {0, 20}));
  const NodeTree sphere = tree.subtree(1);
  ASSERT_EQ(sphere.size(), 1u);
  EXPECT_EQ(sphere.nodes[0].end, 1u);
  EXPECT_EQ(sphere.nodes[0].place, (Place{0, 7}));
  ASSERT_EQ(sphere.arguments.size(), 2u);
  EXPECT_EQ(sphere.arguments[0].value.number(), 4);
  EXPECT_EQ(sphere.numbers_of(sphere.arguments[1])[2], 3);
  EXPECT_EQ(tree.subtree(0).nodes[1].end, 2u);
}

TEST(NodeTree, FindsRootModifiers) {
  NodeTree tree = tree_of_two();
  EXPECT_FALSE(root_modifiers(tree).shown);
  tree.close(tree.open(NodeKind::kCube, kRootModifier, {0, 20}));
  tree.close(tree.open(NodeKind::kCube, kRootModifier, {0, 20}));
  EXPECT_EQ(root_modifiers(tree).shown, 2u);
  EXPECT_FALSE(root_modifiers(tree).other) << "both stem from one call";
  tree.close(tree.open(NodeKind::kCube, kRootModifier, {0, 30}));
  EXPECT_EQ(root_modifiers(tree).other, (Place{0, 30}));
}

TEST(GrowingArray, KeepsItsElementsWhereverTheyLie) {
  constexpr int kCount = 5000;
  const Value text = make_string("text");
  GrowingArray<Value> array;
  for (int i = 0; i < kCount; ++i) array.push_back(text);
  EXPECT_EQ(text.object()->references, kCount + 1u);
  array.truncate(10);
  EXPECT_EQ(text.object()->references, 11u);
  GrowingArray<Value> moved = std::move(array);
  ASSERT_EQ(moved.size(), 10u);
  EXPECT_EQ(moved.back().text(), "text");
  moved = {};
  EXPECT_EQ(text.object()->references, 1u);
}

}  // namespace
}  // namespace language
