// Everything that a key or the menu can ask for: one table, from which the keys are read and the
// menu and the help sheet are made.
#pragma once

#include <cstdint>
#include <span>

namespace window {

enum class Command : uint8_t {
  kReload,
  kSavePicture,
  kQuit,
  kViewAll,
  kCenter,
  kZoomIn,
  kZoomOut,
  kDiagonal,
  kTop,
  kBottom,
  kLeft,
  kRight,
  kFront,
  kBack,
  kPerspective,
  kOrthographic,
  kAxes,
  kCrosshairs,
  kScales,
  kEdges,
  kSurface,
  kCells,
  kDepth,
  kNormals,
  kId,
  kOpenScadShading,
  kPhongShading,
  kSection,
  kSectionX,
  kSectionY,
  kSectionZ,
  kSectionFlip,
  kForgetPoints,
  kMessages,
  kStatus,
  kHelp,
};

/// Of a key.
enum Modifiers : uint8_t { kNone = 0, kControl = 1, kShift = 2 };

enum class Menu : uint8_t { kFile, kView, kShow, kSection, kHelp };

struct CommandRow {
  Command command;
  Menu menu;
  const char* label;
  const char* shortcut;  // as the menu shows it
  int key;               // of GLFW; 0: none
  uint8_t modifiers;
  bool starts_group;  // a line stands before it in the menu
};

std::span<const CommandRow> command_rows();

/// Null where no command has that key.
const CommandRow* find_command(int key, uint8_t modifiers);

}  // namespace window
