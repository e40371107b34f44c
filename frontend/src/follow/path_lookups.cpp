#include "follow/path_lookups.hpp"

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <vector>

namespace frontend {
namespace {

namespace fs = std::filesystem;

constexpr int kMostLinks = 40;  // as in the kernel

/// Pushes the names of a path, the first one last.
void push_names(const fs::path& path, std::vector<std::string>& names) {
  const std::size_t before = names.size();
  for (const fs::path& name : path.relative_path()) {
    if (!name.empty() && name != ".") names.push_back(name.string());
  }
  std::reverse(names.begin() + static_cast<std::ptrdiff_t>(before), names.end());
}

}  // namespace

void visit_lookups(const std::string& path, const std::function<void(const PathLookup&)>& visit) {
  std::vector<std::string> names;  // names still to be looked up, the next one last
  push_names(path, names);
  fs::path folder = "/";
  for (int links = 0; !names.empty();) {
    const std::string name = std::move(names.back());
    names.pop_back();
    if (name == "..") {
      folder = folder.parent_path();
      continue;
    }
    visit({folder.string(), name, names.empty()});
    const fs::path found = folder / name;
    std::error_code failed;
    const fs::file_status status = fs::symlink_status(found, failed);
    if (!fs::exists(status)) return;
    if (!fs::is_symlink(status)) {
      folder = found;
      continue;
    }
    const fs::path target = fs::read_symlink(found, failed);
    if (failed || ++links > kMostLinks) return;
    if (target.is_absolute()) folder = "/";
    push_names(target, names);
  }
}

}  // namespace frontend
