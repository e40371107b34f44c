#include "follow/evaluated_design.hpp"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <string_view>
#include <utility>

#include "base/lower_case.hpp"
#include "follow/openscad_messages.hpp"
#include "fonts/text_meter.hpp"
#include "frontend/error.hpp"
#include "frontend/stop.hpp"
#include "language/stopped.hpp"
#include "solids/import_files.hpp"

namespace frontend {
namespace {

/// `suffix` is in lower case.
bool has_suffix(const std::string& path, std::string_view suffix) {
  return path.size() >= suffix.size() &&
         lower_case(path.substr(path.size() - suffix.size())) == suffix;
}

/// Sets a flag by OpenSCAD's words for true and false, in any case; any other word leaves it.
void read_flag(std::string_view value, bool& flag) {
  const std::string lower = lower_case(std::string(value));
  if (lower == "true" || lower == "on" || lower == "1") flag = true;
  if (lower == "false" || lower == "off" || lower == "0") flag = false;
}

/// Reads an option that has its value in the same word. Returns whether it is one.
bool read_word(std::string_view word, language::EvaluationOptions& options) {
  constexpr std::string_view kParameters = "--check-parameters=";
  constexpr std::string_view kRanges = "--check-parameter-ranges=";
  constexpr std::string_view kEnable = "--enable=";
  constexpr std::string_view kTraceDepth = "--trace-depth=";
  constexpr std::string_view kTraceParameters = "--trace-usermodule-parameters=";
  if (word == "--hardwarnings") {
    options.hard_warnings = true;
  } else if (word.starts_with(kParameters)) {
    read_flag(word.substr(kParameters.size()), options.check_parameters);
  } else if (word.starts_with(kRanges)) {
    read_flag(word.substr(kRanges.size()), options.check_ranges);
  } else if (word.starts_with(kTraceDepth)) {
    const std::string_view digits = word.substr(kTraceDepth.size());
    std::from_chars(digits.data(), digits.data() + digits.size(), options.traces.most_lines);
  } else if (word.starts_with(kTraceParameters)) {
    read_flag(word.substr(kTraceParameters.size()), options.traces.has_parameters);
  } else if (word.starts_with(kEnable)) {
    const std::string_view feature = word.substr(kEnable.size());
    if (feature == "lazy-union" || feature == "all") options.lazy_union = true;
  } else {
    return false;
  }
  return true;
}

}  // namespace

SourcePlace PlacesOfLines::of(const language::SaidLine& line) {
  if (line.place.file == language::kNoFile) return {};
  const language::SourceFile& file = line.files[line.place.file];
  const auto [path, is_new] = paths_.try_emplace(line.place.file);
  if (is_new) path->second = file.canonical_path();
  return source_place(path->second, line.files.line(line.place), file.text, line.place.offset);
}

DesignKind kind_of(const std::string& path) {
  if (has_suffix(path, ".scad")) return DesignKind::kScad;
  if (has_suffix(path, ".csg")) return DesignKind::kCsg;
  return is_importable(path) ? DesignKind::kImported : DesignKind::kEither;
}

std::string import_of(const std::string& name) {
  std::string text = "import(\"";
  for (const char c : name) {
    if (c == '"' || c == '\\') text += '\\';
    text += c == '\n' ? "\\n" : std::string(1, c);  // a raw one is no part of a string
  }
  return text + "\");\n";
}

std::optional<language::EvaluationOptions> evaluation_options(
    const std::vector<std::string>& openscad_arguments, const std::string& path) {
  language::EvaluationOptions options;
  options.text_meter = make_text_meter();
  for (std::size_t i = 0; i < openscad_arguments.size(); ++i) {
    const std::string& word = openscad_arguments[i];
    if (read_word(word, options)) continue;
    if (i + 1 == openscad_arguments.size()) return std::nullopt;
    const std::string& value = openscad_arguments[++i];
    if (word == "-D") {
      options.definitions.push_back(value);
    } else if (word == "-p") {
      options.parameter_file = value;
    } else if (word == "-P") {
      options.parameter_set = value;
    } else if (kind_of(path) != DesignKind::kImported) {
      return std::nullopt;
    }
  }
  return options;
}

std::string advice_of_language(const std::string& path, language::EvaluationOptions options,
                               language::Outcome outcome,
                               const std::optional<std::string_view>& text) {
  const bool has_failed =
      outcome != language::Outcome::kDone && outcome != language::Outcome::kUnreadable;
  const bool is_read_once = path == "-" && !text;
  if (!has_failed || is_read_once || options.language == language::LanguageVersion::k2021)
    return {};
  options.language = language::LanguageVersion::k2021;
  options.cache = nullptr;
  const language::Evaluation evaluation = language::evaluate(
      path, options, [](const language::SaidLine&) {}, text);
  if (evaluation.outcome != language::Outcome::kDone) return {};
  return "The design can be evaluated in the language of OpenSCAD 2021.01: --language=2021.01";
}

std::optional<std::string_view> view_of(const std::optional<FileText>& text) {
  return text ? std::optional(text->view()) : std::nullopt;
}

std::shared_ptr<const language::Evaluation> evaluate_design(const std::string& path,
                                                            const std::optional<FileText>& text,
                                                            const DesignFileOptions& options,
                                                            const std::stop_token& stop) {
  std::optional<language::EvaluationOptions> known =
      evaluation_options(options.openscad_arguments, path);
  if (!known) return nullptr;
  known->language = options.import.language;
  known->parameters = options.inputs.parameters;
  known->time = options.inputs.time.value_or(0);
  known->camera = options.camera;
  known->view = options.view;
  known->is_preview = options.import.picture != PictureKind::kRendered;
  known->stop = stop;
  known->cache = options.cache.get();
  known->overlay = options.overlay.get();
  OpenScadMessages messages(options.message, OpenScadMessages::AfterError::kHolds);
  language::Evaluation evaluation;
  try {
    PlacesOfLines places;
    evaluation = language::evaluate(
        path, *known,
        [&](const language::SaidLine& line) {
          messages.take({std::string(line.text), places.of(line)});
        },
        view_of(text));
    const std::string advice = advice_of_language(path, *known, evaluation.outcome, view_of(text));
    if (!advice.empty()) messages.take({advice, {}});
  } catch (const language::Stopped&) {
    throw Stopped{};
  }
  if (options.watch) {
    std::vector<std::string> paths = evaluation.files_read;
    paths.insert(paths.end(), evaluation.lookups.begin(), evaluation.lookups.end());
    options.watch(std::move(paths));
  }
  // A syntax error in a used file, or a parameter file that cannot be read, ends nothing.
  const bool lacks_files = options.needs_all_files && evaluation.has_unparsed_files;
  if (evaluation.outcome == language::Outcome::kDone && !lacks_files) messages.pass_errors();
  messages.finish();
  if (messages.first_error()) throw openscad_error(path, *messages.first_error());
  if (evaluation.outcome != language::Outcome::kDone) {
    throw Error(path, {}, "the design cannot be evaluated", "see what is said above");
  }
  return std::make_shared<const language::Evaluation>(std::move(evaluation));
}

std::vector<std::string> files_of(const language::Evaluation& evaluation, const std::string& path) {
  std::vector<std::string> files;
  for (std::size_t i = 1; i < evaluation.files_read.size(); ++i) {
    const std::string& file = evaluation.files_read[i];
    if (std::find(files.begin(), files.end(), file) == files.end()) files.push_back(file);
  }
  files.push_back(path);
  return files;
}

std::vector<std::string> fonts_of(const std::vector<std::string>& files) {
  std::vector<std::string> fonts;
  std::copy_if(files.begin(), files.end(), std::back_inserter(fonts), [](const std::string& file) {
    const std::string suffix = lower_case(std::filesystem::path(file).extension().string());
    return suffix == ".ttf" || suffix == ".otf";
  });
  return fonts;
}

DesignCamera camera_of(const language::Evaluation& evaluation) {
  const auto vector = [](const std::optional<std::array<double, 3>>& numbers) {
    return numbers ? std::optional(csgcore::Vec3((*numbers)[0], (*numbers)[1], (*numbers)[2]))
                   : std::nullopt;
  };
  return {vector(evaluation.camera.translation), vector(evaluation.camera.rotation_deg),
          evaluation.camera.distance};
}

}  // namespace frontend
