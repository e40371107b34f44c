// Tests the modifiers % # ! *, compared with OpenSCAD 2021.01's pictures.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "lower/imported_text.hpp"

namespace frontend {
namespace {

using csgcore::Vec3;
using ::testing::IsEmpty;
using ::testing::SizeIs;

TEST(ImporterModifiers, BackgroundTakesNoPart) {
  EXPECT_EQ(trees_of("%sphere(); sphere();"), "1 | 0 | -");
  EXPECT_EQ(trees_of("difference() { %sphere(); sphere(); sphere(); }"), "(1-2) | 0 | -");
  EXPECT_EQ(trees_of("intersection() { sphere(); %sphere(); }"), "0 | 1 | -");
  EXPECT_EQ(trees_of("%difference() { sphere(); sphere(); } sphere();"), "2 | (0-1) | -");
  EXPECT_EQ(trees_of("%difference() { sphere(); %sphere(); }"), "- | (0+1) | -");
}

TEST(ImporterModifiers, NothingButBackgroundIsNoEmptyOperand) {
  EXPECT_EQ(trees_of("intersection() { group() { %sphere(); } sphere(); }"), "1 | 0 | -");
  EXPECT_EQ(trees_of("difference() { group() { %sphere(); } sphere(); sphere(); }"),
            "(1-2) | 0 | -");
}

TEST(ImporterModifiers, BackgroundKeepsPlaceAndColor) {
  const ImportedDesign design =
      import_text("color([0,0,1]) { multmatrix([[1,0,0,3]]) { %sphere(); } }");
  ASSERT_THAT(design.scene.primitives, SizeIs(1));
  EXPECT_EQ(design.scene.primitives[0].color->b, 1);
  EXPECT_EQ(design.scene.primitives[0].local_to_world.translation.x, 3);
}

TEST(ImporterModifiers, HighlightInAUnionIsOnlyOverlaid) {
  EXPECT_EQ(trees_of("#sphere(); sphere();"), "1 | - | 0");
  EXPECT_EQ(trees_of("group() { #sphere(); } sphere();"), "1 | - | 0");
  EXPECT_EQ(trees_of("difference() { group() { #sphere(); sphere(); } sphere(); }"),
            "(1-2) | - | 0");
}

TEST(ImporterModifiers, HighlightElsewhereTakesPartToo) {
  EXPECT_EQ(trees_of("difference() { sphere(); #sphere(); }"), "(0-1) | - | 1");
  EXPECT_EQ(trees_of("intersection() { sphere(); #sphere(); }"), "(0*1) | - | 1");
}

TEST(ImporterModifiers, AHighlightedFirstOperandHighlightsTheDifference) {
  EXPECT_EQ(trees_of("difference() { #sphere(); sphere(); } sphere();"), "2 | - | (0-1)");
  EXPECT_EQ(trees_of("intersection() { #sphere(); #sphere(); } sphere();"), "2 | - | (0*1)");
}

TEST(ImporterModifiers, AHighlightedDifferenceHidesTheHighlightsOfWhatItTakesAway) {
  EXPECT_EQ(trees_of("difference() { #sphere(); #sphere(); }"), "(0-1) | - | (0-1)");
  EXPECT_EQ(trees_of("difference() { #sphere(); sphere(); #sphere(); }"), "(0-1-2) | - | (0-1-2)");
}

TEST(ImporterModifiers, WhatMissesTheBodyIsHighlightedAllTheSame) {
  const std::string aside = "multmatrix([[1,0,0,9],[0,1,0,0],[0,0,1,0],[0,0,0,1]]) { sphere(); }";
  EXPECT_EQ(trees_of("difference() { sphere(); #" + aside + " }"), "(0-1) | - | 1");
}

TEST(ImporterModifiers, WhereAllIsHighlightedItIsDrawnToo) {
  EXPECT_EQ(trees_of("#sphere();"), "0 | - | 0");
  EXPECT_EQ(trees_of("#sphere(); group() { #sphere(); }"), "(0+1) | - | (0+1)");
}

TEST(ImporterModifiers, HighlightsNest) {
  EXPECT_EQ(trees_of("#difference() { sphere(); #sphere(); } sphere();"), "2 | - | ((0-1)+1)");
  EXPECT_EQ(trees_of("%difference() { sphere(); #sphere(); } sphere();"), "2 | (0-1) | 1");
  EXPECT_EQ(trees_of("#group() { sphere(); %sphere(); } sphere();"), "2 | 1 | 0");
  EXPECT_EQ(trees_of("%difference() { #sphere(); sphere(); } sphere();"), "2 | (0-1) | (0-1)");
  EXPECT_EQ(trees_of("%#sphere(); sphere();"), "1 | 0 | 0");
  EXPECT_EQ(trees_of("render() { #sphere(); } sphere();"), "(0+1) | - | -");
  EXPECT_EQ(trees_of("render() { %sphere(); sphere(); } sphere();"), "(1+2) | - | -");
}

TEST(ImporterModifiers, RenderedIsTheSolidAlone) {
  ImportOptions rendered;
  rendered.picture = PictureKind::kRendered;
  EXPECT_EQ(trees_of("#sphere(); %sphere(); sphere();", rendered), "(0+2) | - | -");
  EXPECT_EQ(trees_of("difference() { sphere(); #group() { %sphere(); #sphere(); } }", rendered),
            "(0-2) | - | -");
  EXPECT_EQ(trees_of("difference() { %sphere(); sphere(); sphere(); }", rendered), "(1-2) | - | -");
  EXPECT_EQ(trees_of("%sphere();", rendered), "- | - | -");
  const std::string meets_group = "intersection() { group() { %sphere(); } sphere(); }";
  EXPECT_EQ(trees_of(meets_group, rendered), "- | - | -");
  EXPECT_EQ(trees_of("intersection() { %sphere(); sphere(); }", rendered), "1 | - | -");
  const ImportedDesign red = import_text("color(\"red\") { sphere(); }", rendered);
  EXPECT_FALSE(red.scene.primitives.at(0).color);
  EXPECT_TRUE(import_text("color(\"red\") { sphere(); }").scene.primitives.at(0).color);
}

TEST(ImporterModifiers, DeeplyNestedHighlightsStayInProportion) {
  constexpr int kLevels = 5000;
  std::string text;
  for (int i = 0; i < kLevels; ++i) text += "#difference() { sphere(); ";
  text.append(kLevels, '}');
  const ImportedDesign design = import_text("sphere();" + text);
  size_t tokens = 0;
  for (const csgcore::Layer& layer : design.scene.layers) tokens += layer.solid.tokens().size();
  EXPECT_LT(tokens, 20u * kLevels);
}

TEST(ImporterModifiers, AnIntersectionOfDisjointBoxesKeepsItsHighlightedOperands) {
  const std::string aside = "multmatrix([[1,0,0,2.5],[0,1,0,0],[0,0,1,0],[0,0,0,1]]) { sphere(); }";
  EXPECT_EQ(trees_of("intersection() { #sphere(); #" + aside + " }"), "(0*1) | - | (0+1)");
}

TEST(ImporterModifiers, RootAndDisable) {
  EXPECT_EQ(model_of("sphere(); *sphere(); sphere();"), "(0+1)");
  EXPECT_EQ(model_of("difference() { *sphere(); sphere(); sphere(); }"), "(0-1)");
  EXPECT_EQ(model_of("sphere(); group() { sphere(); !sphere(); }"), "2");
  EXPECT_EQ(model_of("*group() { !sphere(); } sphere();"), "0");
  EXPECT_EQ(model_of("!*sphere(); sphere();"), "0");
  // The new root loses its place and its colour.
  EXPECT_EQ(only_primitive("multmatrix([[1,0,0,3]]) { color([1,0,0]) { !sphere(); } }")
                .local_to_world.translation,
            Vec3(0.0));
  EXPECT_THAT(warnings_of("!sphere(); polygon();"), IsEmpty());
  EXPECT_THAT(warnings_of("sphere(); *polygon();"), IsEmpty());
}

}  // namespace
}  // namespace frontend
