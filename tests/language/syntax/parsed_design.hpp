// A design that a test writes into a folder of its own and parses.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "syntax/parse_program.hpp"
#include "syntax/syntax.hpp"

namespace language {

using Lines = std::vector<std::string>;

class DesignFolder {
 public:
  DesignFolder() : path_(make_folder()), start_(std::filesystem::current_path()) {
    std::filesystem::current_path(path_);
  }
  DesignFolder(const DesignFolder&) = delete;
  DesignFolder& operator=(const DesignFolder&) = delete;
  ~DesignFolder() {
    std::filesystem::current_path(start_);
    std::filesystem::remove_all(path_);
  }
  void write(const std::string& name, const std::string& text) const {
    std::filesystem::create_directories((path_ / name).parent_path());
    std::ofstream(path_ / name, std::ios::binary) << text;
  }

 private:
  static std::filesystem::path make_folder() {
    std::string name = testing::TempDir() + "design_XXXXXX";
    if (!mkdtemp(name.data())) throw std::runtime_error("no temporary folder");
    return std::filesystem::canonical(name);
  }

  std::filesystem::path path_, start_;
};

struct ParsedDesign {
  explicit ParsedDesign(const std::string& path = "main.scad", const ParseOptions& options = {})
      : outcome(parse_program(program, messages, path, options)) {}

  /// Returns the assignments of a unit's top level, as text.
  Lines assignments(size_t unit = 0) const {
    Lines texts;
    for (const Assignment& assignment : program.units.at(unit).scope->assignments) {
      texts.push_back(std::string(program.names.text(assignment.name)) + " = ");
      append_expression_text(texts.back(), *assignment.value, program.names);
    }
    return texts;
  }

  Program program;
  Lines lines;
  Messages messages{program.files,
                    [this](const Message& message) { lines.push_back(message.line); }};
  ParseOutcome outcome;
};

/// Parses a design of one file.
inline ParsedDesign parse_text(std::string_view text) {
  ParseOptions options;
  options.text = text;
  return ParsedDesign("-", options);
}

}  // namespace language
