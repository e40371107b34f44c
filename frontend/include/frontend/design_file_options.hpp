// How a design's file is read.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "frontend/design_inputs.hpp"
#include "frontend/evaluator.hpp"
#include "frontend/import_options.hpp"

namespace frontend {

struct DesignFileOptions {
  ImportOptions import;
  std::vector<std::string> openscad_arguments;  // OpenSCAD's options for the evaluation of a .scad
  Evaluator evaluator = Evaluator::kOpenScad;
  DesignInputs inputs;
  bool wants_files = false;
  /// Called with each line that the evaluation prints.
  std::function<void(const std::string& line)> message;
  /// Called with the name of the current stage; during a .scad's export, many times.
  std::function<void(const char* stage)> progress;
};

}  // namespace frontend
