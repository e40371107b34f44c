#include "syntax/library_search.hpp"

#include <algorithm>
#include <cstdlib>
#include <filesystem>

namespace language {

namespace fs = std::filesystem;

namespace {

std::string environment(const char* name) {
  const char* value = std::getenv(name);
  return value ? value : "";
}

/// Returns a path made absolute on the folder where the program was started.
std::string absolute(const std::string& path) {
  std::error_code error;
  return fs::absolute(path, error).string();
}

}  // namespace

LibrarySearch::LibrarySearch(std::vector<std::string>& lookups) : lookups_(lookups) {
  std::string_view rest;
  const std::string path = environment("OPENSCADPATH");
  for (rest = path; !rest.empty();) {
    const size_t colon = std::min(rest.find(':'), rest.size());
    if (colon > 0) library_folders_.push_back(absolute(std::string(rest.substr(0, colon))));
    rest.remove_prefix(std::min(colon + 1, rest.size()));
  }
  if (const std::string home = environment("HOME"); !home.empty())
    library_folders_.push_back(home + "/.local/share/OpenSCAD/libraries");
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
    const fs::path path = fs::path(library_folder) / name;
    if (!is_file(path)) continue;
    return std::ranges::count(excluded, path.string()) ? "" : path.string();
  }
  return "";
}

bool LibrarySearch::is_file(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status)) lookups_.push_back(path.lexically_normal().string());
  return fs::exists(status) && !fs::is_directory(status);
}

}  // namespace language
