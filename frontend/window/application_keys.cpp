// What the keys do: the commands of the table, and what the mouse does, too.
#include <algorithm>

#include "application.hpp"
#include "commands.hpp"

namespace window {
namespace {

/// A key turns by so much, of which whole numbers make a quarter of a turn.
constexpr double kKeyTurn_deg = 5;
/// A key pans by this share of the picture's height.
constexpr double kKeyPan = 0.05;
/// A key moves the section plane by this share of the design's size.
constexpr double kKeySection = 0.02;

}  // namespace

void Application::key(int key, uint8_t modifiers) {
  hover_.stop();
  if (const PictureKey* picture_key = find_picture_key(key, modifiers)) {
    press(*picture_key);
  } else if (const CommandRow* row = find_command(key, modifiers)) {
    run_command(row->command);
  }
}

/// Does what a drag in a key's direction would do, or a click at the picture's middle.
void Application::press(const PictureKey& key) {
  const Size size = window_.size();
  switch (key.action) {
    case PictureKey::Action::kMeasure:
      click(kNone, 0.5 * size.width_px, 0.5 * size.height_px);
      return;
    case PictureKey::Action::kTurn:
      state_.navigation.turn_by(key.up * kKeyTurn_deg, -key.right * kKeyTurn_deg);
      break;
    case PictureKey::Action::kPan: {
      const double step_px = kKeyPan * size.height_px;
      state_.navigation.pan(key.right * step_px, -key.up * step_px, size);
      break;
    }
    case PictureKey::Action::kMoveSection:
      state_.move_section(key.up * kKeySection);
      break;
  }
  is_moving_ = true;
  end_hover();
}

/// Zooms by the signs that a keyboard has, wherever it has them.
void Application::character(unsigned character) {
  if (character == '+' || character == '=') run_command(Command::kZoomIn);
  if (character == '-') run_command(Command::kZoomOut);
}

void Application::open_menu() {
  hover_.stop();
  state_.enters_menus = true;
}

}  // namespace window
