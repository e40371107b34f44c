// A design's file, .csg or .scad, from disk to what is imported.
#pragma once

#include <cstddef>
#include <functional>
#include <stop_token>
#include <string>
#include <vector>

#include "frontend/file_text.hpp"
#include "frontend/files.hpp"
#include "frontend/importer.hpp"

namespace frontend {

/// What is parsed.
struct DesignText {
  FileText csg;
  std::string name;                // for the parser's messages
  bool is_exported = false;        // from a .scad
  std::vector<std::string> files;  // that it was read from, the design last; if wanted, and known
  double export_ms = 0;            // openscad, for a .scad
  double read_ms = 0;
};

struct DesignFile {
  std::string name{};                // as messages show it
  std::size_t file_bytes = 0;        // of the .csg text that was parsed
  TextImport import;                 // to be finished
  bool is_exported = false;          // from a .scad
  std::vector<std::string> files{};  // that it was read from, the design last; if wanted
  double export_ms = 0;              // openscad, for a .scad
  double read_ms = 0;
  double parse_ms = 0;
};

struct DesignFileOptions {
  ImportOptions import;
  std::vector<std::string> openscad_arguments;  // handed on to openscad for a .scad
  bool wants_files = false;
  /// Given each line that openscad says.
  std::function<void(const std::string& line)> message;
  /// Called with what is done, a .scad's export many times.
  std::function<void(const char* stage)> progress;
};

/// By its name: whether openscad has to export it.
bool is_scad(const std::string& path);

/// Whether openscad has to export it if it cannot be parsed: a regular file of any name but .csg's,
/// as editors' plugins hand over temporary files without a suffix. (What is no regular file can be
/// read only once.)
bool may_be_scad(const std::string& path);

/// What reading a design is known to read, before it is read: the design, openscad's parameters.
std::vector<NamedPath> design_inputs(const std::string& path,
                                     const std::vector<std::string>& openscad_arguments);

/// `path` is a .csg; a .scad, which the installed openscad exports; or "-", a .csg from standard
/// input. A file of another name is a .csg if it parses as one, else a .scad. Throws Error, also
/// where openscad does not say which files it reads and they are wanted, and where memory runs out.
DesignFile read_design(const std::string& path, const DesignFileOptions& options);

/// `file.import`, finished, once. Throws what that throws, and Error where memory runs out.
ImportedDesign import_design(DesignFile& file);

// The two steps of it, which can be stopped: Stopped (stop.hpp) is thrown where `stop` asks for it.

/// A .scad by its name is exported, everything else is read only; it may end where it is seen that
/// it cannot be parsed. What openscad does not say is left out of `files`. Throws Error.
DesignText read_design_text(const std::string& path, const DesignFileOptions& options,
                            const std::stop_token& stop = {});

/// In the place of a `text` that cannot be parsed, where may_be_scad(). Throws Error.
void export_design_text(const std::string& path, const DesignFileOptions& options, DesignText& text,
                        const std::stop_token& stop = {});

}  // namespace frontend
