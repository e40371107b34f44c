// The result of one reading of a followed design.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "frontend/camera.hpp"
#include "frontend/design_file_options.hpp"
#include "frontend/design_tree.hpp"
#include "frontend/file_text.hpp"
#include "frontend/imported_design.hpp"
#include "frontend/source_place.hpp"
#include "language/customizer_parameter.hpp"

namespace language {
struct Evaluation;
}

namespace frontend {

/// What a design was made from.
struct DesignSource {
  DesignTree tree;
  std::shared_ptr<const language::Evaluation> evaluation;  // null: the tree is a .csg's
};

/// Returns whether a message is what echo() has said.
inline bool is_echo(std::string_view message) { return message.starts_with("ECHO: "); }

/// What the main file of a .scad offers to its user.
struct DesignParameters {
  std::string text;  // that they are from
  std::vector<language::CustomizerParameter> list;
};

/// One reading of a design: at the start, after a save, or with other inputs.
struct DesignVersion {
  uint64_t number = 0;  // counts up from 1
  /// Null if the design could not be read.
  std::shared_ptr<const ImportedDesign> design;
  /// "file:line:column: error: what (what to do)" if the design could not be read; else empty.
  std::string error;
  /// The evaluation's messages, then the importer's warnings, without the error.
  std::vector<std::string> messages;
  /// Where the causes of the messages stand, by index, as far as the evaluation tells; else without
  /// a line. There may be fewer than messages.
  std::vector<SourcePlace> places;
  /// How many of the messages were said before the error. Its traces are the next ones.
  std::size_t before_error = 0;
  /// The files that the design is known to be read from, the design first. Files that it asks for
  /// and that are missing are included.
  std::vector<std::string> files;
  DesignSource source;  // that `design` was made from
  DesignInputs inputs;  // that it was read with
  /// What text_in_memory() has given of a design that can be read only once; else nothing.
  std::optional<FileText> stream;
  DesignCamera camera;  // that the design asks for
  /// Those of the last text that could be parsed; null: there was none, or it is no .scad.
  std::shared_ptr<const DesignParameters> parameters;
  double export_ms = 0;  // time that the evaluation of a .scad took
  double read_ms = 0;
  double parse_ms = 0;
  double import_ms = 0;
  /// When the save was seen, before waiting for its end. Without a save: when the follower was
  /// started, or reload() or set_inputs() called.
  std::chrono::steady_clock::time_point noticed;
};

}  // namespace frontend
