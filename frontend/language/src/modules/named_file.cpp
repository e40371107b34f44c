#include "modules/named_file.hpp"

#include <sys/stat.h>

#include <filesystem>
#include <system_error>

#include "modules/node_values.hpp"

namespace language {
namespace {

namespace fs = std::filesystem;

/// Returns a path without `.` and `..`, and without links where it exists.
fs::path resolved(const fs::path& path) {
  std::error_code failed;
  fs::path result = fs::weakly_canonical(path, failed);
  return failed ? path.lexically_normal() : result;
}

/// The same, but a file that is a link itself keeps its name.
fs::path resolved_file(const fs::path& path) {
  const fs::path name = path.filename();
  if (name.empty() || name == "." || name == "..") return resolved(path);
  return resolved(path.parent_path()) / name;
}

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

int64_t seconds_of_last_change(const fs::path& path) {
  struct stat status {};
  return stat(path.c_str(), &status) == 0 ? status.st_mtime : 0;
}

bool is_there(const fs::path& path) {
  std::error_code failed;
  return fs::exists(path, failed);
}

/// Returns the path that a name stands for.
fs::path find(const BuiltinCall& call, const std::string& name) {
  ModuleEnvironment& environment = call.environment;
  fs::path first = fs::path(environment.unit_folder) / name;  // `name` alone if it is absolute
  if (is_there(first)) return first;
  environment.lookups.push_back(first.lexically_normal().string());
  const fs::path second = fs::path(environment.main_folder) / name;
  if (second == first) return first;
  if (!is_there(second)) {
    environment.lookups.push_back(second.lexically_normal().string());
    return first;
  }
  deprecate(call, "Imported file (" + name +
                      ") found in document root instead of relative to the importing module. This "
                      "behavior is deprecated");
  return second;
}

}  // namespace

NamedFile find_named_file(const BuiltinCall& call, const std::string& name) {
  if (name.empty()) return {};
  const fs::path path = resolved_file(find(call, name));
  if (is_there(path)) call.environment.files_read.push_back(path.string());
  return {relative_to(resolved(call.environment.main_folder), path), seconds_of_last_change(path)};
}

}  // namespace language
