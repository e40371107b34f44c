// Reads a design as the command does.
#pragma once

#include <filesystem>
#include <string>

#include "frontend/design_file.hpp"
#include "language/csg_writer.hpp"
#include "language/evaluation.hpp"

namespace test_support {

/// Reads a .csg, or a .scad, which scadray's own evaluator evaluates; keeps its text.
inline frontend::DesignFile read_design_file(const std::filesystem::path& file) {
  frontend::DesignFileOptions options;
  options.evaluator = frontend::Evaluator::kOwn;
  options.wants_text = true;
  options.message = [](const frontend::DesignMessage&) {};
  options.progress = [](const char*) {};
  return frontend::read_design(file.string(), options);
}

inline frontend::ImportedDesign read_design(const std::filesystem::path& file) {
  frontend::DesignFile design = read_design_file(file);
  return frontend::import_design(design);
}

/// Returns the .csg of a .scad.
inline std::string csg_text(const std::filesystem::path& scad) {
  return language::csg_text(*read_design_file(scad).text.evaluation->tree);
}

}  // namespace test_support
