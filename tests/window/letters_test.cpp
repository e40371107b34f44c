// Tests that the letters of all texts are found, and only when they are needed.
#include "letters.hpp"

#include <gtest/gtest.h>
#include <imgui.h>

#include <array>
#include <optional>

namespace window {
namespace {

class LettersTest : public testing::Test {
 protected:
  LettersTest() {
    ImGui::CreateContext();
    ImGui::GetIO().IniFilename = nullptr;
    letters_.emplace(1.0f);
  }
  ~LettersTest() override {
    letters_.reset();
    ImGui::DestroyContext();
  }
  static bool has(ImWchar letter) {
    ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
    if (!atlas.IsBuilt()) atlas.Build();
    return atlas.Fonts[0]->FindGlyphNoFallback(letter) != nullptr;
  }
  std::optional<Letters> letters_;
};

TEST_F(LettersTest, OfUsualTextsAreThere) {
  letters_->need("MODULE möbel(): × 3 … \u2265");
  EXPECT_FALSE(letters_->load());
  EXPECT_TRUE(has('A'));
}

/// DejaVu, which the window takes at first, has Georgian letters, too; others have more.
TEST_F(LettersTest, OfOtherTextsAreLookedUp) {
  constexpr char32_t kAn = 0x10D0, kBan = 0x10D1;
  if (frontend::fonts_with(std::array{kAn, kBan}).empty()) GTEST_SKIP() << "no font has them";
  letters_->need("a: \u10D0");
  EXPECT_TRUE(letters_->load());
  EXPECT_TRUE(has(kAn));
  EXPECT_FALSE(has(kBan)) << "nobody has asked for it";
  letters_->need("\u10D0");
  EXPECT_FALSE(letters_->load()) << "it is there";
  letters_->need("\u10D1\u10D0");
  EXPECT_TRUE(letters_->load());
  EXPECT_TRUE(has(kAn));
  EXPECT_TRUE(has(kBan));
  EXPECT_TRUE(has('A'));
}

TEST_F(LettersTest, ThatNoFontHasAreAskedForOnce) {
  letters_->need("\uE0FF \xFF\xC3");  // for private use; and no UTF-8
  letters_->load();
  letters_->need("\uE0FF \xFF\xC3");
  EXPECT_FALSE(letters_->load());
}

}  // namespace
}  // namespace window
