#include "files/named_files.hpp"

#include <sys/stat.h>

#include <filesystem>
#include <system_error>

#include "base/read_file.hpp"

namespace language {
namespace {

namespace fs = std::filesystem;

/// Returns the path as seen from a folder, both resolved. Each step upwards is written "../", even
/// where nothing follows it.
std::string relative_to(const fs::path& folder, const fs::path& path) {
  auto from = folder.begin();
  auto to = path.begin();
  while (from != folder.end() && to != path.end() && *from == *to) ++from, ++to;
  std::string relative;
  for (; from != folder.end(); ++from) relative += "../";
  std::string separator;
  for (; to != path.end(); ++to) {
    if (to->empty()) continue;  // after a slash at the end
    relative += separator + to->string();
    separator = "/";
  }
  return relative;
}

bool is_there(const fs::path& path) {
  std::error_code failed;
  return fs::exists(path, failed);
}

}  // namespace

std::string NamedFiles::folder_of(Place call) const {
  if (!sources_ || call.file == kNoFile) return unit_folder_;
  const fs::path path = (*sources_)[call.file].path;
  return path.is_absolute() ? path.parent_path().string() : main_folder_;
}

std::string NamedFiles::path_of(const std::string& name, Place call) {
  fs::path first = fs::path(folder_of(call)) / name;  // `name` alone if it is absolute
  if (is_there(first)) return first;
  lookups_.push_back(first.lexically_normal().string());
  const fs::path second = fs::path(main_folder_) / name;
  if (second == first) return first;
  if (!is_there(second)) {
    lookups_.push_back(second.lexically_normal().string());
    return first;
  }
  messages_.say(MessageGroup::kDeprecated,
                "Imported file (" + name +
                    ") found in document root instead of relative to the importing module. This "
                    "behavior is deprecated");
  return second;
}

NamedFile NamedFiles::find(const std::string& name, Place call) {
  NamedFile file;
  ++finds_;
  if (name.empty()) return file;
  file.opened = path_of(name, call);
  const fs::path path = resolved_file(file.opened);
  struct stat status {};
  file.exists = stat(path.c_str(), &status) == 0;
  if (file.exists) files_read_.push_back(path.string());
  file.path = relative_to(resolved(main_folder_), path);
  file.timestamp = status.st_mtime;
  file.size = status.st_size;
  return file;
}

}  // namespace language
