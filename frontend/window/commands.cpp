#include "commands.hpp"

#define GLFW_INCLUDE_NONE  // epoxy provides OpenGL
#include <GLFW/glfw3.h>

#include <algorithm>

namespace window {
namespace {

// The keys are OpenSCAD's (frontend/OPENSCAD.md, "Window") where it has them.
constexpr CommandRow kRows[] = {
    {Command::kOpenDesign, Menu::kFile, "Open…", "Ctrl+O", GLFW_KEY_O, kControl, false},
    {Command::kReload, Menu::kFile, "Reload", "F5", GLFW_KEY_F5, kNone, false},
    {Command::kStop, Menu::kFile, "Stop what takes long (Esc)", "", 0, kNone, false},
    {Command::kSavePicture, Menu::kFile, "Save picture…", "Ctrl+S", GLFW_KEY_S, kControl, false},
    {Command::kExport, Menu::kFile, "Export…", "F7", GLFW_KEY_F7, kNone, false},
    {Command::kCopy, Menu::kFile, "Copy what is measured or said", "Ctrl+C", GLFW_KEY_C, kControl,
     false},
    {Command::kOpenEditor, Menu::kFile, "Open in the editor", "E", GLFW_KEY_E, kNone, false},
    {Command::kLanguage2021, Menu::kFile, "Language of OpenSCAD 2021.01", "", 0, kNone, true},
    {Command::kLanguage2026, Menu::kFile, "Language of OpenSCAD 2026", "", 0, kNone, false},
    {Command::kQuit, Menu::kFile, "Quit", "Ctrl+Q", GLFW_KEY_Q, kControl, true},

    {Command::kViewAll, Menu::kView, "View all", "Ctrl+Shift+V", GLFW_KEY_V, kControl | kShift,
     false},
    {Command::kCenter, Menu::kView, "Centre", "Ctrl+Shift+0", GLFW_KEY_0, kControl | kShift, false},
    {Command::kZoomIn, Menu::kView, "Zoom in", "Ctrl+]", GLFW_KEY_RIGHT_BRACKET, kControl, false},
    {Command::kZoomOut, Menu::kView, "Zoom out", "Ctrl+[", GLFW_KEY_LEFT_BRACKET, kControl, false},
    {Command::kDiagonal, Menu::kView, "Diagonal", "Ctrl+0", GLFW_KEY_0, kControl, true},
    {Command::kTop, Menu::kView, "Top", "Ctrl+4", GLFW_KEY_4, kControl, false},
    {Command::kBottom, Menu::kView, "Bottom", "Ctrl+5", GLFW_KEY_5, kControl, false},
    {Command::kLeft, Menu::kView, "Left", "Ctrl+6", GLFW_KEY_6, kControl, false},
    {Command::kRight, Menu::kView, "Right", "Ctrl+7", GLFW_KEY_7, kControl, false},
    {Command::kFront, Menu::kView, "Front", "Ctrl+8", GLFW_KEY_8, kControl, false},
    {Command::kBack, Menu::kView, "Back", "Ctrl+9", GLFW_KEY_9, kControl, false},
    {Command::kPerspective, Menu::kView, "Perspective", "P", GLFW_KEY_P, kNone, true},
    {Command::kOrthographic, Menu::kView, "Orthographic", "O", GLFW_KEY_O, kNone, false},

    {Command::kAxes, Menu::kShow, "Axes", "Ctrl+2", GLFW_KEY_2, kControl, false},
    {Command::kCrosshairs, Menu::kShow, "Crosshairs", "Ctrl+3", GLFW_KEY_3, kControl, false},
    {Command::kScales, Menu::kShow, "Scale marks", "", 0, kNone, false},
    {Command::kEdges, Menu::kShow, "Edges", "Ctrl+1", GLFW_KEY_1, kControl, false},
    {Command::kGrid, Menu::kShow, "Ground grid", "G", GLFW_KEY_G, kNone, false},
    {Command::kOrientation, Menu::kShow, "Axes in the corner", "", 0, kNone, false},
    {Command::kSurface, Menu::kShow, "Surface", "1", GLFW_KEY_1, kNone, true},
    {Command::kCells, Menu::kShow, "Cells", "2", GLFW_KEY_2, kNone, false},
    {Command::kDepth, Menu::kShow, "Depth", "3", GLFW_KEY_3, kNone, false},
    {Command::kNormals, Menu::kShow, "Normals", "4", GLFW_KEY_4, kNone, false},
    {Command::kId, Menu::kShow, "Primitives", "5", GLFW_KEY_5, kNone, false},
    {Command::kParameters, Menu::kShow, "Parameters", "Ctrl+P", GLFW_KEY_P, kControl, true},
    {Command::kAnimation, Menu::kShow, "Animation", "A", GLFW_KEY_A, kNone, false},
    {Command::kPlay, Menu::kShow, "Play", "Space", GLFW_KEY_SPACE, kNone, false},
    {Command::kOpenScadShading, Menu::kShow, "OpenSCAD's shading", "Shift+L", GLFW_KEY_L, kShift,
     true},
    {Command::kPhongShading, Menu::kShow, "Phong's shading", "", 0, kNone, false},
    {Command::kStudioShading, Menu::kShow, "Studio's shading", "L", GLFW_KEY_L, kNone, false},
    {Command::kPhongShadows, Menu::kShow, "Shadows of Phong's light", "", 0, kNone, false},
    {Command::kDepthOrder, Menu::kShow, "Translucent parts by depth", "", 0, kNone, false},
    {Command::kStatus, Menu::kShow, "Status line", "", 0, kNone, true},
    {Command::kMessages, Menu::kShow, "Messages", "M", GLFW_KEY_M, kNone, false},
    {Command::kPlace, Menu::kShow, "Place of the point", "I", GLFW_KEY_I, kNone, false},

    {Command::kSection, Menu::kSection, "Section plane", "C", GLFW_KEY_C, kNone, false},
    {Command::kSectionX, Menu::kSection, "Across x", "X", GLFW_KEY_X, kNone, true},
    {Command::kSectionY, Menu::kSection, "Across y", "Y", GLFW_KEY_Y, kNone, false},
    {Command::kSectionZ, Menu::kSection, "Across z", "Z", GLFW_KEY_Z, kNone, false},
    {Command::kSectionFlip, Menu::kSection, "Other side", "F", GLFW_KEY_F, kNone, false},
    {Command::kSectionFace, Menu::kSection, "Along the measured face", "Shift+F", GLFW_KEY_F,
     kShift, true},
    {Command::kSectionPoints, Menu::kSection, "Through the last three points", "Shift+C",
     GLFW_KEY_C, kShift, false},

    {Command::kForgetPoints, Menu::kView, "Forget measured points", "Esc", GLFW_KEY_ESCAPE, kNone,
     true},
    {Command::kHelp, Menu::kHelp, "Mouse and keys", "F1", GLFW_KEY_F1, kNone, false},
};

/// Further keys of the same commands, as in OpenSCAD.
constexpr struct {
  int key;
  uint8_t modifiers;
  Command command;
} kFurtherKeys[] = {
    {GLFW_KEY_F4, kNone, Command::kReload},        {GLFW_KEY_F6, kNone, Command::kReload},
    {GLFW_KEY_W, kControl, Command::kQuit},        {GLFW_KEY_EQUAL, kControl, Command::kZoomIn},
    {GLFW_KEY_MINUS, kControl, Command::kZoomOut},
};

const CommandRow* row_of(Command command) {
  return std::find_if(std::begin(kRows), std::end(kRows),
                      [&](const CommandRow& row) { return row.command == command; });
}

using Action = PictureKey::Action;

constexpr PictureKey kPictureKeys[] = {
    {GLFW_KEY_LEFT, kNone, Action::kTurn, -1, 0},
    {GLFW_KEY_RIGHT, kNone, Action::kTurn, 1, 0},
    {GLFW_KEY_UP, kNone, Action::kTurn, 0, 1},
    {GLFW_KEY_DOWN, kNone, Action::kTurn, 0, -1},
    {GLFW_KEY_LEFT, kShift, Action::kPan, -1, 0},
    {GLFW_KEY_RIGHT, kShift, Action::kPan, 1, 0},
    {GLFW_KEY_UP, kShift, Action::kPan, 0, 1},
    {GLFW_KEY_DOWN, kShift, Action::kPan, 0, -1},
    {GLFW_KEY_PAGE_UP, kNone, Action::kMoveSection, 0, 1},
    {GLFW_KEY_PAGE_DOWN, kNone, Action::kMoveSection, 0, -1},
    {GLFW_KEY_ENTER, kNone, Action::kMeasure},
    {GLFW_KEY_KP_ENTER, kNone, Action::kMeasure},
};

}  // namespace

std::span<const CommandRow> command_rows() { return kRows; }

const CommandRow* find_command(int key, uint8_t modifiers) {
  for (const CommandRow& row : kRows) {
    if (row.key != 0 && row.key == key && row.modifiers == modifiers) return &row;
  }
  for (const auto& further : kFurtherKeys) {
    if (further.key == key && further.modifiers == modifiers) return row_of(further.command);
  }
  return nullptr;
}

const PictureKey* find_picture_key(int key, uint8_t modifiers) {
  for (const PictureKey& row : kPictureKeys) {
    if (row.key == key && row.modifiers == modifiers) return &row;
  }
  return nullptr;
}

}  // namespace window
