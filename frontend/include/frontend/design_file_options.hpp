// How a design's file is read: by which program, with which inputs, and who is told.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "frontend/file_text.hpp"
#include "frontend/import_options.hpp"
#include "frontend/source_place.hpp"
#include "language/evaluation.hpp"
#include "language/parameter_value.hpp"

namespace frontend {

/// Which program evaluates a .scad.
enum class Evaluator : uint8_t {
  kOwn,       // frontend/language
  kOpenScad,  // the installed openscad
};

/// What the command has a design evaluated by unless --evaluator says otherwise.
constexpr Evaluator kDefaultEvaluator = Evaluator::kOwn;

/// What a .scad is evaluated with, besides its files and OpenSCAD's options.
struct DesignInputs {
  /// In place of the parameter set that -p and -P name.
  std::optional<language::ParameterSet> parameters;
  /// $t. Openscad takes it by -D, behind the assignments of the design's own top level.
  std::optional<double> time;
  /// In place of the language that is chosen otherwise.
  std::optional<language::LanguageVersion> language{};

  bool operator==(const DesignInputs&) const = default;
};

/// A line that the evaluation of a design says.
struct DesignMessage {
  const std::string& text;
  SourcePlace place{};         // that the text names; line 0: none, or the text alone tells it
  bool follows_error = false;  // it was said after the ERROR that ends the reading
  operator const std::string&() const { return text; }
};

using DesignMessageSink = std::function<void(const DesignMessage&)>;

/// What every program that reads designs is told of them.
struct ReadingOptions {
  ImportOptions import{};
  std::vector<std::string> openscad_arguments{};  // OpenSCAD's, for the evaluation of a .scad
  Evaluator evaluator = kDefaultEvaluator;
};

struct DesignFileOptions : ReadingOptions {
  DesignInputs inputs{};
  language::CameraChoice camera{};
  language::ViewCamera view{};  // of the command line
  /// What text_in_memory() has given of the design before; nothing: it is asked.
  std::optional<FileText> text{};
  /// Texts that the own evaluator reads in place of included and used files; null: none.
  std::shared_ptr<const language::TextOverlay> overlay{};
  /// What the own evaluator keeps between readings of the design; null: nothing.
  std::shared_ptr<language::EvaluationCache> cache{};
  bool wants_files = false;
  /// A syntax error in a used file ends the own evaluator's reading, too.
  bool needs_all_files = false;
  bool wants_text = false;  // DesignFile::text
  /// Called with the absolute paths of the files that the own evaluator has read or looked for in
  /// vain, also where the evaluation fails.
  std::function<void(std::vector<std::string> paths)> watch{};
  /// Called with each message of the evaluation; an echoed string can give it several lines.
  DesignMessageSink message{};
  /// Called with the name of the current stage; during a .scad's export, many times.
  std::function<void(const char* stage)> progress{};
};

}  // namespace frontend
