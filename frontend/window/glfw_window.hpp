// The window itself: GLFW, an OpenGL context, Dear ImGui, and what the mouse and the keys do in it.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "navigation.hpp"

namespace window {

/// Told what happens in the window, from within GlfwWindow::wait() and poll(). Places and movements
/// in pixels of the picture, from its upper left corner.
class WindowEvents {
 public:
  virtual ~WindowEvents() = default;
  enum class Button : uint8_t { kLeft, kMiddle, kRight };
  /// With the button held.
  virtual void drag(Button button, uint8_t modifiers, double dx_px, double dy_px) = 0;
  /// A press and a release at the same place.
  virtual void click(double x_px, double y_px) = 0;
  virtual void double_click(double x_px, double y_px) = 0;
  virtual void wheel(double notches, double x_px, double y_px) = 0;
  virtual void key(int key, uint8_t modifiers) = 0;
};

/// One at a time. Throws frontend::Error where no window can be opened.
class GlfwWindow {
 public:
  GlfwWindow(const std::string& title, Size size, WindowEvents& events);
  ~GlfwWindow();
  GlfwWindow(const GlfwWindow&) = delete;
  GlfwWindow& operator=(const GlfwWindow&) = delete;

  bool is_closing() const;
  void close();
  /// Of the framebuffer; 0 by 0 while it is an icon.
  Size size() const;
  /// Pixels of the picture to one unit of ImGui's.
  double pixels_per_unit() const;
  /// The display's rate.
  double frames_per_second() const;
  void set_title(const std::string& title);

  /// Sleeps until something happens, or wake() is called.
  void wait();
  void wait(double timeout_s);
  void poll();
  /// From any thread.
  static void wake();
  /// Whether anything happened since the last call: ImGui then needs frames to follow it.
  bool take_activity();

  void begin_frame();
  /// Draws ImGui's frame over what is in the framebuffer, and shows all.
  void end_frame();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace window
