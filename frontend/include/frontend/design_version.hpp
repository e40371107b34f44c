// What one reading of a followed design has given.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "frontend/file_text.hpp"
#include "frontend/imported_design.hpp"

namespace frontend {

/// One reading of a design: at the start, or after a save.
struct DesignVersion {
  uint64_t number = 0;  // counts up from 1
  /// Null where it could not be read.
  std::shared_ptr<const ImportedDesign> design;
  /// Where it could not be read, "file:line:column: error: what (what to do)"; empty otherwise.
  std::string error;
  /// What openscad said, and then the importer's warnings. The error is not among them.
  std::vector<std::string> messages;
  /// All that it is read from, as far as is known, the design first; missing files that it asks
  /// for, too.
  std::vector<std::string> files;
  /// Its .csg is byte for byte that of the last version that could be read; `design` is that one's
  /// pointer. The messages may be others.
  bool unchanged = false;
  std::shared_ptr<const FileText> csg;  // that `design` was made of
  std::size_t nodes = 0;  // of the .csg; those of the last version where it is unchanged
  double export_ms = 0;   // openscad, for a .scad
  double read_ms = 0;
  double parse_ms = 0;
  double import_ms = 0;
  /// When the save was seen, before waiting for its end; the start, or reload(), without a save.
  std::chrono::steady_clock::time_point noticed;
};

}  // namespace frontend
