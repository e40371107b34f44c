// Finds the files that a .scad includes, without running openscad.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "language/file_signature.hpp"

namespace frontend {

/// Returns the names in the `include <…>` and `use <…>` of a .scad's text, as written there.
/// Comments and strings are skipped.
std::vector<std::string> included_names(std::string_view scad);

/// Returns whether OpenSCAD takes a file that is used for a font, by its suffix.
bool is_font_name(std::string_view name);

/// Finds the files to watch where openscad does not name them: `openscad -d` names what a design
/// has read, but nothing if the design has an error, and no missing file.
class IncludedFiles {
 public:
  /// Returns `scad_path` and, each once, all files that it includes directly or indirectly. A name
  /// that is found nowhere yields its path in each folder in which OpenSCAD looks. Files that have
  /// not changed since the last call are not read again.
  std::vector<std::string> of(const std::string& scad_path);
  /// Returns those of them that are fonts, and are there.
  std::vector<std::string> fonts_of(const std::string& scad_path);

 private:
  struct Known {
    language::FileSignature signature;
    std::vector<std::string> names;
  };
  const std::vector<std::string>& names_in(const std::string& path);

  std::map<std::string, Known> known_;
};

}  // namespace frontend
