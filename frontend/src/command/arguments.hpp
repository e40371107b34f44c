// The words of a program's command line, sorted by option, and their values, checked.
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

namespace frontend {

/// Throws Error without a place.
[[noreturn]] void fail(const std::string& what, const std::string& todo);
[[noreturn]] void bad_value(const std::string& option, const std::string& value,
                            const std::string& todo);

/// The whole text as a finite number; a leading + is allowed.
template <typename Number>
std::optional<Number> parse_number(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  Number number{};
  const auto [end, failed] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (failed != std::errc() || end != text.data() + text.size()) return std::nullopt;
  if constexpr (std::is_floating_point_v<Number>) {
    if (!std::isfinite(number)) return std::nullopt;
  }
  return number;
}

/// Without spaces around the parts.
std::vector<std::string_view> split_at_commas(std::string_view text);

class Arguments {
 public:
  /// Gives {option, value} for a word that the library is not to read; nothing for others.
  using WordReader = std::function<std::pair<std::string, std::string>(const std::string& word)>;

  /// By the table, whatever is no option being a "file"; `program` is called for --help. Throws
  /// Error.
  Arguments(const boost::program_options::options_description& options,
            const std::vector<std::string>& words, const std::string& program,
            const WordReader& reader = {});

  bool has(const char* option) const { return values_.count(option) > 0; }
  const std::string& text(const char* option) const { return values_[option].as<std::string>(); }
  std::string text_or_empty(const char* option) const {
    return has(option) ? text(option) : std::string();
  }
  std::vector<std::string> texts(const char* option) const {
    return has(option) ? values_[option].as<std::vector<std::string>>()
                       : std::vector<std::string>{};
  }
  /// The option's value as a number in [least, most], or `missing`. An empty `todo` names the
  /// range.
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
  /// Calls visit(option, value) for every option in the order of the command line.
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

/// The value that goes with the option's word, or `missing`.
template <typename Value, std::size_t kCount>
Value choice(const Arguments& arguments, const char* option, const Word<Value> (&names)[kCount],
             Value missing) {
  if (!arguments.has(option)) return missing;
  const std::string& word = arguments.text(option);
  if (const Value* value = find_word(names, word)) return *value;
  bad_value(option, word, "give " + listed(names));
}

/// --imgsize; without it `camera` keeps its own.
void read_image_size(const Arguments& arguments, CameraOptions& camera);
/// --camera, --viewall, --autocenter, --projection.
void read_camera(const Arguments& arguments, CameraOptions& camera);
/// --renderer; without it kAuto.
RendererKind read_renderer(const Arguments& arguments);
/// What only an OpenSCAD can follow, as it is handed on to it: -D, -p, -P, -m, --hardwarnings,
/// --check-parameters, --check-parameter-ranges.
std::vector<std::string> openscad_arguments_of(const Arguments& arguments);
/// --leaf-primitives, --threshold, --threads; without them `render` keeps its own.
void read_cells_and_threads(const Arguments& arguments, RenderSettings& render);

}  // namespace frontend
