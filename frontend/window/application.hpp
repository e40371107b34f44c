// The live window's loop: news of the design, of the painter and of the user in, pictures out.
#pragma once

#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "frontend/design_follower.hpp"
#include "frontend/files.hpp"
#include "frontend/options.hpp"
#include "glfw_window.hpp"
#include "motion_meter.hpp"
#include "painter.hpp"
#include "panels.hpp"
#include "report.hpp"
#include "screen.hpp"
#include "state.hpp"

namespace window {

class Application final : private WindowEvents {
 public:
  /// Opens the window. Throws frontend::Error where none can be opened.
  explicit Application(const frontend::Options& options);

  /// Until the window is closed.
  void run();

 private:
  using Clock = std::chrono::steady_clock;

  // WindowEvents
  void drag(Button button, uint8_t modifiers, double dx_px, double dy_px) override;
  void click(double x_px, double y_px) override;
  void double_click(double x_px, double y_px) override;
  void wheel(double notches, double x_px, double y_px) override;
  void key(int key, uint8_t modifiers) override;

  void run_command(Command command);
  void save_picture(const std::string& path);
  void drag_section(double dx_px, double dy_px);

  void wait_for_news();
  bool watch_reading();
  bool take_news();
  void take_version(frontend::DesignVersion version);
  void take_painting(Painting painting);
  void take_finding(const Finding& finding);
  void write_picture(const Painting& painting);
  std::vector<frontend::NamedPath> inputs() const;

  void order_picture();
  PaintOrder wanted_picture() const;
  void probe(double x_px, double y_px, bool centers);
  void draw_frame();
  void report_picture();
  void wait_for_display();
  void show_title();

  const frontend::Options& options_;
  State state_;
  GlfwWindow window_;
  Screen screen_;
  Panels panels_;
  Report report_;
  MotionMeter motion_;
  const double frame_s_;  // the display's; asking for it takes a round trip to the X server
  Painter painter_;
  frontend::DesignFollower follower_;

  std::shared_ptr<const frontend::FileText> csg_;  // of the design that is shown
  PaintOrder ordered_;                             // the last
  uint64_t centering_ = 0;  // the probe after which the camera turns to what it finds
  uint64_t probes_ = 0;
  bool is_moving_ = false;   // since the last order: the camera, by the mouse
  bool has_camera_ = false;  // chosen by the command line, or by the first design
  std::string save_path_;    // where the next picture that stands is to be saved; empty: nowhere
  uint64_t saving_ = 0;      // the order of that; 0: not ordered yet
  uint64_t reported_version_ = 0;
  bool has_new_picture_ = false;
  int frames_due_ = 0;  // ImGui's answer to an event takes more than one
  Clock::time_point last_frame_{};
  Clock::time_point awaited_until_{};  // the picture that was ordered
  bool is_reading_ = false;            // the design, since then
  Clock::time_point reading_since_{};
};

}  // namespace window
