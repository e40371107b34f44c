#include "frontend/options.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <optional>
#include <sstream>
#include <string_view>

#include "frontend/color_scheme.hpp"
#include "frontend/error.hpp"
#include "option_table.hpp"
#include "option_words.hpp"

namespace frontend {
namespace {

namespace po = boost::program_options;

constexpr unsigned kMaxThreads = 1024;
constexpr unsigned kHelpColumns = 80;

po::options_description openscad_table() {
  return table_of("OpenSCAD's options", openscad_options(), kHelpColumns);
}

po::options_description own_table() {
  return table_of("scadray's own options", own_options(), kHelpColumns);
}

[[noreturn]] void fail(const std::string& what, const std::string& todo) {
  throw Error("", {}, what, todo);
}

[[noreturn]] void bad_value(const std::string& option, const std::string& value,
                            const std::string& todo) {
  fail("--" + option + "=" + value + " is not understood", todo);
}

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

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(' ');
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(' ') + 1 - first);
}

std::vector<std::string_view> split_at_commas(std::string_view text) {
  std::vector<std::string_view> parts;
  while (true) {
    const std::size_t comma = text.find(',');
    parts.push_back(trimmed(text.substr(0, comma)));
    if (comma == std::string_view::npos) return parts;
    text.remove_prefix(comma + 1);
  }
}

std::string lower_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

/// The words of the command line, sorted by option; not checked further.
class Arguments {
 public:
  explicit Arguments(const std::vector<std::string>& words);

  bool has(const char* option) const { return values_.count(option) > 0; }
  const std::string& text(const char* option) const { return values_[option].as<std::string>(); }
  std::vector<std::string> texts(const char* option) const {
    return has(option) ? values_[option].as<std::vector<std::string>>()
                       : std::vector<std::string>{};
  }
  /// The option's value as a number in [least, most], or `missing`.
  template <typename Number>
  Number number(const char* option, Number least, Number most, Number missing,
                const char* todo) const {
    if (!has(option)) return missing;
    const std::optional<Number> number = parse_number<Number>(text(option));
    if (!number || !(*number >= least && *number <= most)) bad_value(option, text(option), todo);
    return *number;
  }
  /// Calls visit(option, value) for every option in the order of the command line.
  template <typename Visit>
  void for_each(Visit visit) const {
    for (const po::option& option : parsed_.options) {
      if (option.position_key < 0) {
        visit(option.string_key, option.value.empty() ? std::string() : option.value[0]);
      }
    }
  }

 private:
  static std::pair<std::string, std::string> openscad_prefix(
      const po::options_description& openscad, const po::options_description& own,
      const std::string& word);

  po::options_description table_;
  po::parsed_options parsed_{nullptr};
  po::variables_map values_;
};

/// An abbreviation that is clear among OpenSCAD's options stays clear although ours are there, too:
/// `--rend` is `--render`. Gives {option, value}, or nothing to leave the word to the library.
std::pair<std::string, std::string> Arguments::openscad_prefix(
    const po::options_description& openscad, const po::options_description& own,
    const std::string& word) {
  if (!word.starts_with("--") || word.size() == 2) return {};
  const std::size_t equals = word.find('=');
  const std::string name = word.substr(2, equals == std::string::npos ? equals : equals - 2);
  const auto matches = [&name](const po::options_description& table) {
    std::vector<std::string> found;
    for (const auto& option : table.options()) {
      if (option->long_name() == name) return std::vector<std::string>{};
      if (option->long_name().starts_with(name)) found.push_back(option->long_name());
    }
    return found;
  };
  const std::vector<std::string> meant = matches(openscad);
  if (meant.size() != 1 || matches(own).empty()) return {};
  return {meant[0], equals == std::string::npos ? "" : word.substr(equals + 1)};
}

