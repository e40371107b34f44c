// Where `include` and `use` look for files (LANGUAGE.md, "Text").
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace language {

/// Finds files in the order: absolute path; the folder of the file that names it; the parts of
/// OPENSCADPATH; the user's and the system's library folder.
class LibrarySearch {
 public:
  /// Reads the environment. Absolute paths that were tried and do not exist are added to `lookups`.
  explicit LibrarySearch(std::vector<std::string>& lookups);

  /// Returns the absolute path of a file that is named in a file of `folder` (absolute). Links and
  /// dots are followed, except, as in OpenSCAD, where a library folder has it: then its path is
  /// that of the library folder, and the name. Empty: there is none but folders and the paths in
  /// `excluded`.
  std::string find(std::string_view name, const std::string& folder,
                   std::span<const std::string> excluded = {});

 private:
  bool is_file(const std::filesystem::path& path);

  std::vector<std::string>& lookups_;
  std::vector<std::string> library_folders_;  // absolute
};

}  // namespace language
