#include "follow/openscad_messages.hpp"

#include <sys/stat.h>

#include <charconv>
#include <filesystem>

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

void OpenScadMessages::take(const std::string& message) {
  if (message.empty()) return;
  const bool is_error = message.starts_with(kError) && !message.starts_with(kMissingFont);
  if (is_error && !passes_errors_ && !first_error_) {
    first_error_ = message.substr(kError.size());
  } else if (first_error_ && after_error_ == AfterError::kHolds) {
    held_.push_back(message);
    held_bytes_ += message.size();
    if (held_bytes_ > kMostHeld) {
      release();
      after_error_ = AfterError::kPasses;
    }
  } else {
    message_(message);
  }
}

void OpenScadMessages::release() {
  for (const std::string& text : held_) message_(text);
  held_.clear();
}

void OpenScadMessages::pass_errors() {
  passes_errors_ = true;
  if (first_error_) message_(std::string(kError) + *first_error_);
  first_error_.reset();
  release();
}

Error openscad_error(const std::string& scad_path, const std::string& text) {
  constexpr std::string_view kFile = " in file ", kLine = ", line ";
  const std::size_t file_at = text.rfind(kFile);
  const std::size_t line_at = text.rfind(kLine);
  if (file_at == std::string::npos || line_at == std::string::npos || line_at < file_at) {
    return Error(input_name(scad_path), {}, text, "");
  }
  std::string file = text.substr(file_at + kFile.size(), line_at - file_at - kFile.size());
  if (is_same_file(file, scad_path)) file = input_name(scad_path);
  Location location;
  const char* digits = text.data() + line_at + kLine.size();
  std::from_chars(digits, text.data() + text.size(), location.line);
  return Error(file, location, text.substr(0, file_at), "");
}

}  // namespace frontend
