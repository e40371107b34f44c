// Tests color(): the colours that primitives get.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <vector>

#include "lower/imported_text.hpp"

namespace frontend {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

std::vector<float> color_of(const std::string& text) {
  const std::optional<csgcore::Color> color = only_primitive(text).color;
  if (!color) return {};
  return {color->r, color->g, color->b, color->a};
}

TEST(ImporterColor, TheOutermostValidOneWins) {
  EXPECT_THAT(color_of("color([1,0,0,1]) { color([0,1,0,1]) { sphere(); } }"),
              ElementsAre(1, 0, 0, 1));
  EXPECT_THAT(color_of("color([-1,-1,-1,1]) { color([0,1,0,0.5]) { sphere(); } }"),
              ElementsAre(0, 1, 0, 0.5f));
  EXPECT_THAT(color_of("color([-1,-1,-1,-1]) { sphere(); }"), IsEmpty());
  EXPECT_THAT(color_of("sphere();"), IsEmpty());
}

TEST(ImporterColor, EndsWithItsSubtree) {
  const ImportedDesign design = import_text("color([1,0,0]) { group() { sphere(); } } sphere();");
  EXPECT_TRUE(design.scene.primitives[0].color);
  EXPECT_FALSE(design.scene.primitives[1].color);
}

TEST(ImporterColor, MayBeWrittenByHand) {
  EXPECT_THAT(color_of("color(\"red\") { sphere(); }"), ElementsAre(1, 0, 0, 1));
  EXPECT_THAT(color_of("color(\"Lime\", 0.5) { sphere(); }"), ElementsAre(0, 1, 0, 0.5f));
  EXPECT_THAT(color_of("color(c = \"#0000ff\", alpha = 0.25) { sphere(); }"),
              ElementsAre(0, 0, 1, 0.25f));
  EXPECT_THAT(color_of("color(\"#f008\") { sphere(); }"), ElementsAre(1, 0, 0, 136 / 255.0f));
  EXPECT_THAT(color_of("color([0, 1]) { sphere(); }"), ElementsAre(0, 1, 1, 1));
  EXPECT_THAT(color_of("color([0, undef, 1]) { sphere(); }"), ElementsAre(0, 0, 1, 1));
}

TEST(ImporterColor, AChannelMayBeBrighterThanWhite) {
  EXPECT_THAT(color_of("color([0, 3, 0, 1]) { sphere(); }"), ElementsAre(0, 3, 0, 1));
  EXPECT_THAT(color_of("color([1e300, 0, 0, 2]) { sphere(); }"), ElementsAre(1000, 0, 0, 1));
}

TEST(ImporterColor, ANegativeChannelIsTheSchemesAndLetsInnerColorsWin) {
  EXPECT_THAT(color_of("color([-1,0,0,1]) { sphere(); }"), ElementsAre(-1, 0, 0, 1));
  EXPECT_THAT(color_of("color([-1,-1,-1,0.5]) { sphere(); }"), ElementsAre(-1, -1, -1, 0.5f));
  EXPECT_THAT(color_of("color([-1,0,0,1]) { color([0,0,1,1]) { sphere(); } }"),
              ElementsAre(0, 0, 1, 1));
  EXPECT_THAT(color_of("color([-1,0,0,1]) { color([-1,-1,-1,1]) { sphere(); } }"), IsEmpty());
}

TEST(ImporterColor, AnUnknownNameIsAWarning) {
  const ImportedDesign design = import_text("color(\"rad\") { sphere(); }");
  EXPECT_FALSE(design.scene.primitives[0].color);
  ASSERT_THAT(design.warnings, SizeIs(1));
  EXPECT_THAT(design.warnings[0].text,
              HasSubstr("a.csg:1:1: warning: color: \"rad\" is no colour"));
  EXPECT_THAT(warning_of("color(\"rad\"); color(\"rad\");"),
              HasSubstr("\"rad\" is no colour, and is ignored; the first of 2 (use a CSS"));
}

}  // namespace
}  // namespace frontend
