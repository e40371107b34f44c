#include "follow/openscad_messages.hpp"

#include <sys/stat.h>

#include <charconv>
#include <filesystem>
#include <system_error>
#include <utility>

#include "frontend/design_tree.hpp"
#include "frontend/files.hpp"

namespace frontend {
namespace {

constexpr std::string_view kError = "ERROR: ";

/// An ERROR after which OpenSCAD goes on: another font stands in.
constexpr std::string_view kMissingFont = "ERROR: Can't read font with path";

/// Returns whether openscad means `scad_path` by `name`: it shortens a path to the file's name, or
/// makes it relative to the working folder. (std::filesystem::equivalent() takes no pipes.)
bool is_same_file(const std::string& name, const std::string& scad_path) {
  if (name == "<stdin>" || name == std::filesystem::path(scad_path).filename()) return true;
  struct stat a {};
  struct stat b {};
  return stat(name.c_str(), &a) == 0 && stat(scad_path.c_str(), &b) == 0 && a.st_dev == b.st_dev &&
         a.st_ino == b.st_ino;
}

}  // namespace

void OpenScadMessages::take(Kept message) {
  if (message.text.empty()) return;
  const bool is_error = message.text.starts_with(kError) && !message.text.starts_with(kMissingFont);
  if (is_error && !passes_errors_ && !first_error_) {
    message.text.erase(0, kError.size());
    first_error_ = std::move(message);
  } else if (first_error_ && after_error_ == AfterError::kHolds) {
    held_bytes_ += message.text.size();
    held_.push_back(std::move(message));
    if (held_bytes_ > kMostHeld) {
      release();
      after_error_ = AfterError::kPasses;
    }
  } else {
    pass(message);
  }
}

void OpenScadMessages::release() {
  for (const Kept& message : held_) pass(message);
  held_.clear();
}

void OpenScadMessages::pass_errors() {
  passes_errors_ = true;
  if (std::optional<Kept> error = std::exchange(first_error_, std::nullopt)) {
    error->text.insert(0, kError);
    pass(*error);
  }
  release();
}

Error openscad_error(const std::string& scad_path, const OpenScadMessages::Kept& message) {
  const std::string& text = message.text;
  constexpr std::string_view kFile = " in file ", kLine = ", line ";
  const std::size_t file_at = text.rfind(kFile);
  const std::size_t line_at = text.rfind(kLine);
  if (file_at == std::string::npos || line_at == std::string::npos || line_at < file_at) {
    return Error(input_name(scad_path), {}, text, "");
  }
  std::string file = text.substr(file_at + kFile.size(), line_at - file_at - kFile.size());
  if (!message.place.path.empty()) file = shown_name(message.place.path);
  if (is_same_file(file, scad_path)) file = input_name(scad_path);
  Location location;
  const char* digits = text.data() + line_at + kLine.size();
  std::from_chars(digits, text.data() + text.size(), location.line);
  return Error(Problem{file, location, text.substr(0, file_at), "", message.place.path,
                       message.place.column});
}

}  // namespace frontend
