// The options of a program, one row each, and those of `scadray`.
#pragma once

#include <boost/program_options.hpp>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace frontend {

/// The options of a program, one row each: its parser, its --help, its manual page and the shells'
/// completions (frontend/packaging) are all made from the rows. Boost.ProgramOptions is what
/// OpenSCAD reads its own command line with, so its syntax (abbreviated long options, `--render
/// x.scad` taking the file's name as its value, `-oFILE`) is the same by construction.
enum class Takes : uint8_t {
  kNothing,
  kText,
  kTexts,         // may be given more than once
  kOptionalText,  // may stand without a value, but takes the next word as one if there is one
  kCount,
};

/// What a shell offers where the value is to stand.
struct Completion {
  enum class Kind : uint8_t { kNothing, kFiles, kCommands, kWord, kWordList };
  Kind kind = Kind::kNothing;
  std::vector<std::string> (*words)() = nullptr;  // of kWord; of kWordList, joined by commas
};

constexpr Completion kAnyFile{Completion::Kind::kFiles};
constexpr Completion kAnyCommand{Completion::Kind::kCommands};

struct OptionRow {
  const char* names;  // "long,short"; long may be the short one's letter, as in OpenSCAD
  Takes takes;
  const char* value_name;
  const char* help;  // where it ends in a colon, the completion's words follow
  Completion completion = {};
};

/// The row's help with its words, without a full stop.
std::string help_of(const OptionRow& row);

/// The rows for the parser and for --help.
boost::program_options::options_description table_of(const char* title,
                                                     std::span<const OptionRow> rows,
                                                     unsigned columns);

/// OpenSCAD's options of `scadray`, with its names.
std::span<const OptionRow> openscad_options();

/// Those that only scadray has.
std::span<const OptionRow> own_options();

}  // namespace frontend
