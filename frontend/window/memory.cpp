#include "memory.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <string_view>
#include <utility>

#include "frontend/error.hpp"
#include "frontend/files.hpp"

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

Contents read(const std::string& path) {
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

Memory::Memory(std::string path) : path_(std::move(path)) {
  Contents contents = read(path_);
  values_ = std::move(contents.values);
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
  if (path_.empty() || (changed_.empty() && opened_.empty())) return;
  Contents contents = read(path_);
  const std::string before = text_of(contents);
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

}  // namespace window
