// Reads a design's file, .csg or .scad, up to what the importer takes from it.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "frontend/camera.hpp"
#include "frontend/design_file_options.hpp"
#include "frontend/file_text.hpp"
#include "frontend/files.hpp"
#include "frontend/importer.hpp"

namespace language {
struct Evaluation;
}  // namespace language

namespace frontend {

/// A design, ready to be parsed or, where it is evaluated already, to be imported.
struct DesignText {
  FileText csg;
  /// What text_in_memory() gives of the design: the text that is evaluated.
  std::optional<FileText> scad{};
  std::string csg_path{};            // absolute, of the file that `csg` is from; "": there is none
  std::optional<DesignTree> tree{};  // of `csg`, if it had to be parsed to tell that it is one
  std::shared_ptr<const language::Evaluation> evaluation{};  // in place of a text, if not null
  std::string name;                                          // for the parser's messages
  bool is_exported = false;        // it was made from a .scad, by scadray or openscad
  std::vector<std::string> files;  // files it was read from, as far as they are known, the design
                                   // last
  double export_ms = 0;            // time that the evaluation of a .scad took
  double read_ms = 0;
};

struct DesignFile {
  std::string name{};          // as messages show it
  std::size_t file_bytes = 0;  // size of the .csg text that was parsed
  DesignTree tree;
  ImportOptions import{};            // import_design() takes these, too
  DesignCamera camera{};             // that the design asks for
  bool is_exported = false;          // it was made from a .scad, by scadray or openscad
  std::vector<std::string> files{};  // files it was read from, the design last; empty unless wanted
  double export_ms = 0;              // time that the evaluation of a .scad took
  double read_ms = 0;
  double parse_ms = 0;
  DesignText text{};  // that it was parsed from; empty unless wanted
};

/// Returns the design's text where it is not to be read from the path anew: a call of import() for
/// a mesh or a drawing; what a path that can be read only once gives (is_read_once()); and the text
/// of a file whose name does not tell whether it is a .csg or a .scad. Nothing for other .csg and
/// .scad files, and for one that does not exist. A text that no .csg begins like may be a start of
/// it if it is larger than any .scad. Throws Error for what is neither text, mesh nor drawing;
/// Stopped (stop.hpp) once `stop` is requested.
std::optional<FileText> text_in_memory(const std::string& path, const std::stop_token& stop = {});

/// Returns the options with the folder of the files that the design names: its own; and with the
/// fonts that it uses, if it is a .scad, which was exported.
ImportOptions beside(const std::string& path, const DesignText& text, ImportOptions options);

/// Adds the files that a finished import names to those that its text was read from, the design
/// last.
void add_imported_files(const ImportedDesign& design, std::vector<std::string>& files);

/// Returns the files that reading the design is known to need beforehand: the design, and
/// openscad's parameter file.
std::vector<NamedPath> design_inputs(const std::string& path,
                                     const std::vector<std::string>& openscad_arguments);

/// Reads and parses a design. `path` is a .csg; a .scad, which is evaluated; a mesh or drawing,
/// which is shown as import() shows it; or "-", standard input. That, and a file of any other name,
/// is a .scad if there are options, such as -D, that only an evaluation obeys, or if it cannot be
/// parsed as a .csg. Throws Error, also if `files` are wanted and openscad does not name them, and
/// if memory runs out.
DesignFile read_design(const std::string& path, const DesignFileOptions& options);

/// Returns the tree of what was read. Throws what parse() throws (parser.hpp).
DesignTree tree_of(const DesignText& text, const std::stop_token& stop = {});

/// Imports `file.tree`. Throws what import_design() throws (importer.hpp), and
/// Error if memory runs out.
ImportedDesign import_design(const DesignFile& file);

/// The first step of read_design(): evaluates the design, or reads it if it is a .csg. The result
/// may be only a start of the text, if that start shows that the text cannot be parsed. `files`
/// lacks what openscad does not name. Throws Error, and Stopped (stop.hpp) once `stop` is
/// requested.
DesignText read_design_text(const std::string& path, const DesignFileOptions& options,
                            const std::stop_token& stop = {});

}  // namespace frontend
