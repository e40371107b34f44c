#include "frontend/options.hpp"

#include <algorithm>
#include <limits>
#include <optional>
#include <sstream>
#include <string_view>

#include "base/lower_case.hpp"
#include "command/arguments.hpp"
#include "command/export_option.hpp"
#include "command/option_row.hpp"
#include "command/option_words.hpp"
#include "frontend/error.hpp"
#include "frontend/render_settings.hpp"

namespace frontend {
namespace {

namespace po = boost::program_options;

constexpr unsigned kHelpColumns = 80;

po::options_description openscad_table() {
  return table_of("OpenSCAD's options", openscad_options(), kHelpColumns);
}

po::options_description own_table() {
  return table_of("scadray's own options", own_options(), kHelpColumns);
}

/// An abbreviation that is clear among OpenSCAD's options stays clear although ours are there, too:
/// `--rend` is `--render`. Gives {option, value}, or nothing to leave the word to the library.
std::pair<std::string, std::string> openscad_prefix(const po::options_description& openscad,
                                                    const po::options_description& own,
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

Arguments arguments_of(const std::vector<std::string>& words) {
  const po::options_description openscad = openscad_table();
  const po::options_description own = own_table();
  po::options_description all;
  all.add(openscad).add(own);
  return Arguments(all, words, "scadray",
                   [&](const std::string& word) { return openscad_prefix(openscad, own, word); });
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
    bad_value("facets", value, "give a whole number from 0 to 4294967295, all or none");
  }
}

void read_tolerance(const Arguments& arguments, Options& options) {
  options.model_tolerance = arguments.number<double>(
      "tolerance", std::numeric_limits<double>::min(), std::numeric_limits<double>::max(), 0,
      "give a length above 0, in the design's units");
  const bool is_window = options.outputs.empty() && options.texts.empty() && options.handed.empty();
  if (arguments.has("tolerance") && options.models.empty() && !is_window) {
    options.warnings.push_back("--tolerance has no effect without -o of a solid or plane figure");
  }
}

void read_studio(const Arguments& arguments, Options& options) {
  csgcore::StudioSettings& studio = options.render.studio;
  const bool is_studio = options.render.shading == Shading::kStudio;
  const bool is_phong = options.render.shading == Shading::kPhong;
  const auto read = [&](const char* option, double& strength) {
    strength = arguments.number<double>(option, 0, 1, strength);
    const bool is_shadows = &strength == &studio.shadows;
    if (arguments.has(option) && !is_studio && !(is_shadows && is_phong)) {
      options.warnings.push_back("--" + std::string(option) +
                                 " has no effect without --shading=studio" +
                                 (is_shadows ? " or phong" : ""));
    }
  };
  read("shadows", studio.shadows);
  if (is_phong && arguments.has("shadows")) options.render.phong_shadows = studio.shadows;
  read("occlusion", studio.occlusion);
  read("edges", studio.edges);
  if (is_studio && !arguments.has("samples")) options.render.samples = kStudioSamples;
}

void read_render(const Arguments& arguments, RenderSettings& render) {
  read_color_scheme(arguments, render);
  render.shading = choice(arguments, "shading", kShadings, render.shading);
  render.translucency = choice(arguments, "translucency", kTranslucencies, render.translucency);
  render.show = choice(arguments, "show", kShows, render.show);
  render.renderer = read_renderer(arguments);
  read_cells_and_threads(arguments, render);
  static_assert(kMaxSamples == 64, "said below");
  render.samples =
      arguments.number<uint32_t>("samples", 1, kMaxSamples, 1, "give a whole number from 1 to 64");
  render.technique = read_technique(arguments, render);
}

void read_picture_kind(const Arguments& arguments, Options& options) {
  if (arguments.has("preview")) {
    if (arguments.text("preview") != "throwntogether") return;
    options.import.picture = PictureKind::kThrownTogether;
    const auto byte = [](float channel) { return static_cast<uint8_t>(255 * channel); };
    options.render.from_within =
        Rgb{byte(kSeenFromWithin.r), byte(kSeenFromWithin.g), byte(kSeenFromWithin.b)};
  } else if (arguments.has("render")) {
    options.import.picture = PictureKind::kRendered;
  }
}

}  // namespace

namespace {

/// Returns a path's suffix in lower case, without the dot; empty if it has none.
std::string suffix_of(const std::string& path) {
  const std::size_t dot = path.rfind('.');
  const std::size_t slash = path.rfind('/');
  const bool has_suffix = dot != std::string::npos && (slash == std::string::npos || dot > slash);
  return has_suffix ? lower_case(path.substr(dot + 1)) : std::string();
}

}  // namespace

PictureFormat picture_format(const std::string& path) {
  const PictureFormat* format = find_word(kFormats, suffix_of(path));
  if (!format) {
    throw Error(
        path, {}, "is no picture",
        "end it in .png, .exr, .gif or .webp, or in what a design is exported to (.stl, .off, "
        ".obj, .3mf, "
        ".amf, .svg, .dxf, .pdf, .csg, .echo, .param; by openscad .wrl, .nef3, .ast, .term, .pov), "
        "or give --export-format");
  }
  return *format;
}

ModelFormat model_format(const std::string& path) {
  const ModelFormat* format = find_word(kModelFormats, suffix_of(path));
  if (!format) {
    throw Error(path, {}, "is no format of solids or plane figures",
                "end it in .stl, .off, .obj, .3mf or .amf, or of a plane figure in .svg, .dxf or "
                ".pdf");
  }
  return *format;
}

namespace {

bool is_handed(const std::string& format) {
  return std::find(std::begin(kHandedFormats), std::end(kHandedFormats), format) !=
         std::end(kHandedFormats);
}

/// Adds an output in the given format, or else in that of its suffix.
void add_output(const std::string& path, const std::string& given, Options& options) {
  const std::string word = given.empty() ? suffix_of(path) : given;
  if (const TextKind* kind = find_word(kTextKinds, word)) {
    options.texts.push_back({path, *kind});
  } else if (const ModelFormat* model = find_word(kModelFormats, word)) {
    options.models.push_back({path, *model});
  } else if (is_handed(word)) {
    options.handed.push_back({path, word});
  } else {
    const PictureFormat* format = find_word(kFormats, word);
    options.outputs.push_back({path, format ? *format : picture_format(path)});
  }
}

/// Throws Error if so many outputs are more than kMaxPictures over all frames that are drawn.
void check_count(const std::string& what, std::size_t outputs, const Options& options) {
  const uint32_t frames = options.frames > 0 ? options.end_frame - options.first_frame : 0;
  if (outputs * std::max(frames, 1u) <= kMaxPictures) return;
  const std::string most = std::to_string(kMaxPictures);
  fail("more than " + most + " " + what + ": " + std::to_string(outputs) + " of -o" +
           (frames > 0 ? ", for each of " + std::to_string(frames) + " frames" : ""),
       frames > 0 && outputs <= kMaxPictures
           ? "give --animate at most " + std::to_string(kMaxPictures / outputs) +
                 ", --animate_sharding, or fewer -o"
           : "give -o at most " + most + " times");
}

/// Reads --animate_sharding: as in OpenSCAD, shard I of N has the frames from (I - 1) F / N to
/// I F / N, both rounded down.
void read_shard(const Arguments& arguments, Options& options) {
  options.end_frame = std::max(options.frames, 1u);
  if (!arguments.has("animate_sharding")) return;
  const std::string& value = arguments.text("animate_sharding");
  const std::size_t slash = value.find('/');
  const auto index = parse_number<uint32_t>(value.substr(0, slash));
  const auto count =
      slash == std::string::npos ? std::nullopt : parse_number<uint32_t>(value.substr(slash + 1));
  if (!index || !count || *index < 1 || *index > *count) {
    bad_value("animate_sharding", value, "give I/N, two whole numbers with 1 <= I <= N");
  }
  if (options.frames == 0) return;
  const auto begin_of = [&](uint64_t shard) {
    return static_cast<uint32_t>(shard * options.frames / *count);
  };
  options.first_frame = begin_of(*index - 1);
  options.end_frame = begin_of(*index);
}

/// Reads --summary and --summary-file.
void read_summary(const Arguments& arguments, Options& options) {
  for (const std::string& name : arguments.texts("summary")) {
    const bool is_all = name == kWholeSummary;
    if (!is_all && !find_word(kSummaryParts, name)) {
      bad_value("summary", name,
                "give " + std::string(kWholeSummary) + ", " + listed(kSummaryParts));
    }
    for (const auto& [word, part] : kSummaryParts) {
      if (is_all || name == word) options.summary.*part = true;
    }
  }
  options.summary_path = arguments.text_or_empty("summary-file");
}

void read_outputs(const Arguments& arguments, Options& options) {
  const std::string given = lower_case(arguments.text_or_empty("export-format"));
  if (!given.empty() && !find_word(kFormats, given) && !find_word(kTextKinds, given) &&
      !find_word(kModelFormats, given) && !is_handed(given)) {
    std::string handed;
    for (const char* format : kHandedFormats)
      handed += (handed.empty() ? "" : ", ") + std::string(format);
    bad_value("export-format", arguments.text("export-format"),
              "give " + listed(kFormats) + "; " + listed(kTextKinds) + "; " +
                  listed(kModelFormats) + "; or, by openscad, " + handed);
  }
  arguments.for_each([&](const std::string& option, const std::string& value) {
    if (option == "o" || option == "s" || option == "x") add_output(value, given, options);
  });
  if (arguments.has("stats")) options.stats_path = arguments.text("stats");
  if (arguments.has("d")) options.rule_path = arguments.text("d");
  const auto to_stdout_of = [](const auto& outputs) {
    return std::count_if(outputs.begin(), outputs.end(),
                         [](const auto& output) { return output.path == "-"; });
  };
  const auto to_stdout = to_stdout_of(options.outputs) + to_stdout_of(options.texts) +
                         to_stdout_of(options.models) + to_stdout_of(options.handed);
  if (to_stdout + (options.stats_path == "-") + (options.rule_path == "-") +
          (options.summary_path == "-") + options.prints_echoes >
      1) {
    fail("more than one output goes to standard output", "give all but one a file");
  }
  constexpr uint32_t kMostFrames = 99999;  // a frame's number has five digits
  options.frames = arguments.number<uint32_t>("animate", 0, kMostFrames, 0);
  read_shard(arguments, options);
  options.turns = arguments.has("turn");
  options.fps = arguments.number<double>("fps", kLeastFps, kMostFps, kDefaultFps,
                                         "give frames a second, 0.1 to 50");
  const bool has_animation = std::ranges::any_of(
      options.outputs, [](const Output& output) { return is_animated(output.format); });
  if (arguments.has("fps") && !has_animation) {
    options.warnings.push_back("--fps has no effect without -o of a .gif or .webp");
  }
  if (options.turns && options.frames == 0) {
    fail("--turn without --animate", "give the number of pictures, --animate=36 for example");
  }
  const auto animations = std::ranges::count_if(options.outputs, [](const Output& output) {
    return output.path == "-" && is_animated(output.format);
  });
  if (options.frames > 0 && to_stdout > animations) {
    fail("the files of --animate do not go to standard output", "give -o a file's name");
  }
  check_count("pictures", options.outputs.size(), options);
  check_count("models", options.models.size(), options);
  check_count("texts", options.texts.size() + options.handed.size(), options);
}

/// Throws Error if there are several designs, unless each can have a window of its own.
void check_inputs(const Options& options) {
  if (options.further_inputs.empty()) return;
  if (options.action != Action::kOpenWindow) {
    fail("more than one file to draw: " + options.further_inputs[0],
         "give one; or leave out -o, for windows");
  }
  if (!options.stats_path.empty()) {
    fail("--stats is for one file, and there is another: " + options.further_inputs[0], "give one");
  }
}

/// OpenSCAD draws a wireframe of a final solid's mesh, and in no window. Returns whether scadray
/// draws the edges of the mesh that are seen for it, and warns that these are not all.
bool has_edges_for_wireframe(Options& options) {
  const char* const fault = options.outputs.empty() ? "has no effect in a window"
                            : options.import.picture != PictureKind::kRendered
                                ? "has no effect without --render, as in OpenSCAD"
                                : nullptr;
  options.warnings.push_back(std::string("--view=wireframe ") +
                             (fault ? fault : "draws the solid with the edges that are seen"));
  return !fault;
}

/// OpenSCAD says that it ignores a view it does not know, and goes on.
void read_view(const Arguments& arguments, Options& options) {
  if (!arguments.has("view")) return;
  for (const std::string_view name : split_at_commas(arguments.text("view"))) {
    bool Overlays::*const* overlay = find_word(kViews, name);
    if (!overlay) {
      options.warnings.push_back("--view=" + std::string(name) +
                                 " is not known and ignored (give axes, crosshairs, edges, "
                                 "grid, scales or wireframe)");
    } else if (name != "wireframe") {
      options.overlays.*(*overlay) = true;
    } else if (has_edges_for_wireframe(options)) {
      options.overlays.*(*overlay) = true;
      options.import.facets = Facets::kAll;
    }
  }
  options.import.keeps_meshes = options.overlays.edges;
  if (options.overlays.scales && !options.overlays.axes) {
    options.warnings.push_back("--view=scales has no effect without axes, as in OpenSCAD");
  }
}

/// OpenSCAD's pictures show crosshairs with --render alone, its window always does.
void leave_out_crosshairs(Options& options) {
  const bool is_shown = options.outputs.empty() || options.import.picture == PictureKind::kRendered;
  if (is_shown || !options.overlays.crosshairs) return;
  options.overlays.crosshairs = false;
  options.warnings.push_back("--view=crosshairs has no effect without --render, as in OpenSCAD");
}

void warn_of_what_is_ignored(const Arguments& arguments, Options& options) {
  constexpr const char* kNeverUsed[] = {"csglimit", "debug", "trust-python", "python-module"};
  constexpr const char* kForScad[] = {
      "D", "p", "P", "m", "check-parameters", "check-parameter-ranges"};
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
  if (options.action == Action::kOpenWindow) {
    constexpr const char* kForPictures[] = {
        "d", "animate", "animate_sharding", "export-format", "summary", "summary-file", "messages"};
    if (const std::string list = given(kForPictures); !list.empty()) {
      options.warnings.push_back("without effect in a window, which needs no -o: " + list);
    }
  }
  if (!options.stats_path.empty() && options.outputs.empty() && !options.models.empty()) {
    options.warnings.push_back("--stats has no effect without a picture");
  }
  if (arguments.has("preview")) {
    const std::string& how = arguments.text("preview");
    if (!how.empty() && how != "throwntogether") {
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
  const bool is_csg = lower_case(options.input).ends_with(".csg");
  if (const std::string list = given(kForScad); !list.empty() && is_csg) {
    options.warnings.push_back("without effect on a .csg: " + list);
  }
}

/// Tells of a --backend that OpenSCAD has not, as it does; there is no other use of it.
void read_backend(const Arguments& arguments, Options& options) {
  if (!arguments.has("backend")) return;
  const std::string& value = arguments.text("backend");
  if (!find_word(kBackends, lower_case(value))) {
    options.warnings.push_back("--backend=" + value + " is not known, and has no effect (give " +
                               listed(kBackends) + ")");
  }
}

/// The action of the options that need no design.
std::optional<Action> action_without_file(const Arguments& arguments) {
  if (arguments.has("help")) return Action::kHelp;
  if (arguments.has("help-export")) return Action::kHelpExport;
  if (arguments.has("version")) return Action::kVersion;
  if (arguments.has("info") && !arguments.has("file")) return Action::kInfo;
  return std::nullopt;
}

}  // namespace

Options parse_options(const std::vector<std::string>& words) {
  const Arguments arguments = arguments_of(words);
  Options options;
  if (const std::optional<Action> action = action_without_file(arguments)) {
    options.action = *action;
    return options;
  }
  const std::vector<std::string> files = arguments.texts("file");
  if (files.empty()) {
    fail(
        "no file to draw",
        "give a .csg or .scad file, a mesh or a drawing, or - for standard input; an option before "
        "it may have taken its name as a value");
  }
  options.input = files[0];
  options.further_inputs.assign(files.begin() + 1, files.end());
  options.editor = arguments.text_or_empty("editor");
  options.pans_far = choice(arguments, "pan", kPans, options.pans_far);
  options.quiet = arguments.has("quiet");
  options.prints_echoes = arguments.has("echo");
  options.info = arguments.has("info");
  options.has_image_size = arguments.has("imgsize");
  options.given = {arguments.has("colorscheme"), arguments.has("view"),
                   arguments.has("projection"),  arguments.has("shading"),
                   arguments.has("samples"),     arguments.has("translucency")};
  read_picture_kind(arguments, options);
  read_image_size(arguments, options.camera);
  const std::string camera_warning = read_camera(arguments, options.camera);
  if (!camera_warning.empty()) options.warnings.push_back(camera_warning);
  read_facets(arguments, options.import);
  read_render(arguments, options.render);
  read_summary(arguments, options);
  read_outputs(arguments, options);
  read_backend(arguments, options);
  for (const std::string& setting : arguments.texts("O")) {
    const std::string fault = read_export_setting(setting, options.export_settings);
    if (!fault.empty()) options.warnings.push_back(fault);
  }
  read_tolerance(arguments, options);
  read_view(arguments, options);
  if (options.outputs.empty() && options.texts.empty() && options.models.empty() &&
      options.handed.empty()) {
    options.action = Action::kOpenWindow;
    if (!options.given.shading) options.render.shading = Shading::kStudio;
    if (!options.given.translucency) options.render.translucency = Translucency::kDepth;
  }
  read_studio(arguments, options);
  check_inputs(options);
  leave_out_crosshairs(options);
  read_reading_options(arguments, options);
  options.handed_arguments =
      handed_arguments_of(arguments, options.models.empty() && options.outputs.empty());
  options.resets_window = arguments.has("reset-window-settings");
  choice(arguments, "messages", kMessageFormats, MessageFormat::kText);  // MessageWriter reads it
  options.has_hard_warnings = arguments.has("hardwarnings");
  warn_of_what_is_ignored(arguments, options);
  return options;
}

std::string help_text() {
  po::options_description all(
      "Usage: scadray [options] FILE...           (a window that follows every save)\n"
      "       scadray -o OUT [options] FILE\n"
      "       scadray bench [options] FILE...    (scadray bench --help)\n"
      "       scadray validate [options] FILE    (scadray validate --help)\n"
      "       scadray check [options] FILE...    (scadray check --help)\n"
      "       scadray serve [options]            (scadray serve --help)\n"
      "Ray traces a design: FILE is a .scad, a .csg that OpenSCAD exported, a mesh or a\n"
      "drawing that import() reads (.stl, .off, .amf, .3mf, .nef3, .svg, .dxf), or - for a\n"
      ".scad or .csg from standard input. `bench` measures how long that takes, `validate`\n"
      "compares it with exact arithmetic, `check` compares evaluations with openscad's,\n"
      "`serve` shows designs in editors and browsers",
      kHelpColumns);
  all.add(openscad_table()).add(own_table());
  std::ostringstream text;
  text << all;
  return text.str();
}

}  // namespace frontend
