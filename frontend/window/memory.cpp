#include "memory.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>

#include "frontend/error.hpp"
#include "frontend/files.hpp"
#include "frontend/render_settings.hpp"

namespace window {
namespace {

namespace fs = std::filesystem;

/// The file is written so long after a change.
constexpr std::chrono::seconds kSettled{1};
/// As many designs are shown in the menu.
constexpr std::size_t kMostRecent = 10;
/// A file that is larger was not written by a window.
constexpr uintmax_t kMostBytes = 65536;
constexpr std::string_view kRecent = "recent";

struct Contents {
  Memory::Values values;
  std::vector<std::string> recent;
};

bool is_regular_or_missing(const std::string& path) {
  std::error_code failed;
  const fs::file_status status = fs::status(path, failed);
  return fs::is_regular_file(status) || status.type() == fs::file_type::not_found;
}

/// Puts a path first, once.
void put_first(const std::string& path, std::vector<std::string>& paths) {
  paths.erase(std::remove(paths.begin(), paths.end(), path), paths.end());
  paths.insert(paths.begin(), path);
  if (paths.size() > kMostRecent) paths.resize(kMostRecent);
}

bool is_name(std::string_view text) {
  return !text.empty() && std::all_of(text.begin(), text.end(),
                                      [](char c) { return (c >= 'a' && c <= 'z') || c == '_'; });
}

/// Takes the lines "name=value"; what is none is left out.
Contents contents_of(std::string_view text) {
  Contents contents;
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    const std::size_t equals = line.find('=');
    if (equals == std::string_view::npos || !is_name(line.substr(0, equals))) continue;
    const std::string name(line.substr(0, equals)), value(line.substr(equals + 1));
    if (name != kRecent) {
      contents.values[name] = value;
    } else if (contents.recent.size() < kMostRecent && value.starts_with('/')) {
      contents.recent.push_back(value);
    }
  }
  return contents;
}

Contents read_contents(const std::string& path) {
  std::error_code missing;
  if (path.empty() || !fs::is_regular_file(path, missing)) return {};
  if (fs::file_size(path, missing) > kMostBytes) return {};
  try {
    return contents_of(frontend::read_regular_file(path).view());
  } catch (const frontend::Error&) {
    return {};
  }
}

std::string text_of(const Contents& contents) {
  std::string text;
  for (const auto& [name, value] : contents.values) text += name + "=" + value + "\n";
  for (const std::string& path : contents.recent) text += std::string(kRecent) + "=" + path + "\n";
  return text;
}

using frontend::GivenLook;

constexpr Size kDefaultSize{1024, 768};

constexpr const char* kOn = "on";
constexpr const char* kOff = "off";
constexpr const char* kScheme = "colours";
constexpr const char* kSamples = "samples";
constexpr const char* kSize = "size";
constexpr const char* kPosition = "position";
constexpr const char* kMaximized = "maximized";

/// What is on or off. The commands switch it on and off; they are one and the same where that
/// changes it.
struct Switch {
  const char* name;
  Command on, off;
  bool GivenLook::*given;  // whether the command line says it; null: it never does
};
constexpr Switch kSwitches[] = {
    {"axes", Command::kAxes, Command::kAxes, &GivenLook::view},
    {"crosshairs", Command::kCrosshairs, Command::kCrosshairs, &GivenLook::view},
    {"scales", Command::kScales, Command::kScales, &GivenLook::view},
    {"edges", Command::kEdges, Command::kEdges, &GivenLook::view},
    {"grid", Command::kGrid, Command::kGrid, &GivenLook::view},
    {"orientation", Command::kOrientation, Command::kOrientation, nullptr},
    {"orthographic", Command::kOrthographic, Command::kPerspective, &GivenLook::projection},
    {"phong", Command::kPhongShading, Command::kOpenScadShading, &GivenLook::shading},
    {"studio", Command::kStudioShading, Command::kOpenScadShading, &GivenLook::shading},
    {"phong_shadows", Command::kPhongShadows, Command::kPhongShadows, &GivenLook::shading},
    {"depth_order", Command::kDepthOrder, Command::kDepthOrder, &GivenLook::translucency},
    {"parameters", Command::kParameters, Command::kParameters, nullptr},
    {"status_line", Command::kStatus, Command::kStatus, nullptr},
    {"messages", Command::kMessages, Command::kMessages, nullptr},
    {"place", Command::kPlace, Command::kPlace, nullptr},
};

std::optional<int> number_of(std::string_view text) {
  int number = 0;
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (problem != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return number;
}

/// Returns the two numbers that a space divides.
std::optional<std::pair<int, int>> pair_of(const std::string* text) {
  if (text == nullptr) return std::nullopt;
  const std::size_t space = text->find(' ');
  if (space == std::string::npos) return std::nullopt;
  const auto first = number_of(std::string_view(*text).substr(0, space));
  const auto second = number_of(std::string_view(*text).substr(space + 1));
  if (!first || !second) return std::nullopt;
  return std::pair(*first, *second);
}

std::string text_of(int first, int second) {
  return std::to_string(first) + " " + std::to_string(second);
}

}  // namespace

std::string memory_path() {
  const auto variable = [](const char* name) {
    const char* const value = std::getenv(name);
    return fs::path(value != nullptr ? value : "");
  };
  // The XDG specification wants relative paths to be ignored.
  fs::path folder = variable("XDG_STATE_HOME");
  if (!folder.is_absolute()) {
    folder = variable("HOME");
    if (!folder.is_absolute()) return {};
    folder = folder / ".local" / "state";
  }
  return (folder / "scadray" / "window").string();
}

Memory::Memory(std::string path, bool forgets) : path_(std::move(path)), forgets_(forgets) {
  Contents contents = read_contents(path_);
  if (!forgets_) values_ = std::move(contents.values);
  recent_ = std::move(contents.recent);
  is_only_window_ = take_lock();
}

/// Locks the file's folder, unless it is locked already, or there is none yet. Returns whether no
/// other window has locked it.
bool Memory::take_lock() {
  if (lock_ >= 0 || path_.empty()) return true;
  lock_ = open(fs::path(path_).parent_path().c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  return lock_ < 0 || flock(lock_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK;
}

/// Makes the file's folder if there is none, for the user alone.
void Memory::make_folder() {
  const fs::path folder = fs::path(path_).parent_path();
  std::error_code failed;
  if (!fs::create_directories(folder, failed)) return;
  fs::permissions(folder, fs::perms::owner_all, failed);
  take_lock();
}

Memory::~Memory() {
  if (lock_ >= 0) close(lock_);
}

const std::string* Memory::find(const std::string& name) const {
  const auto found = values_.find(name);
  return found == values_.end() ? nullptr : &found->second;
}

void Memory::note_design(const std::string& path, Clock::time_point now) {
  if (path.find('\n') != std::string::npos) return;  // a line would not hold it
  put_first(path, recent_);
  put_first(path, opened_);
  touch(now);
}

void Memory::note(const Values& values, Clock::time_point now) {
  for (const auto& [name, value] : values) {
    const auto before = noted_.find(name);
    if (before != noted_.end() && before->second == value) continue;
    if (before != noted_.end()) {
      changed_[name] = value;
      touch(now);
    }
    noted_[name] = value;
  }
}

void Memory::touch(Clock::time_point now) { due_ = now + kSettled; }

void Memory::write() {
  due_.reset();
  if (path_.empty() || (changed_.empty() && opened_.empty() && !forgets_)) return;
  Contents contents = read_contents(path_);
  const std::string before = text_of(contents);
  if (std::exchange(forgets_, false)) contents.values.clear();
  for (auto& [name, value] : std::exchange(changed_, {})) contents.values[name] = value;
  const std::vector<std::string> opened = std::exchange(opened_, {});
  for (auto path = opened.rbegin(); path != opened.rend(); ++path) {
    put_first(*path, contents.recent);
  }
  const std::string text = text_of(contents);
  if (text == before || !is_regular_or_missing(path_)) return;
  make_folder();
  try {
    const frontend::PendingOutput output{path_, frontend::bytes_of(text)};
    frontend::write_outputs({&output, 1});
  } catch (const frontend::Error&) {
  }
}

Memory::Values habits_of(const State& state) {
  Memory::Values values;
  for (const Switch& row : kSwitches) values[row.name] = state.is_checked(row.on) ? kOn : kOff;
  values[kScheme] = state.look.scheme.name;
  values[kSamples] = std::to_string(state.look.samples);
  return values;
}

void restore_habits(const Memory& memory, const GivenLook& given, State& state) {
  for (const Switch& row : kSwitches) {
    const std::string* const value = memory.find(row.name);
    if (value == nullptr || (row.given != nullptr && given.*row.given)) continue;
    if (*value == kOn && !state.is_checked(row.on)) state.apply(row.on);
    if (*value == kOff && state.is_checked(row.on)) state.apply(row.off);
  }
  state.notice.clear();  // it answers commands, and there was none yet
  const std::string* const scheme = memory.find(kScheme);
  if (scheme != nullptr && !given.scheme) {
    if (const auto* known = frontend::find_color_scheme(*scheme)) state.look.scheme = *known;
  }
  const std::string* const samples = memory.find(kSamples);
  if (samples == nullptr || given.samples) return;
  const int number = number_of(*samples).value_or(0);
  if (number >= 1 && number <= static_cast<int>(frontend::kMaxSamples)) {
    state.look.samples = static_cast<uint32_t>(number);
  }
}

Memory::Values values_of(const Placement& placement, bool has_position) {
  Memory::Values values;
  values[kMaximized] = placement.is_maximized ? kOn : kOff;
  if (placement.is_maximized) return values;  // it goes back to the size that it had before
  values[kSize] = text_of(static_cast<int>(placement.size.width_px),
                          static_cast<int>(placement.size.height_px));
  if (has_position && placement.position) {
    values[kPosition] = text_of(placement.position->first, placement.position->second);
  }
  return values;
}

Placement remembered_placement(const Memory& memory, const std::optional<Size>& given) {
  Placement placement;
  placement.size = given.value_or(kDefaultSize);
  if (memory.is_only_window()) placement.position = pair_of(memory.find(kPosition));
  if (given) return placement;
  const std::string* const maximized = memory.find(kMaximized);
  placement.is_maximized = maximized != nullptr && *maximized == kOn;
  const auto size = pair_of(memory.find(kSize));
  if (size && size->first > 0 && size->second > 0) {
    placement.size = {static_cast<uint32_t>(size->first), static_cast<uint32_t>(size->second)};
    placement.fits_screen = true;
  }
  return placement;
}

}  // namespace window