Arguments::Arguments(const std::vector<std::string>& words) {
  const po::options_description openscad = openscad_table();
  const po::options_description own = own_table();
  po::options_description files;
  files.add_options()("file", po::value<std::vector<std::string>>());
  table_.add(openscad).add(own).add(files);
  po::positional_options_description positions;
  positions.add("file", -1);
  try {
    parsed_ = po::command_line_parser(words)
                  .options(table_)
                  .positional(positions)
                  .extra_parser(
                      [&](const std::string& word) { return openscad_prefix(openscad, own, word); })
                  .run();
    po::store(parsed_, values_);
    po::notify(values_);
  } catch (const po::error& error) {
    fail(error.what(), "see scadray --help");
  }
}

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

uint32_t picture_side(std::string_view text, const std::string& value) {
  const std::optional<uint32_t> side = parse_number<uint32_t>(text);
  if (!side || *side == 0 || *side > kMaxPictureSide_px) {
    bad_value("imgsize", value,
              "give width,height in pixels, each from 1 to " + std::to_string(kMaxPictureSide_px));
  }
  return *side;
}

void read_image_size(const Arguments& arguments, CameraOptions& camera) {
  if (!arguments.has("imgsize")) return;
  const std::string& value = arguments.text("imgsize");
  const std::vector<std::string_view> sides = split_at_commas(value);
  if (sides.size() != 2) bad_value("imgsize", value, "give two numbers: width,height");
  camera.width_px = picture_side(sides[0], value);
  camera.height_px = picture_side(sides[1], value);
}

void read_camera(const Arguments& arguments, CameraOptions& camera) {
  camera.view_all = arguments.has("viewall");
  camera.auto_center = arguments.has("autocenter");
  if (arguments.has("camera")) {
    const std::string& value = arguments.text("camera");
    std::vector<double> numbers;
    for (const std::string_view part : split_at_commas(value)) {
      const std::optional<double> number = parse_number<double>(part);
      if (!number) bad_value("camera", value, "give 6 or 7 finite numbers, with commas between");
      numbers.push_back(*number);
    }
    camera.camera = camera_from_numbers(numbers);
  }
  camera.projection = choice(arguments, "projection", kProjections, camera.projection);
}

void read_color_scheme(const Arguments& arguments, RenderSettings& render) {
  render.scheme = color_schemes().front();
  if (!arguments.has("colorscheme")) return;
  const ColorScheme* scheme = find_color_scheme(arguments.text("colorscheme"));
  if (!scheme) {
    std::string names;
    for (const ColorScheme& known : color_schemes()) {
      names += (names.empty() ? "" : ", ") + std::string(known.name);
    }
    bad_value("colorscheme", arguments.text("colorscheme"), "give one of " + names);
  }
  render.scheme = *scheme;
}

/// Who speaks of cells without --technique means them.
Technique read_technique(const Arguments& arguments, const RenderSettings& render) {
  const bool wants_cells =
      render.threshold_px > 0 || render.show == Show::kCells || arguments.has("leaf-primitives");
  const Technique technique = choice(arguments, "technique", kTechniques,
                                     wants_cells ? Technique::kCells : Technique::kAuto);
  if (technique == Technique::kTiles && render.show == Show::kCells) {
    fail("--technique=tiles has no cells to show", "leave out --technique or --show");
  }
  return technique;
}

void read_facets(const Arguments& arguments, ImportOptions& import) {
  if (!arguments.has("facets")) return;
  const std::string& value = arguments.text("facets");
  if (const Facets* facets = find_word(kFacets, value)) {
    import.facets = *facets;
  } else if (const std::optional<uint32_t> fragments = parse_number<uint32_t>(value)) {
    import.few_fragments = *fragments;
  } else {
    bad_value("facets", value, "give a whole number from 0, all or none");
  }
}

void read_render(const Arguments& arguments, RenderSettings& render) {
  read_color_scheme(arguments, render);
  render.shading = choice(arguments, "shading", kShadings, render.shading);
  render.show = choice(arguments, "show", kShows, render.show);
  render.renderer = choice(arguments, "renderer", kRenderers, render.renderer);
  render.leaf_primitives =
      arguments.number<uint32_t>("leaf-primitives", 1, UINT32_MAX, 8, "give a whole number from 1");
  render.threshold_px =
      arguments.number<double>("threshold", 0, HUGE_VAL, 0, "give a number of pixels from 0");
  render.threads = arguments.number<unsigned>("threads", 1, kMaxThreads, 0,
                                              "give a whole number from 1 to 1024");
  static_assert(kMaxSamples == 64, "said below");
  render.samples =
      arguments.number<uint32_t>("samples", 1, kMaxSamples, 1, "give a whole number from 1 to 64");
  render.technique = read_technique(arguments, render);
}

