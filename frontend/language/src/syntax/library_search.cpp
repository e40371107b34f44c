#include "syntax/library_search.hpp"

#include <algorithm>
#include <cstdlib>
#include <filesystem>

namespace language {

namespace fs = std::filesystem;

namespace {

/// The user's library folder where there is no folder for it. OpenSCAD then takes names that have a
/// folder in them as they are, on the folder where the program was started.
constexpr char kNoFolder[] = "";

/// Returns a path made absolute on the folder where the program was started, which is also what an
/// empty path means.
std::string absolute(const std::string& path) {
  std::error_code error;
  return path.empty() ? fs::current_path(error).string() : fs::absolute(path, error).string();
}

}  // namespace

LibrarySearch::LibrarySearch(std::vector<std::string>& lookups) : lookups_(lookups) {
  if (const char* parts = std::getenv("OPENSCADPATH")) {
    for (std::string_view rest = parts;; rest.remove_prefix(rest.find(':') + 1)) {
      library_folders_.push_back(absolute(std::string(rest.substr(0, rest.find(':')))));
      if (rest.find(':') == rest.npos) break;
    }
  }
  std::error_code error;
  const char* home = std::getenv("HOME");
  const fs::path share = fs::path(home ? home : "") / ".local/share";
  library_folders_.push_back(fs::exists(share, error) ? (share / "OpenSCAD/libraries").string()
                                                      : kNoFolder);
  library_folders_.push_back("/usr/share/openscad/libraries");
}

std::string LibrarySearch::find(std::string_view name, const std::string& folder,
                                std::span<const std::string> excluded) {
  const fs::path first = fs::path(folder) / name;  // `name` alone if it is absolute
  if (is_file(first)) {
    std::error_code error;
    std::string found = fs::canonical(first, error).string();
    if (!error && !std::ranges::count(excluded, found)) return found;
  }
  if (name.starts_with('/')) return "";
  for (const std::string& library_folder : library_folders_) {
    if (library_folder == kNoFolder && name.find('/') == name.npos) continue;
    const fs::path path = fs::path(library_folder) / name;
    if (!is_file(path)) continue;
    return std::ranges::count(excluded, path.string()) ? "" : path.string();
  }
  return "";
}

bool LibrarySearch::is_file(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status))
    lookups_.push_back(fs::path(absolute(path.string())).lexically_normal().string());
  return fs::exists(status) && !fs::is_directory(status);
}

}  // namespace language
