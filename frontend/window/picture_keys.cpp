#include "picture_keys.hpp"

#define GLFW_INCLUDE_NONE  // epoxy provides OpenGL
#include <GLFW/glfw3.h>

#include "commands.hpp"

namespace window {
namespace {

using Action = PictureKey::Action;

constexpr PictureKey kKeys[] = {
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

const PictureKey* find_picture_key(int key, uint8_t modifiers) {
  for (const PictureKey& row : kKeys) {
    if (row.key == key && row.modifiers == modifiers) return &row;
  }
  return nullptr;
}

}  // namespace window
