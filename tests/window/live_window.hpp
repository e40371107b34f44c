// The program with its window open on a display of its own, driven as its user would, and what it
// says of its pictures (--stats).
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "display.hpp"
#include "frontend/camera.hpp"
#include "process.hpp"
#include "temporary_folder.hpp"

namespace window_test {

using nlohmann::json;

/// The picture's size in these tests, where they do not change it.
constexpr uint32_t kWidth = 400, kHeight = 300;

/// Skipped where there is no display program.
class LiveWindow : public testing::Test {
 protected:
  void SetUp() override;
  /// The program's standard error, where the test failed.
  void TearDown() override;

  /// `design` is a path, or "-"; `options` go before it.
  void open(const std::string& design, const std::vector<std::string>& options = {},
            ProcessSetup setup = {});
  /// The same, with a window manager.
  void open_managed(const std::string& design, const std::vector<std::string>& options = {});

  /// The next picture for which `is_wanted` holds, as --stats has it; those before it are passed.
  json next(const std::function<bool(const json&)>& is_wanted);
  json next();
  /// With so many primitives, and no error.
  json next_of(std::size_t primitives);
  json next_error();
  /// After a drag or a wheel that was to change the camera to this.
  json next_camera(const frontend::Camera& camera, bool orthographic = false);

  /// All that the window shows.
  Picture shown() const;
  /// Of a picture of the window's size, what no panel covers while there are no messages.
  static Area free_area(uint32_t width = kWidth, uint32_t height = kHeight);
  /// The picture that `scadray -o` makes with the same camera.
  Picture drawn(const std::string& design, const json& camera, uint32_t width = kWidth,
                uint32_t height = kHeight, const std::vector<std::string>& options = {}) const;
  /// Waits until the window shows that picture in the area, to the last bit.
  void expect_shown(const Picture& whole, const Area& area = free_area());
  /// The window shows what -o makes of the design, by the camera of this line of --stats.
  void expect_drawn(const std::string& design, const json& line,
                    const std::vector<std::string>& options = {});
  /// Waits until the window's picture is another.
  void wait_until_other(const Picture& before);
  /// The same, and until it stands: a dialogue takes some frames.
  void wait_until_settled(const Picture& before);

  /// Keys as xdotool calls them, "ctrl+4".
  void key(const std::string& name) { display().drive({"key", name}); }
  /// From one place to another, over two between them. The buttons: 1 left, 2 middle, 3 right.
  void drag(int button, int from_x, int from_y, int to_x, int to_y,
            const std::string& held_key = "");
  void click(int x, int y, int times = 1);
  /// The wheel's notches at a place; below 0: backwards.
  void wheel(int x, int y, int notches);
  std::string title() const;
  /// xdotool's number of the window.
  std::string window_id() const;

  Display& display() { return *display_; }
  const Display& display() const { return *display_; }
  Process& program() { return *program_; }
  std::string errors() const { return folder_.read("errors"); }

  frontend::TemporaryFolder folder_;

 private:
  std::vector<std::string> placed(int x, int y) const;
  /// Lines of --stats that were not asked for yet.
  void read_lines();

  std::unique_ptr<Display> display_;
  std::unique_ptr<Process> program_;
  mutable std::string id_;
  std::size_t read_ = 0;  // bytes of --stats
  std::vector<json> lines_;
};

/// All of a number's digits.
std::string number_text(double number);
/// As --camera takes it.
std::string camera_option(const json& camera);
/// Of a line of --stats.
frontend::Camera camera_of(const json& line);

}  // namespace window_test
