// Tests the table of commands: keys, and the texts for the menu and the help sheet.
#include "commands.hpp"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

#include <map>
#include <set>
#include <string>
#include <utility>

namespace window {
namespace {

/// Parses the text of a shortcut, independently of the table.
std::pair<int, uint8_t> key_of(std::string text) {
  uint8_t modifiers = kNone;
  const auto take = [&](const std::string& prefix, uint8_t modifier) {
    if (!text.starts_with(prefix)) return;
    text.erase(0, prefix.size());
    modifiers |= modifier;
  };
  take("Ctrl+", kControl);
  take("Shift+", kShift);
  // GLFW's numbers of letters, digits and signs are their ASCII codes.
  if (text.size() == 1) return {text[0], modifiers};
  if (text == "Esc") return {GLFW_KEY_ESCAPE, modifiers};
  if (text == "Space") return {GLFW_KEY_SPACE, modifiers};
  if (text[0] == 'F') return {GLFW_KEY_F1 + std::stoi(text.substr(1)) - 1, modifiers};
  return {-1, modifiers};
}

TEST(Commands, NoTwoShareAKey) {
  std::set<std::pair<int, uint8_t>> keys;
  for (const CommandRow& row : command_rows()) {
    if (row.key == 0) continue;
    EXPECT_TRUE(keys.insert({row.key, row.modifiers}).second) << row.label;
  }
}

TEST(Commands, EachStandsInTheTableOnce) {
  std::set<Command> commands;
  for (const CommandRow& row : command_rows()) {
    EXPECT_TRUE(commands.insert(row.command).second) << row.label;
    EXPECT_STRNE(row.label, "");
  }
}

TEST(Commands, ShortcutsSayWhichKeyItIs) {
  for (const CommandRow& row : command_rows()) {
    if (row.key == 0) {
      EXPECT_STREQ(row.shortcut, "") << row.label;
    } else {
      EXPECT_EQ(key_of(row.shortcut), std::pair(row.key, row.modifiers)) << row.label;
    }
  }
}

TEST(Commands, AreFoundByTheirKeys) {
  for (const CommandRow& row : command_rows()) {
    if (row.key == 0) continue;
    EXPECT_EQ(find_command(row.key, row.modifiers), &row) << row.label;
  }
  EXPECT_EQ(find_command(0, kNone), nullptr);
  EXPECT_EQ(find_command(GLFW_KEY_Q, kNone), nullptr);
  EXPECT_EQ(find_command(GLFW_KEY_0, kShift), nullptr);
}

/// OpenSCAD's keys (frontend/OPENSCAD.md, "Window").
TEST(Commands, OpenScadsKeys) {
  const std::map<std::string, Command> kKeys = {
      {"Ctrl+1", Command::kEdges},        {"Ctrl+2", Command::kAxes},
      {"Ctrl+3", Command::kCrosshairs},   {"Ctrl+4", Command::kTop},
      {"Ctrl+5", Command::kBottom},       {"Ctrl+6", Command::kLeft},
      {"Ctrl+7", Command::kRight},        {"Ctrl+8", Command::kFront},
      {"Ctrl+9", Command::kBack},         {"Ctrl+0", Command::kDiagonal},
      {"Ctrl+Shift+0", Command::kCenter}, {"Ctrl+Shift+V", Command::kViewAll},
      {"Ctrl+]", Command::kZoomIn},       {"Ctrl+[", Command::kZoomOut},
      {"F4", Command::kReload},           {"F5", Command::kReload},
      {"F7", Command::kExport},
  };
  for (const auto& [text, command] : kKeys) {
    const auto [key, modifiers] = key_of(text);
    const CommandRow* row = find_command(key, modifiers);
    ASSERT_NE(row, nullptr) << text;
    EXPECT_EQ(row->command, command) << text;
  }
}

}  // namespace
}  // namespace window