/// OpenSCAD says that it ignores a view it does not know, and goes on.
void read_view(const Arguments& arguments, Options& options) {
  if (!arguments.has("view")) return;
  for (const std::string_view name : split_at_commas(arguments.text("view"))) {
    bool Overlays::*const* overlay = find_word(kViews, name);
    if (overlay && *overlay) {
      options.overlays.*(*overlay) = true;
    } else if (overlay) {
      options.warnings.push_back("--view=" + std::string(name) +
                                 " has no effect, as in OpenSCAD's preview");
    } else {
      options.warnings.push_back("--view=" + std::string(name) +
                                 " is not known and ignored (give axes, crosshairs, edges or "
                                 "scales)");
    }
  }
  if (options.overlays.scales && !options.overlays.axes) {
    options.warnings.push_back("--view=scales has no effect without axes, as in OpenSCAD");
  }
}

}  // namespace

PictureFormat picture_format(const std::string& path) {
  const std::size_t dot = path.rfind('.');
  const std::size_t slash = path.rfind('/');
  const bool has_suffix = dot != std::string::npos && (slash == std::string::npos || dot > slash);
  const PictureFormat* format =
      has_suffix ? find_word(kFormats, lower_case(path.substr(dot + 1))) : nullptr;
  if (!format) {
    throw Error(
        path, {}, "is no picture",
        "end it in .png or .exr, or give --export-format=png or exr; whatever else a design "
        "is exported to, openscad writes");
  }
  return *format;
}

namespace {

Output make_output(const std::string& path, const PictureFormat* given) {
  return {path, given ? *given : picture_format(path)};
}

void read_outputs(const Arguments& arguments, Options& options) {
  const PictureFormat* given = nullptr;
  if (arguments.has("export-format")) {
    const std::string& value = arguments.text("export-format");
    given = find_word(kFormats, lower_case(value));
    if (!given) bad_value("export-format", value, "scadray writes png and exr; the rest openscad");
  }
  arguments.for_each([&](const std::string& option, const std::string& value) {
    if (option == "o" || option == "s" || option == "x") {
      options.outputs.push_back(make_output(value, given));
    }
  });
  if (arguments.has("stats")) options.stats_path = arguments.text("stats");
  if (arguments.has("d")) options.rule_path = arguments.text("d");
  const auto to_stdout = std::count_if(options.outputs.begin(), options.outputs.end(),
                                       [](const Output& output) { return output.path == "-"; });
  if (to_stdout + (options.stats_path == "-") + (options.rule_path == "-") > 1) {
    fail("more than one output goes to standard output", "give all but one a file");
  }
  constexpr uint32_t kMostFrames = 99999;  // of five digits
  options.frames =
      arguments.number<uint32_t>("animate", 0, kMostFrames, 0, "give a number of frames");
  if (options.frames > 0 && to_stdout > 0) {
    fail("--animate does not go to standard output", "give -o a file's name");
  }
  if (options.outputs.size() * std::max(options.frames, 1u) > kMaxPictures) {
    fail("more than " + std::to_string(kMaxPictures) + " pictures", "give fewer -o or frames");
  }
}

/// Options that only an OpenSCAD can follow are handed on to it.
void read_openscad_arguments(const Arguments& arguments, Options& options) {
  arguments.for_each([&](const std::string& option, const std::string& value) {
    if (option == "D" || option == "p" || option == "P" || option == "m") {
      options.openscad_arguments.insert(options.openscad_arguments.end(), {"-" + option, value});
    } else if (option == "check-parameters" || option == "check-parameter-ranges") {
      options.openscad_arguments.push_back("--" + option + "=" + value);
    } else if (option == "hardwarnings") {
      options.openscad_arguments.push_back("--hardwarnings");
    }
  });
}

void warn_of_what_is_ignored(const Arguments& arguments, Options& options) {
  constexpr const char* kNeverUsed[] = {"csglimit", "debug"};
  constexpr const char* kForScad[] = {
      "D", "p", "P", "m", "hardwarnings", "check-parameters", "check-parameter-ranges"};
  const auto given = [&arguments](std::span<const char* const> names) {
    std::string list;
    for (const char* name : names) {
      if (!arguments.has(name)) continue;
      list += (list.empty() ? "" : ", ") + std::string(name[1] == '\0' ? "-" : "--") + name;
    }
    return list;
  };
  if (const std::string list = given(kNeverUsed); !list.empty()) {
    options.warnings.push_back("without effect in this version: " + list);
  }
  if (options.outputs.empty()) {
    constexpr const char* kForPictures[] = {"d", "animate", "export-format"};
    if (const std::string list = given(kForPictures); !list.empty()) {
      options.warnings.push_back("without effect in a window, which needs no -o: " + list);
    }
  }
  if (arguments.has("preview")) {
    if (const std::string& how = arguments.text("preview"); !how.empty()) {
      options.warnings.push_back("--preview=" + how + " is drawn as --preview");
    }
    if (arguments.has("render")) {
      options.warnings.push_back("--render has no effect with --preview, as in OpenSCAD");
    }
  }
  if (options.render.technique == Technique::kTiles) {
    constexpr const char* kForCells[] = {"leaf-primitives", "threshold"};
    if (const std::string list = given(kForCells); !list.empty()) {
      options.warnings.push_back("without effect on --technique=tiles: " + list);
    }
  }
  if (arguments.has("autocenter") && arguments.has("camera") && !arguments.has("viewall")) {
    options.warnings.push_back("--autocenter has no effect without --viewall, as in OpenSCAD");
  }
  const bool is_csg = options.input == "-" || lower_case(options.input).ends_with(".csg");
  if (const std::string list = given(kForScad); !list.empty() && is_csg) {
    options.warnings.push_back("without effect on a .csg: " + list);
  }
}

/// The action of the options that need no design.
std::optional<Action> action_without_file(const Arguments& arguments) {
  if (arguments.has("help")) return Action::kHelp;
  if (arguments.has("version")) return Action::kVersion;
  if (arguments.has("info") && !arguments.has("file")) return Action::kInfo;
  return std::nullopt;
}

}  // namespace

