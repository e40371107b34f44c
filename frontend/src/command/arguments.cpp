#include "command/arguments.hpp"

#include <algorithm>
#include <cstdlib>
#include <iterator>

#include "frontend/error.hpp"

namespace frontend {
namespace {

namespace po = boost::program_options;

constexpr unsigned kMaxThreads = 1024;

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(' ');
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(' ') + 1 - first);
}

uint32_t picture_side(std::string_view text, const std::string& value) {
  const std::optional<uint32_t> side = parse_number<uint32_t>(text);
  if (!side || *side == 0 || *side > kMaxPictureSide_px) {
    bad_value("imgsize", value,
              "give width,height in pixels, each from 1 to " + std::to_string(kMaxPictureSide_px));
  }
  return *side;
}

}  // namespace

void fail(const std::string& what, const std::string& todo) { throw Error("", {}, what, todo); }

void bad_value(const std::string& option, const std::string& value, const std::string& todo) {
  fail("--" + option + "=" + value + " is not understood", todo);
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

Arguments::Arguments(const po::options_description& options, const std::vector<std::string>& words,
                     const std::string& program, const WordReader& reader) {
  po::options_description files;
  files.add_options()("file", po::value<std::vector<std::string>>());
  table_.add(options).add(files);
  po::positional_options_description positions;
  positions.add("file", -1);
  try {
    po::command_line_parser parser(words);
    parser.options(table_).positional(positions);
    if (reader) parser.extra_parser(reader);
    parsed_ = parser.run();
    po::store(parsed_, values_);
    po::notify(values_);
  } catch (const po::error& error) {
    fail(error.what(), "see " + program + " --help");
  }
}

void read_image_size(const Arguments& arguments, CameraOptions& camera) {
  if (!arguments.has("imgsize")) return;
  const std::string& value = arguments.text("imgsize");
  const std::vector<std::string_view> sides = split_at_commas(value);
  if (sides.size() != 2) bad_value("imgsize", value, "give two numbers: width,height");
  camera.width_px = picture_side(sides[0], value);
  camera.height_px = picture_side(sides[1], value);
}

std::string read_camera(const Arguments& arguments, CameraOptions& camera) {
  std::string warning;
  camera.view_all = arguments.has("viewall");
  camera.auto_center = arguments.has("autocenter");
  if (arguments.has("camera")) {
    const std::string& value = arguments.text("camera");
    std::vector<double> numbers;
    for (const std::string_view part : split_at_commas(value)) {
      const std::optional<double> number = parse_any_number<double>(part);
      if (!number) {
        warning = "--camera=" + value +
                  " is not understood, and the standard camera is taken, as "
                  "in OpenSCAD (give 6 or 7 numbers, with commas between)";
        break;
      }
      numbers.push_back(*number);
    }
    camera.camera = warning.empty() ? camera_from_numbers(numbers) : Camera{};
  }
  camera.projection = choice(arguments, "projection", kProjections, camera.projection);
  return warning;
}

RendererKind read_renderer(const Arguments& arguments) {
  return choice(arguments, "renderer", kRenderers, RendererKind::kAuto);
}

language::LanguageVersion read_language(const Arguments& arguments) {
  const char* const known = std::getenv("SCADRAY_LANGUAGE");
  const language::LanguageVersion* const version = find_word(kLanguages, known ? known : "");
  if (!version && known && *known != '\0')
    fail(std::string("SCADRAY_LANGUAGE=") + known + " is not understood",
         "set it to 2021.01 or 2026");
  return choice(arguments, "language", kLanguages, version ? *version : kDefaultLanguage);
}

void read_reading_options(const Arguments& arguments, ReadingOptions& options) {
  options.evaluator = choice(arguments, "evaluator", kEvaluators, kDefaultEvaluator);
  options.import.language = read_language(arguments);
  std::vector<std::string>& handed = options.openscad_arguments;
  arguments.for_each([&](const std::string& option, const std::string& value) {
    if (option == "D" || option == "p" || option == "P" || option == "m") {
      handed.insert(handed.end(), {"-" + option, value});
    } else if (option == "check-parameters" || option == "check-parameter-ranges" ||
               option == "enable" || option == "trace-depth" ||
               option == "trace-usermodule-parameters") {
      handed.push_back("--" + option + "=" + value);
    } else if (option == "hardwarnings") {
      handed.push_back("--hardwarnings");
    }
  });
}

std::vector<std::string> handed_arguments_of(const Arguments& arguments, bool has_summary_file) {
  constexpr std::string_view kOwnAffair[] = {
      "o", "s", "x", "export-format", "d", "animate", "animate_sharding"};
  const auto is_among = [](const std::string& name, const auto& names) {
    return std::find(std::begin(names), std::end(names), name) != std::end(names);
  };
  std::vector<std::string> result;
  arguments.for_each([&](const std::string& option, const std::string& value) {
    if (is_among(option, kOwnAffair) || (option == "summary-file" && !has_summary_file)) return;
    const auto rows = openscad_options();
    const auto row = std::find_if(rows.begin(), rows.end(), [&](const OptionRow& candidate) {
      return std::string_view(candidate.names)
                 .substr(0, std::string_view(candidate.names).find(',')) == option;
    });
    if (row == rows.end()) return;
    if (option.size() == 1 && option != "O") {
      result.insert(result.end(), {"-" + option, value});
    } else if (!value.empty()) {
      result.push_back("--" + option + "=" + value);
    } else if (row->takes == Takes::kNothing || row->takes == Takes::kOptionalText) {
      result.push_back("--" + option);
    }
  });
  return result;
}

void read_cells_and_threads(const Arguments& arguments, RenderSettings& render) {
  render.leaf_primitives =
      arguments.number<uint32_t>("leaf-primitives", 1, UINT32_MAX, render.leaf_primitives,
                                 "give a whole number from 1 to 4294967295");
  render.threshold_px = arguments.number<double>("threshold", 0, HUGE_VAL, render.threshold_px,
                                                 "give a number of pixels from 0");
  render.threads = arguments.number<unsigned>("threads", 1, kMaxThreads, render.threads,
                                              "give a whole number from 1 to 1024");
}

}  // namespace frontend
