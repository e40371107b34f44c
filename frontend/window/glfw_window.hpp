// The window itself: GLFW, an OpenGL context, Dear ImGui, and the gestures of mouse and keys.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "navigation.hpp"

namespace window {

/// Receives the window's events, from within GlfwWindow::wait() and poll(). Places and movements
/// are in pixels of the picture, from its upper left corner.
class WindowEvents {
 public:
  virtual ~WindowEvents() = default;
  enum class Button : uint8_t { kLeft, kMiddle, kRight };
  virtual void press(Button button, double x_px, double y_px) = 0;
  /// The mouse has moved with the button held.
  virtual void drag(Button button, uint8_t modifiers, double dx_px, double dy_px) = 0;
  /// The left button was pressed and released at the same place.
  virtual void click(uint8_t modifiers, double x_px, double y_px) = 0;
  virtual void double_click(double x_px, double y_px) = 0;
  virtual void right_click() = 0;
  /// The mouse has moved without a button.
  virtual void move(double x_px, double y_px) = 0;
  virtual void leave() = 0;
  virtual void wheel(double notches, double x_px, double y_px) = 0;
  /// A key has gone down, or repeats, while the picture has the keys.
  virtual void key(int key, uint8_t modifiers) = 0;
  /// It has typed this character of Unicode.
  virtual void character(unsigned character) = 0;
  /// F10 was pressed, or Alt alone was pressed and released.
  virtual void open_menu() = 0;
  /// Files were dropped on the window.
  virtual void drop(const std::vector<std::string>& paths) = 0;
};

/// Where a window is on the screen, in the display's units.
struct Placement {
  Size size;
  /// That of the upper left corner of its contents; none: the window manager chooses it, as it does
  /// if this is not on the screen.
  std::optional<std::pair<int, int>> position;
  bool is_maximized = false;
  bool fits_screen = false;  // a size beyond the screen's is made smaller
};

/// There is one at a time. Throws frontend::Error if no window can be opened.
class GlfwWindow {
 public:
  GlfwWindow(const std::string& title, const Placement& placement, WindowEvents& events);
  ~GlfwWindow();
  GlfwWindow(const GlfwWindow&) = delete;
  GlfwWindow& operator=(const GlfwWindow&) = delete;

  bool is_closing() const;
  void close();
  /// The size of the framebuffer; 0 by 0 while the window is an icon.
  Size size() const;
  /// Pixels of the picture per unit of ImGui.
  double pixels_per_unit() const;
  /// The display's refresh rate.
  double frames_per_second() const;
  void set_title(const std::string& title);
  Placement placement() const;
  /// Returns whether that may have changed since the last call.
  bool take_placement_change();

  /// Sleeps until something happens, or wake() is called.
  void wait();
  void wait(double timeout_s);
  void poll();
  /// May be called from any thread.
  static void wake();
  /// Returns whether anything has happened since the last call, so that ImGui needs frames to
  /// follow it.
  bool take_activity();

  /// Returns whether the mouse is over a panel.
  bool is_over_panel() const;

  /// Notes the letters of a text that the next frame may show.
  void need_letters(std::string_view text);
  void begin_frame();
  /// Draws ImGui's frame over the contents of the framebuffer, and shows both.
  void end_frame();
  /// Ends ImGui's frame, and shows nothing of it.
  void drop_frame();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace window
