// What a program evaluates to, for tests.
#pragma once

#include <string>

#include "language/evaluation.hpp"

namespace language {

struct Options {
  bool hard_warnings = false;
  bool check_parameters = true;
};

struct Evaluated {
  Evaluation evaluation;
  std::string messages;  // lines, as OpenSCAD prints them
  std::string tree;      // the .csg
};

/// Evaluates a program as the file design.scad, beside which library.scad, quiet.scad and
/// folder/unset.scad lie.
Evaluated evaluated(const std::string& program, const Options& options = {});

}  // namespace language
