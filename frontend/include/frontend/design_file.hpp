// A design's file, .csg or .scad, as a syntax tree.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "frontend/syntax_tree.hpp"

namespace frontend {

struct DesignFile {
  std::string name;            // as messages show it
  std::size_t file_bytes = 0;  // of the .csg text that was parsed
  SyntaxTree tree;
  bool is_exported = false;        // from a .scad
  std::vector<std::string> files;  // that it was read from, the design last; if wanted
  double export_ms = 0;            // openscad, for a .scad
  double read_ms = 0;
  double parse_ms = 0;
};

struct DesignFileOptions {
  std::vector<std::string> openscad_arguments;  // handed on to openscad for a .scad
  bool wants_files = false;
  /// Given each line that openscad says.
  std::function<void(const std::string& line)> message;
  /// Called with what is done, a .scad's export many times.
  std::function<void(const char* stage)> progress;
};

/// `path` is a .csg; a .scad, which the installed openscad exports; or "-", a .csg from standard
/// input. Throws Error.
DesignFile read_design(const std::string& path, const DesignFileOptions& options);

}  // namespace frontend
