// How the system gets from a path to a file.
#pragma once

#include <functional>
#include <string>

namespace frontend {

/// One name looked up in one folder.
struct PathLookup {
  std::string folder;  // its path without links
  std::string name;
  bool is_last = false;  // of the path, or of a link in its place: where the file itself lies
};

/// Calls `visit` for each name that an absolute path goes by, links' targets included, before that
/// name is looked at: where visit watches the folder, no change is missed. Ends after the first
/// name that is missing.
void visit_lookups(const std::string& path, const std::function<void(const PathLookup&)>& visit);

}  // namespace frontend
