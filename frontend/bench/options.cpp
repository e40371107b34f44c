#include "options.hpp"

#include <algorithm>
#include <sstream>

#include "command/arguments.hpp"
#include "command/option_words.hpp"

namespace bench {
namespace {

using frontend::Arguments;

constexpr size_t kMostRuns = 1'000'000;
constexpr double kLongest_s = 1e6;

boost::program_options::options_description option_table() {
  constexpr unsigned kColumns = 100;
  return frontend::table_of("Options", option_rows(), kColumns);
}

std::vector<std::string> read_inputs(const Arguments& arguments) {
  std::vector<std::string> files = arguments.texts("file");
  if (files.empty()) frontend::fail("no file to measure", "give .csg or .scad files, or -");
  if (std::count(files.begin(), files.end(), "-") > 1) {
    frontend::fail("standard input is given twice", "give - once");
  }
  return files;
}

/// Returns the rule of the command line, or else scadray's own rule and the paper's.
std::vector<Rule> read_rules(const Arguments& arguments, const frontend::RenderSettings& given) {
  if (arguments.has("leaf-primitives") || arguments.has("threshold")) {
    return {{given.leaf_primitives, given.threshold_px}};
  }
  return {Rule{}, kPaperRule};
}

using frontend::OptionRow;
using frontend::Takes;

constexpr OptionRow kOptions[] = {
    {"imgsize", Takes::kText, "W,H", "size of the pictures in pixels; default 640,480"},
    {"camera", Takes::kText, "NUMBERS",
     "where the camera begins to turn, as for a picture; default: --viewall --autocenter"},
    {"viewall", Takes::kNothing, "", "take the distance at which the whole design is seen"},
    {"autocenter", Takes::kNothing, "", "with --viewall: look at the design's centre"},
    {"projection", Takes::kText, "P", "(o)rtho or (p)erspective, the default",
     frontend::kOneOf<frontend::kProjections>},
    {"renderer", Takes::kText, "R",
     "what is measured: cpu, gl, or auto, the default: the CPU, and OpenGL, on a GPU or in "
     "software, where it can be had",
     frontend::kOneOf<frontend::kRenderers>},
    {"leaf-primitives", Takes::kText, "K",
     "a cell is a leaf once at most K primitives' surfaces cross it; default: both 8 without a "
     "threshold, and the paper's rule, 2 and 1 pixel"},
    {"threshold", Takes::kText, "PX", "cells that project below PX pixels are not subdivided"},
    {"repeat", Takes::kText, "N", "measure everything at least N times; default 5"},
    {"time", Takes::kText, "SECONDS", "and until it took so long in all; default 1"},
    {"json", Takes::kNothing, "", "JSON instead of tables"},
    frontend::kThreadsOption,
    frontend::kTimeoutOption,
    frontend::kSkipOption,
    frontend::kEvaluatorOption,
    frontend::kLanguageOption,
    frontend::kVariableOption,
    frontend::kParameterFileOption,
    frontend::kParameterSetOption,
    {"quiet,q", Takes::kNothing, "", "no warnings: the times and errors only"},
    frontend::kVersionOption,
    frontend::kHelpOption,
};

}  // namespace

Options parse_options(const std::vector<std::string>& words) {
  const Arguments arguments(option_table(), words, "scadray bench");
  Options options;
  options.request = arguments.request();
  if (options.request != frontend::ProgramRequest::kWork) return options;
  options.inputs = read_inputs(arguments);
  options.camera.width_px = 640;  // the paper's size (§4.1)
  options.camera.height_px = 480;
  frontend::read_image_size(arguments, options.camera);
  const std::string warning = frontend::read_camera(arguments, options.camera);
  if (!warning.empty()) frontend::fail(warning, {});
  frontend::read_reading_options(arguments, options);
  frontend::RenderSettings render;
  frontend::read_cells_and_threads(arguments, render);
  Settings& settings = options.settings;
  settings.rules = read_rules(arguments, render);
  settings.renderer = frontend::read_renderer(arguments);
  settings.threads = render.threads;
  Repetitions& repetitions = settings.repetitions;
  repetitions.least = arguments.number<size_t>("repeat", 1, kMostRuns, repetitions.least);
  repetitions.most = kMostRuns;
  repetitions.long_enough_ms = 1000 * arguments.number("time", 0.0, kLongest_s, 1.0);
  options.json = arguments.has("json");
  options.quiet = arguments.has("quiet");
  return options;
}

std::string help_text() {
  std::ostringstream text;
  text << "Usage: scadray bench [options] FILE...\n"
          "Measures how long the designs take to draw: each renderer's first picture, and those "
          "of a\n"
          "turning camera; and what the paper measures: S subdivide, T_S traverse and pass the\n"
          "parameters to OpenGL, T_R traverse and render, S_R render while subdividing. FILE is a "
          ".csg,\n"
          "a .scad, a mesh or a drawing, or - for standard input. The pictures are\n"
          "compared first: exit status 1 where they differ, or anything fails.\n"
       << option_table();
  return text.str();
}

std::span<const OptionRow> option_rows() { return kOptions; }

}  // namespace bench
