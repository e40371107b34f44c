#include "file_browser.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <string_view>
#include <tuple>
#include <utility>

#include "base/lower_case.hpp"

namespace window {
namespace {

namespace fs = std::filesystem;

constexpr const char* kUp = "..";

/// The suffixes of files that are shown. Any other file can be opened by its name.
constexpr std::array kSuffixes{".scad", ".csg",  ".stl", ".off", ".amf",
                               ".3mf",  ".nef3", ".dxf", ".svg"};

bool is_design(const fs::path& path) {
  const std::string suffix = frontend::lower_case(path.extension().string());
  return std::find(kSuffixes.begin(), kSuffixes.end(), suffix) != kSuffixes.end();
}

/// Returns a path with the home folder in place of a "~" at its start.
fs::path with_home(const std::string& text) {
  const char* const home = std::getenv("HOME");
  if (home == nullptr || (text != "~" && !text.starts_with("~/"))) return text;
  return home + text.substr(1);
}

bool is_folder(const fs::path& path) {
  std::error_code failed;
  return fs::is_directory(path, failed);
}

}  // namespace

FileBrowser::FileBrowser(const std::string& folder) {
  std::error_code failed;
  go_to(fs::absolute(folder.empty() ? "." : folder, failed).string());
}

/// Begins anew in a folder.
void FileBrowser::go_to(const std::string& folder) {
  base_ = fs::path(folder).lexically_normal().string();
  if (base_.size() > 1 && base_.ends_with('/')) base_.pop_back();
  text_.clear();
  rest_ = 0;
  show(base_);
  filter();
}

/// Reads a folder.
void FileBrowser::show(const std::string& folder) {
  folder_ = folder;
  problem_.clear();
  all_.clear();
  std::error_code failed;
  fs::directory_iterator files(folder_, failed);
  if (failed) problem_ = "the folder cannot be read: " + failed.message();
  for (; !failed && files != fs::directory_iterator(); files.increment(failed)) {
    const bool is_a_folder = is_folder(files->path());
    if (is_a_folder || is_design(files->path())) {
      all_.push_back({files->path().filename().string(), is_a_folder});
    }
  }
  std::sort(all_.begin(), all_.end(), [](const Entry& a, const Entry& b) {
    return std::tuple(!a.is_folder, frontend::lower_case(a.name), a.name) <
           std::tuple(!b.is_folder, frontend::lower_case(b.name), b.name);
  });
  if (folder_ != "/") all_.insert(all_.begin(), {kUp, true});
}

void FileBrowser::filter() {
  const std::string name = text_.substr(rest_), wanted = frontend::lower_case(name);
  const bool shows_hidden = wanted.starts_with('.');
  shown_.clear();
  for (const Entry& entry : all_) {
    const bool is_hidden = entry.name.starts_with('.') && entry.name != kUp;
    if (is_hidden && !shows_hidden) continue;
    if (frontend::lower_case(entry.name).find(wanted) != std::string::npos) shown_.push_back(entry);
  }
  is_chosen_ = false;
  const auto first = [this](const auto& is_wanted) {
    return static_cast<std::size_t>(std::find_if(shown_.begin(), shown_.end(), is_wanted) -
                                    shown_.begin());
  };
  chosen_ = first([&](const Entry& entry) { return entry.name == name; });
  if (chosen_ == shown_.size()) {
    chosen_ = first(
        [&](const Entry& entry) { return frontend::lower_case(entry.name).starts_with(wanted); });
  }
  if (chosen_ == shown_.size()) chosen_ = 0;
  // Without a name the first entry is chosen that leads on.
  if (wanted.empty() && shown_.size() > 1 && shown_[0].name == kUp) chosen_ = 1;
}

void FileBrowser::type(const std::string& text) {
  text_ = text;
  const std::size_t slash = text.rfind('/');
  rest_ = slash == std::string::npos ? 0 : slash + 1;
  // An absolute path takes the base's place.
  fs::path folder = (fs::path(base_) / with_home(text.substr(0, rest_))).lexically_normal();
  if (!folder.has_filename() && folder != folder.root_path()) folder = folder.parent_path();
  if (folder != folder_) show(folder.string());
  filter();
}

std::string FileBrowser::completed() const {
  if (chosen_ >= shown_.size()) return text_;
  const Entry& entry = shown_[chosen_];
  return text_.substr(0, rest_) + entry.name + (entry.is_folder ? "/" : "");
}

void FileBrowser::choose(std::size_t entry) {
  if (entry >= shown_.size()) return;
  chosen_ = entry;
  is_chosen_ = true;
}

void FileBrowser::move(int by) {
  if (shown_.empty()) return;
  const auto last = static_cast<std::ptrdiff_t>(shown_.size()) - 1;
  choose(static_cast<std::size_t>(
      std::clamp(static_cast<std::ptrdiff_t>(chosen_) + by, std::ptrdiff_t{0}, last)));
}

void FileBrowser::go_up() {
  const fs::path from = folder_;
  go_to(from.parent_path().string());
  const auto before = std::find_if(shown_.begin(), shown_.end(), [&](const Entry& entry) {
    return entry.name == from.filename().string();
  });
  choose(static_cast<std::size_t>(before - shown_.begin()));
}

std::optional<std::string> FileBrowser::enter() {
  const std::string name = text_.substr(rest_);
  const fs::path named = name == "~" ? with_home(name) : fs::path(folder_) / name;
  std::error_code failed;
  const bool is_named = !is_chosen_ && !name.empty() && fs::exists(named, failed);
  if (!is_named && shown_.empty()) {
    problem_ = "there is no such file: " + text_;
    return std::nullopt;
  }
  if (!is_named && shown_[chosen_].name == kUp) {
    go_up();
    return std::nullopt;
  }
  const fs::path path = is_named ? named : fs::path(folder_) / shown_[chosen_].name;
  if (!is_folder(path)) return path.lexically_normal().string();
  go_to(path.string());
  return std::nullopt;
}

}  // namespace window