Options parse_options(const std::vector<std::string>& words) {
  const Arguments arguments(words);
  Options options;
  if (const std::optional<Action> action = action_without_file(arguments)) {
    options.action = *action;
    return options;
  }
  const std::vector<std::string> files = arguments.texts("file");
  if (files.empty()) {
    fail("no file to draw",
         "give a .csg or .scad file, or - for a .csg from standard input; an option before it may "
         "have taken its name as a value");
  }
  if (files.size() > 1) fail("more than one file to draw: " + files[1], "give one");
  options.input = files[0];
  options.quiet = arguments.has("quiet");
  options.info = arguments.has("info");
  options.import.skip_unsupported = arguments.has("skip-unsupported");
  options.has_image_size = arguments.has("imgsize");
  options.import.rendered = arguments.has("render") && !arguments.has("preview");
  read_image_size(arguments, options.camera);
  read_camera(arguments, options.camera);
  read_facets(arguments, options.import);
  read_render(arguments, options.render);
  read_view(arguments, options);
  read_outputs(arguments, options);
  if (options.outputs.empty()) options.action = Action::kOpenWindow;
  read_openscad_arguments(arguments, options);
  warn_of_what_is_ignored(arguments, options);
  return options;
}

std::string help_text() {
  po::options_description all(
      "Usage: scadray [options] FILE              (a window that follows every save)\n"
      "       scadray -o OUT [options] FILE\n"
      "       scadray validate [options] FILE    (scadray validate --help)\n"
      "Ray traces a design: FILE is a .csg, a .scad (exported by OpenSCAD), or - for a\n"
      ".csg from standard input. `validate` compares it with exact arithmetic instead",
      kHelpColumns);
  all.add(openscad_table()).add(own_table());
  std::ostringstream text;
  text << all;
  return text.str();
}

}  // namespace frontend
