// Follows a path the way the system resolves it.
#pragma once

#include <functional>
#include <string>

namespace frontend {

/// The lookup of one name in one folder.
struct PathLookup {
  std::string folder;  // its path, without links
  std::string name;
  bool is_last = false;  // the last name of the path, or of a link in its place: the file itself
};

/// Calls `visit` for each name that an absolute path is resolved through, links' targets included.
/// The call comes before the name is examined, so that no change is missed if visit watches the
/// folder. Ends after the first name that is missing.
void visit_lookups(const std::string& path, const std::function<void(const PathLookup&)>& visit);

}  // namespace frontend
