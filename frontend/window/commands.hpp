// All commands of the keys and the menu, in one table, from which the keys are read and the menu
// and the help sheet are made; and the keys that do for the picture what the mouse does.
#pragma once

#include <cstdint>
#include <span>

namespace window {

enum class Command : uint8_t {
  kOpenDesign,
  kReload,
  kStop,
  kOpenEditor,
  kSavePicture,
  kExport,
  kCopy,
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
  kGrid,
  kOrientation,
  kSurface,
  kCells,
  kDepth,
  kNormals,
  kId,
  kOpenScadShading,
  kPhongShading,
  kStudioShading,
  kPhongShadows,
  kDepthOrder,
  kSection,
  kSectionX,
  kSectionY,
  kSectionZ,
  kSectionFlip,
  kSectionFace,
  kSectionPoints,
  kParameters,
  kAnimation,
  kPlay,
  kLanguage2021,
  kLanguage2026,
  kForgetPoints,
  kMessages,
  kPlace,
  kStatus,
  kHelp,
};

/// Modifiers of a key or a mouse button.
enum Modifiers : uint8_t { kNone = 0, kControl = 1, kShift = 2, kAlt = 4 };

enum class Menu : uint8_t { kFile, kView, kShow, kSection, kHelp };

struct CommandRow {
  Command command;
  Menu menu;
  const char* label;
  const char* shortcut;  // as the menu shows it
  int key;               // GLFW's number; 0: none
  uint8_t modifiers;
  bool starts_group;  // the menu has a line before it
};

std::span<const CommandRow> command_rows();

/// Returns the command of a key; null if there is none.
const CommandRow* find_command(int key, uint8_t modifiers);

/// A key that does for the picture what the mouse does.
struct PictureKey {
  enum class Action : uint8_t {
    kTurn,
    kPan,
    kMoveSection,
    kMeasure,
  };
  int key;  // GLFW's number
  uint8_t modifiers;
  Action action;
  int right = 0;  // the direction in the picture: 1, 0 or -1
  int up = 0;     // of the section plane: along its axis
};

/// Returns what a key does; null: nothing. Measuring is done once for each press, the rest again
/// and again while the key is held.
const PictureKey* find_picture_key(int key, uint8_t modifiers);

}  // namespace window
