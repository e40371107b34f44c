// The live window's loop: takes news of the design, the painter and the user, and shows pictures.
#pragma once

#include <array>
#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "commands.hpp"
#include "editor.hpp"
#include "frontend/design_follower.hpp"
#include "frontend/files.hpp"
#include "frontend/options.hpp"
#include "glfw_window.hpp"
#include "hover_timer.hpp"
#include "memory.hpp"
#include "model_exporter.hpp"
#include "motion_meter.hpp"
#include "navigation.hpp"
#include "painter.hpp"
#include "panels/panels.hpp"
#include "report.hpp"
#include "screen.hpp"
#include "state.hpp"

namespace window {

class Application final : private WindowEvents {
 public:
  /// Opens the window. Throws frontend::Error if none can be opened.
  explicit Application(const frontend::Options& options);

  /// Returns when the window is closed.
  void run();

 private:
  using Clock = std::chrono::steady_clock;

  // WindowEvents
  void press(Button button, double x_px, double y_px) override;
  void drag(Button button, uint8_t modifiers, double dx_px, double dy_px) override;
  void click(uint8_t modifiers, double x_px, double y_px) override;
  void double_click(double x_px, double y_px) override;
  void right_click() override;
  void move(double x_px, double y_px) override;
  void leave() override;
  void wheel(double notches, double x_px, double y_px) override;
  void key(int key, uint8_t modifiers) override;
  void character(unsigned character) override;
  void open_menu() override;
  void drop(const std::vector<std::string>& paths) override;

  void run_command(Command command);
  void press(const PictureKey& key);
  void save_picture(const std::string& path);
  void export_model(const std::string& path);
  void open_design(const std::string& path);
  void begin_design();
  void remember();
  void write_memory();
  std::string path_of(const MessagePlace& place) const;
  void open_place(const MessagePlace& place);
  void open_chosen_place();
  void drag_section(double dx_px, double dy_px);

  void wait_for_news();
  std::optional<double> seconds_to_next_look() const;
  bool watch_reading();
  int watch_long_work();
  bool is_drawing() const;
  std::array<std::optional<frontend::Activity>, 3> activities() const;
  std::optional<Clock::time_point> watch_work();
  bool is_worth_stopping();
  void stop_work();
  bool take_news();
  void take_version(frontend::DesignVersion version);
  void take_painting(Painting painting);
  void take_finding(const Finding& finding);
  void take_outcome(const ModelOutcome& outcome);
  void write_picture(const Painting& painting);
  std::vector<frontend::NamedPath> inputs() const;

  void order_picture();
  PaintOrder wanted_picture() const;
  void probe(const PicturePoint& place, Probe::Purpose purpose, double snap_px = 0);
  void probe_hover();
  void end_hover();
  void lay_out_panels();
  void begin_frame();
  void draw_panels();
  void draw_frame();
  void note_shown();
  void report_picture();
  void wait_for_display();
  void show_title();
  void take_camera(const frontend::DesignCamera& asked);
  bool shows_inputs() const;
  bool play();
  void update_inputs();

  frontend::Options options_;  // its input is the design that is shown
  Memory memory_;
  State state_;
  GlfwWindow window_;
  Screen screen_;
  const PanelActions actions_;
  Report report_;
  MotionMeter motion_;
  const double frame_s_;  // time of a frame; asking the display for it takes a round trip to the X
                          // server
  Editor editor_;
  Painter painter_;
  ModelExporter exporter_;
  frontend::DesignFollower follower_;

  frontend::DesignTree tree_;            // of the design that is shown
  frontend::DesignInputs inputs_;        // that the follower has been given
  frontend::DesignCamera asked_camera_;  // that the newest version asks for
  PaintOrder ordered_;                   // the last order
  uint64_t probes_ = 0;
  HoverTimer hover_;
  Pan pan_;
  uint64_t hovering_ = 0;            // number of the probe at the mouse's place; 0: none
  bool is_moving_ = false;           // the mouse has moved the camera since the last order
  bool has_camera_ = false;          // the command line or the first design has chosen the camera
  std::string save_path_;            // where to save the next final picture; empty: nowhere
  uint64_t saving_ = 0;              // number of the order for saving; 0: not ordered yet
  bool is_picture_stopped_ = false;  // the last order was given up at the user's wish
  uint64_t reported_version_ = 0;
  double save_to_screen_ms_ = -1;  // until it is reported; negative: there is none
  bool shows_version_ = false;     // the next frame has a picture of the newest version
  bool has_new_picture_ = false;
  std::string opening_;        // the path of the design that was chosen, until it is opened
  uint64_t oldest_order_ = 0;  // number of the first order for the design that is shown
  int frames_due_ = 0;  // frames still to draw: ImGui's answer to an event takes more than one
  Clock::time_point last_frame_{};
  Clock::time_point awaited_until_{};  // until when to wait for the picture that was ordered
  bool is_reading_ = false;            // the design is being read, since reading_since_
  Clock::time_point reading_since_{};
  std::optional<Clock::time_point> working_since_;  // reading, rendering or drawing, one by one
};

}  // namespace window
