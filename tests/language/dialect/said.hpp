// What a design says and makes in each dialect.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <string>

#include "language/csg_writer.hpp"
#include "language/evaluation.hpp"

namespace language {

/// The text of each file that a design uses, by its name.
using BesideFiles = std::map<std::string, std::string>;

struct Said {
  std::string messages;  // lines, as OpenSCAD prints them
  std::string tree;      // the .csg
};

/// Evaluates a program as the file design.scad.
inline Said evaluated(const std::string& program, const EvaluationOptions& options,
                      const BesideFiles& files = {}) {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("dialect-test-" + std::to_string(getpid()));
  std::filesystem::create_directories(folder);
  for (const auto& [name, text] : files) {
    std::filesystem::create_directories((folder / name).parent_path());
    std::ofstream(folder / name) << text;
  }
  std::ofstream(folder / "design.scad") << program;
  Said said;
  const Evaluation evaluation =
      evaluate((folder / "design.scad").string(), options,
               [&](std::string_view line) { (said.messages += line) += '\n'; });
  said.tree = csg_text(*evaluation.tree);
  std::filesystem::remove_all(folder);
  return said;
}

inline EvaluationOptions in_language(LanguageVersion language) {
  EvaluationOptions options;
  options.language = language;
  return options;
}
inline std::string said_2021(const std::string& program, const BesideFiles& files = {}) {
  return evaluated(program, in_language(LanguageVersion::k2021), files).messages;
}
inline std::string said_2026(const std::string& program, const BesideFiles& files = {}) {
  return evaluated(program, in_language(LanguageVersion::k2026), files).messages;
}
inline std::string tree_2021(const std::string& program, const BesideFiles& files = {}) {
  return evaluated(program, in_language(LanguageVersion::k2021), files).tree;
}
inline std::string tree_2026(const std::string& program, const BesideFiles& files = {}) {
  return evaluated(program, in_language(LanguageVersion::k2026), files).tree;
}

}  // namespace language
