// The files that a .scad includes, without running openscad.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "follow/file_signature.hpp"

namespace frontend {

/// The names in the `include <…>` and `use <…>` of a .scad's text, as they stand; those in comments
/// and strings do not count.
std::vector<std::string> included_names(std::string_view scad);

/// `openscad -d` names what a design has read, yet nothing where the design has an error, and no
/// file that was missing. These are the ones to watch even so.
class IncludedFiles {
 public:
  /// `scad_path` and all that it includes, and those include, each once. A name that is found
  /// nowhere stands for a path in each folder in which OpenSCAD looks. Files that did not change
  /// since the last call are not read again.
  std::vector<std::string> of(const std::string& scad_path);

 private:
  struct Known {
    FileSignature signature;
    std::vector<std::string> names;
  };
  const std::vector<std::string>& names_in(const std::string& path);

  std::map<std::string, Known> known_;
};

}  // namespace frontend
