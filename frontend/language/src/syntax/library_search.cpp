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
  if (name.starts_with('/')) return try_path(std::string(name), excluded);
  std::string found = try_path(folder + "/" + std::string(name), excluded);
  for (size_t i = 0; found.empty() && i < library_folders_.size(); ++i)
    found = try_path(library_folders_[i] + "/" + std::string(name), excluded);
  return found;
}

std::string LibrarySearch::try_path(const std::string& path,
                                    std::span<const std::string> excluded) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status)) {
    lookups_.push_back(fs::path(path).lexically_normal().string());
    return "";
  }
  if (fs::is_directory(status)) return "";
  std::string canonical = fs::canonical(path, error).string();
  return error || std::ranges::count(excluded, canonical) ? "" : canonical;
}

}  // namespace language
