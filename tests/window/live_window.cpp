#include "live_window.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <glm/geometric.hpp>
#include <iostream>
#include <sstream>
#include <string_view>

#include "navigation.hpp"
#include "projection.hpp"

namespace window_test {
namespace {

/// More than the heights of the menu and the status line.
constexpr uint32_t kMenuHeight = 30, kStatusHeight = 40;

/// For the angles and places of a camera, which some additions have rounded.
constexpr double kRounding = 1e-9;

bool is_near(const csgcore::Vec3& a, const csgcore::Vec3& b) {
  return glm::length(a - b) <= kRounding * (1 + glm::length(b));
}

csgcore::Vec3 vector_of(const json& numbers) {
  return {numbers[0].get<double>(), numbers[1].get<double>(), numbers[2].get<double>()};
}

}  // namespace

std::string number_text(double number) {
  std::ostringstream text;
  text.precision(17);
  text << number;
  return text.str();
}

std::string camera_option(const json& camera) {
  std::string text = "--camera=";
  for (const char* part : {"target", "rotation_deg"}) {
    for (const json& number : camera[part]) text += number_text(number.get<double>()) + ",";
  }
  return text + number_text(camera["distance"].get<double>());
}

frontend::Camera camera_of(const json& line) {
  const json& camera = line["camera"];
  return {vector_of(camera["target"]), vector_of(camera["rotation_deg"]),
          camera["distance"].get<double>()};
}

Taken taken_by(const csgcore::Box& box, const json& line) {
  const window::Size size{line["width_px"], line["height_px"]};
  const csgcore::View view =
      window::Navigation(camera_of(line), csgcore::Projection::kPerspective).view(size);
  Taken taken{1e9, -1e9, 1e9, -1e9};
  for (int corner = 0; corner < 8; ++corner) {
    const auto place = window::project(
        view, {(corner & 1 ? box.max : box.min).x, (corner & 2 ? box.max : box.min).y,
               (corner & 4 ? box.max : box.min).z});
    if (!place) throw std::runtime_error("a part of the box is behind the eye");
    taken.left = std::min(taken.left, place->x_px);
    taken.right = std::max(taken.right, place->x_px);
    taken.top = std::min(taken.top, place->y_px);
    taken.bottom = std::max(taken.bottom, place->y_px);
  }
  return taken;
}

void LiveWindow::SetUp() {
  if (const auto missing = missing_program({"Xvfb", "xdotool"})) {
    GTEST_SKIP() << "no " << *missing;
  }
  display_ = std::make_unique<Display>();
}

void LiveWindow::TearDown() {
  if (HasFailure() && program_) std::cerr << "scadray's errors:\n" << errors() << '\n';
}

void LiveWindow::open(const std::string& design, const std::vector<std::string>& options,
                      ProcessSetup setup) {
  program_.reset();
  lines_.clear();
  read_ = 0;
  id_.clear();
  std::filesystem::remove(folder_ / "stats");
  setup.words = {SCADRAY_PROGRAM, "--stats=" + (folder_ / "stats")};
  const auto has = [&](std::string_view start) {
    return std::any_of(options.begin(), options.end(),
                       [&](const std::string& option) { return option.starts_with(start); });
  };
  if (!has("--imgsize=") && gives_size_) {
    setup.words.push_back("--imgsize=" + std::to_string(kWidth) + "," + std::to_string(kHeight));
  }
  // A studio's picture comes in steps. Those are painter_test's.
  if (!has("--shading=")) setup.words.push_back("--shading=openscad");
  setup.words.insert(setup.words.end(), options.begin(), options.end());
  setup.words.push_back(design);
  setup.environment["DISPLAY"] = display_->name();
  setup.environment["WAYLAND_DISPLAY"] = std::nullopt;
  std::filesystem::remove_all(folder_ / "fresh state");
  // -o has no grid and no axes in the corner unless it is asked for them.
  std::filesystem::create_directories(folder_ / "fresh state/scadray");
  std::ofstream(folder_ / "fresh state/scadray/window") << "grid=off\norientation=off\n";
  setup.environment.try_emplace("XDG_STATE_HOME", folder_ / "fresh state");
  setup.errors = folder_ / "errors";
  program_ = std::make_unique<Process>(setup);
}

void LiveWindow::open_managed(const std::string& design, const std::vector<std::string>& options) {
  display_->start_window_manager();
  open(design, options);
}

void LiveWindow::read_lines() {
  std::ifstream file(folder_ / "stats");
  file.seekg(static_cast<std::streamoff>(read_));
  for (std::string line; std::getline(file, line) && !file.eof();) {
    read_ += line.size() + 1;
    lines_.push_back(json::parse(line));
  }
}

json LiveWindow::next(const std::function<bool(const json&)>& is_wanted) {
  json found, last;
  const auto look = [&] {
    read_lines();
    while (!lines_.empty() && found.is_null()) {
      last = lines_.front();
      lines_.erase(lines_.begin());
      if (is_wanted(last)) found = last;
    }
    return !found.is_null() || program_->ended();
  };
  wait_until(look);
  if (found.is_null()) {
    throw std::runtime_error("no such picture; the last: " + last.dump() + "\n" + errors());
  }
  return found;
}

json LiveWindow::next() {
  return next([](const json&) { return true; });
}

json LiveWindow::next_of(std::size_t primitives) {
  return next([primitives](const json& line) {
    return line["primitives"] == primitives && line["error"] == "";
  });
}

json LiveWindow::next_error() {
  return next([](const json& line) { return line["error"] != ""; });
}

json LiveWindow::next_camera(const frontend::Camera& camera, bool orthographic) {
  return next([&](const json& line) {
    const frontend::Camera now = camera_of(line);
    return is_near(now.target, camera.target) && is_near(now.rotation_deg, camera.rotation_deg) &&
           std::abs(now.distance - camera.distance) <= kRounding * camera.distance &&
           line["camera"]["orthographic"] == orthographic;
  });
}

std::string LiveWindow::window_id() const {
  if (id_.empty()) {
    const std::string ids =
        display_->drive({"search", "--sync", "--onlyvisible", "--class", "scadray"});
    id_ = ids.substr(0, ids.find('\n'));
  }
  return id_;
}

std::string LiveWindow::title() const {
  std::string name = display_->drive({"getwindowname", window_id()});
  while (name.ends_with('\n')) name.pop_back();
  return name;
}

Picture LiveWindow::shown() const {
  std::istringstream lines(display_->drive({"getwindowgeometry", "--shell", window_id()}));
  Area area;
  for (std::string line; std::getline(lines, line);) {
    const std::size_t equals = line.find('=');
    const std::string name = line.substr(0, equals);
    uint32_t* const number = name == "X"        ? &area.x
                             : name == "Y"      ? &area.y
                             : name == "WIDTH"  ? &area.width
                             : name == "HEIGHT" ? &area.height
                                                : nullptr;
    if (number) *number = static_cast<uint32_t>(std::stoul(line.substr(equals + 1)));
  }
  return part(display_->screenshot(), area);
}

Area LiveWindow::free_area(uint32_t width, uint32_t height) {
  return {0, kMenuHeight, width, height - kMenuHeight - kStatusHeight};
}

Picture LiveWindow::drawn(const std::string& design, const json& camera, uint32_t width,
                          uint32_t height, const std::vector<std::string>& options) const {
  const std::string path = folder_ / "drawn.png";
  ProcessSetup setup;
  setup.words = {SCADRAY_PROGRAM,
                 "-o",
                 path,
                 "--imgsize=" + std::to_string(width) + "," + std::to_string(height),
                 camera_option(camera),
                 camera["orthographic"].get<bool>() ? "--projection=o" : "--projection=p"};
  setup.words.insert(setup.words.end(), options.begin(), options.end());
  setup.words.push_back(design);
  run(setup);
  return read_png(path);
}

void LiveWindow::expect_shown(const Picture& whole, const Area& area) {
  const Picture wanted = part(whole, area);
  Picture now;
  const bool is_shown = wait_until([&] {
    now = shown();
    return now.width == whole.width && now.height == whole.height && part(now, area) == wanted;
  });
  if (is_shown) return;
  ADD_FAILURE() << "the window of " << now.width << "×" << now.height << " differs from "
                << whole.width << "×" << whole.height << " in "
                << (now.width == whole.width && now.height == whole.height
                        ? different_pixels(part(now, area), wanted)
                        : wanted.rgb.size())
                << " pixels";
}

void LiveWindow::expect_drawn(const std::string& design, const json& line,
                              const std::vector<std::string>& options) {
  const auto width = line["width_px"].get<uint32_t>(), height = line["height_px"].get<uint32_t>();
  expect_shown(drawn(design, line["camera"], width, height, options), free_area(width, height));
}

void LiveWindow::wait_until_other(const Picture& before) {
  EXPECT_TRUE(wait_until([&] { return shown() != before; })) << "nothing changes";
}

void LiveWindow::wait_until_settled(const Picture& before) {
  constexpr std::chrono::milliseconds kLong(250);  // many frames
  wait_until_other(before);
  EXPECT_TRUE(wait_until([&] {
    const Picture now = shown();
    std::this_thread::sleep_for(kLong);
    return shown() == now;
  })) << "the window never stands still";
}

std::vector<std::string> LiveWindow::placed(int x, int y) const {
  return {"mousemove", "--window", window_id(), std::to_string(x), std::to_string(y)};
}

void LiveWindow::drag(int button, int from_x, int from_y, int to_x, int to_y,
                      const std::string& held_key) {
  const std::string number = std::to_string(button);
  std::vector<std::string> words;
  const auto add = [&words](const std::vector<std::string>& more) {
    words.insert(words.end(), more.begin(), more.end());
  };
  if (!held_key.empty()) add({"keydown", held_key});
  add(placed(from_x, from_y));
  add({"mousedown", number});
  for (int step = 1; step <= 3; ++step) {
    add(placed(from_x + (to_x - from_x) * step / 3, from_y + (to_y - from_y) * step / 3));
  }
  add({"mouseup", number});
  if (!held_key.empty()) add({"keyup", held_key});
  display_->drive(words);
}

void LiveWindow::click(int x, int y, int times) {
  std::vector<std::string> words = placed(x, y);
  for (int i = 0; i < times; ++i) {
    for (const char* word : {"click", "1"}) words.push_back(word);
  }
  display_->drive(words);
}

void LiveWindow::wheel(int x, int y, int notches) {
  std::vector<std::string> words = placed(x, y);
  for (int i = 0; i < std::abs(notches); ++i) {
    for (const char* word : {"click", notches > 0 ? "4" : "5"}) words.push_back(word);
  }
  display_->drive(words);
}

}  // namespace window_test
