// How a design's file is read.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "frontend/design_inputs.hpp"
#include "frontend/design_message.hpp"
#include "frontend/evaluator.hpp"
#include "frontend/file_text.hpp"
#include "frontend/import_options.hpp"
#include "language/evaluation.hpp"

namespace frontend {

struct DesignFileOptions {
  ImportOptions import;
  std::vector<std::string> openscad_arguments;  // OpenSCAD's options for the evaluation of a .scad
  Evaluator evaluator = Evaluator::kOpenScad;
  DesignInputs inputs;
  language::CameraChoice camera{};
  /// What text_in_memory() has given of the design before; nothing: it is asked.
  std::optional<FileText> text{};
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
  DesignMessageSink message;
  /// Called with the name of the current stage; during a .scad's export, many times.
  std::function<void(const char* stage)> progress;
};

}  // namespace frontend
