// Sorts the words of a program's command line by option, and checks their values.
#pragma once

#include <boost/program_options.hpp>
#include <charconv>
#include <cmath>
#include <functional>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "command/option_words.hpp"
#include "frontend/camera.hpp"
#include "frontend/run_program.hpp"

namespace frontend {

/// Throws an Error without a place.
[[noreturn]] void fail(const std::string& what, const std::string& todo);
[[noreturn]] void bad_value(const std::string& option, const std::string& value,
                            const std::string& todo);

/// Parses the whole text as a number, infinities and nan among them; a leading + is allowed.
template <typename Number>
std::optional<Number> parse_any_number(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  Number number{};
  const auto [end, failed] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (failed != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return number;
}

/// Parses the whole text as a finite number; a leading + is allowed.
template <typename Number>
std::optional<Number> parse_number(std::string_view text) {
  const std::optional<Number> number = parse_any_number<Number>(text);
  if constexpr (std::is_floating_point_v<Number>) {
    if (number && !std::isfinite(*number)) return std::nullopt;
  }
  return number;
}

/// Returns the parts without the spaces around them.
std::vector<std::string_view> split_at_commas(std::string_view text);

class Arguments {
 public:
  /// Returns {option, value} for a word that boost is not to read, and empty strings for any other.
  using WordReader = std::function<std::pair<std::string, std::string>(const std::string& word)>;

  /// Parses the words by the table. A word that is not an option is a "file". `program` is the name
  /// in messages that refer to --help. Throws Error.
  Arguments(const boost::program_options::options_description& options,
            const std::vector<std::string>& words, const std::string& program,
            const WordReader& reader = {});

  bool has(const char* option) const { return values_.count(option) > 0; }
  /// Returns what --help and --version ask for. These are options of the table.
  ProgramRequest request() const {
    return has("help")      ? ProgramRequest::kHelp
           : has("version") ? ProgramRequest::kVersion
                            : ProgramRequest::kWork;
  }
  const std::string& text(const char* option) const { return values_[option].as<std::string>(); }
  std::string text_or_empty(const char* option) const {
    return has(option) ? text(option) : std::string();
  }
  std::vector<std::string> texts(const char* option) const {
    return has(option) ? values_[option].as<std::vector<std::string>>()
                       : std::vector<std::string>{};
  }
  /// Returns the option's value as a number in [least, most], or `missing` without the option. With
  /// an empty `todo` the error names the range.
  template <typename Number>
  Number number(const char* option, Number least, Number most, Number missing,
                const std::string& todo = {}) const {
    if (!has(option)) return missing;
    const std::optional<Number> number = parse_number<Number>(text(option));
    if (number && *number >= least && *number <= most) return *number;
    std::ostringstream range;
    range << "give a number from " << least << " to " << most;
    bad_value(option, text(option), todo.empty() ? range.str() : todo);
  }
  /// Calls visit(option, value) for every option, in the order of the command line.
  template <typename Visit>
  void for_each(Visit visit) const {
    for (const auto& option : parsed_.options) {
      if (option.position_key < 0) {
        visit(option.string_key, option.value.empty() ? std::string() : option.value[0]);
      }
    }
  }

 private:
  boost::program_options::options_description table_;
  boost::program_options::parsed_options parsed_{nullptr};
  boost::program_options::variables_map values_;
};

/// "a, b or c"
template <typename Value, std::size_t kCount>
std::string listed(const Word<Value> (&names)[kCount]) {
  std::string list;
  for (std::size_t i = 0; i < kCount; ++i) {
    list += i == 0 ? "" : (i + 1 < kCount ? ", " : " or ");
    list += names[i].first;
  }
  return list;
}

/// Returns the value that the option's word names, or `missing` without the option.
template <typename Value, std::size_t kCount>
Value choice(const Arguments& arguments, const char* option, const Word<Value> (&names)[kCount],
             Value missing) {
  if (!arguments.has(option)) return missing;
  const std::string& word = arguments.text(option);
  if (const Value* value = find_word(names, word)) return *value;
  bad_value(option, word, "give " + listed(names));
}

/// Reads --imgsize; without it, `camera` keeps its size.
void read_image_size(const Arguments& arguments, CameraOptions& camera);
/// Reads --camera, --viewall, --autocenter and --projection.
/// Returns a warning: empty, or that words are no numbers, and that the standard camera is taken.
std::string read_camera(const Arguments& arguments, CameraOptions& camera);
/// Reads --renderer; without it, returns kAuto.
RendererKind read_renderer(const Arguments& arguments);
/// Returns the version of the language, which the environment sets where the option does not.
language::LanguageVersion read_language(const Arguments& arguments);
/// Reads how designs are read: --evaluator, the language, and what is handed on to openscad as it
/// is: -D, -p, -P, -m, --hardwarnings, --check-parameters, --check-parameter-ranges, --enable,
/// --trace-….
void read_reading_options(const Arguments& arguments, ReadingOptions& options);

/// Returns those of OpenSCAD's options that are handed on to it where it writes an output: all but
/// those of outputs and frames, and --summary-file only where it is openscad that writes it.
std::vector<std::string> handed_arguments_of(const Arguments& arguments, bool has_summary_file);

/// Reads --leaf-primitives, --threshold and --threads; without them, `render` keeps its values.
void read_cells_and_threads(const Arguments& arguments, RenderSettings& render);

}  // namespace frontend
