// Runs the program with its window on a display of its own, drives it as a user does, and reads
// what it reports of its pictures (--stats).
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

/// The picture's size in these tests, unless they change it.
constexpr uint32_t kWidth = 400, kHeight = 300;

/// Skips its tests if there is no display program.
class LiveWindow : public testing::Test {
 protected:
  void SetUp() override;
  /// Prints the program's standard error if the test failed.
  void TearDown() override;

  /// `design` is a path, or "-"; `options` go before it. Nothing is remembered of other windows,
  /// unless `setup` gives a folder for that.
  void open(const std::string& design, const std::vector<std::string>& options = {},
            ProcessSetup setup = {});
  /// Opens it with a window manager.
  void open_managed(const std::string& design, const std::vector<std::string>& options = {});

  /// Returns the next line of --stats for which `is_wanted` holds; earlier ones are skipped.
  json next(const std::function<bool(const json&)>& is_wanted);
  json next();
  /// Returns the next line with so many primitives, and no error.
  json next_of(std::size_t primitives);
  json next_error();
  /// Returns the line after a drag or a wheel that was to give the camera this value.
  json next_camera(const frontend::Camera& camera, bool orthographic = false);

  /// Returns all that the window shows.
  Picture shown() const;
  /// Returns the area of a picture of the window's size that no panel covers while there are no
  /// messages.
  static Area free_area(uint32_t width = kWidth, uint32_t height = kHeight);
  /// Returns the picture that `scadray -o` makes with the same camera.
  Picture drawn(const std::string& design, const json& camera, uint32_t width = kWidth,
                uint32_t height = kHeight, const std::vector<std::string>& options = {}) const;
  /// Waits until the window shows that picture in the area, exact to the last bit.
  void expect_shown(const Picture& whole, const Area& area = free_area());
  /// Expects that the window shows what -o makes of the design, with the camera of this line of
  /// --stats.
  void expect_drawn(const std::string& design, const json& line,
                    const std::vector<std::string>& options = {});
  /// Waits until the window shows another picture.
  void wait_until_other(const Picture& before);
  /// Waits until the window shows another picture that does not change any more: a dialogue takes
  /// some frames.
  void wait_until_settled(const Picture& before);

  /// Presses a key by xdotool's name, "ctrl+4".
  void key(const std::string& name) { display().drive({"key", name}); }
  /// Drags from one place to another, over two between them. Buttons: 1 left, 2 middle, 3 right.
  void drag(int button, int from_x, int from_y, int to_x, int to_y,
            const std::string& held_key = "");
  void click(int x, int y, int times = 1);
  /// Turns the wheel by that many notches at a place; below 0: backwards.
  void wheel(int x, int y, int notches);
  std::string title() const;
  /// Returns xdotool's number of the window.
  std::string window_id() const;

  Display& display() { return *display_; }
  const Display& display() const { return *display_; }
  Process& program() { return *program_; }
  std::string errors() const { return folder_.read("errors"); }

  frontend::TemporaryFolder folder_;
  bool gives_size_ = true;  // open() gives the program --imgsize

 private:
  std::vector<std::string> placed(int x, int y) const;
  /// Reads the lines of --stats that have not been read yet.
  void read_lines();

  std::unique_ptr<Display> display_;
  std::unique_ptr<Process> program_;
  mutable std::string id_;
  std::size_t read_ = 0;  // bytes of --stats that have been read
  std::vector<json> lines_;
};

/// A rectangle of the picture, in pixels.
struct Taken {
  double left, right, top, bottom;
};
/// Returns where a box is seen in a perspective picture with the camera of a line of --stats.
Taken taken_by(const csgcore::Box& box, const json& line);

/// Writes all of a number's digits.
std::string number_text(double number);
/// Writes the camera as --camera takes it.
std::string camera_option(const json& camera);
/// Returns the camera of a line of --stats.
frontend::Camera camera_of(const json& line);

}  // namespace window_test
