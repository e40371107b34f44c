#include "options.hpp"

#include <cstdlib>
#include <sstream>

#include "command/arguments.hpp"
#include "command/option_words.hpp"
#include "planted_error.hpp"

namespace validation {
namespace {

using frontend::Arguments;

// A sphere of 200 fragments has 20,002 facets, and alone takes CGAL a minute.
constexpr int kMostFragments = 200;
constexpr uint64_t kMostSamples = 1'000'000'000;
constexpr uint64_t kMostViews = 100;  // their pictures are held in memory
constexpr double kLongestLimit_s = 1e7;
constexpr unsigned kMostThreads = 1024;

boost::program_options::options_description option_table() {
  constexpr unsigned kColumns = 100;
  return frontend::table_of("Options", option_rows(), kColumns);
}

std::string only_file(const Arguments& arguments) {
  const std::vector<std::string> files = arguments.texts("file");
  if (files.empty()) {
    frontend::fail("no file to validate", "give a .csg or .scad file, or -");
  }
  if (files.size() > 1) {
    frontend::fail("more than one file to validate: " + files[1], "give one");
  }
  return files[0];
}

using frontend::OptionRow;
using frontend::Takes;

constexpr OptionRow kOptions[] = {
    {"fn", Takes::kText, "N", "fragments of the facets that CGAL is given, 3 to 200; default 8"},
    {"points", Takes::kText, "N", "random points of each kind; default 10000"},
    {"rays", Takes::kText, "N",
     "random rays of each kind, and for the volume ten times as many; default 10000"},
    {"views", Takes::kText, "N", "pictures of random views, 160 x 120 pixels; default 3"},
    {"seed", Takes::kText, "N", "of the random numbers; default 1"},
    {"time-limit", Takes::kText, "SECONDS",
     "a design that CGAL's polyhedra take longer for is compared with exact rays alone; default "
     "40"},
    {"renderer", Takes::kText, "R",
     "what is compared besides the CPU: cpu (nothing), gl, or auto, the default: OpenGL where "
     "there is a GPU",
     frontend::kOneOf<frontend::kRenderers>},
    {"report", Takes::kText, "FILE",
     "all that was found, with coordinates, as JSON; - is standard output", frontend::kAnyFile},
    frontend::kThreadsOption,
    frontend::kTimeoutOption,
    frontend::kSkipOption,
    frontend::kEvaluatorOption,
    frontend::kLanguageOption,
    frontend::kVariableOption,
    frontend::kParameterFileOption,
    frontend::kParameterSetOption,
    {"quiet,q", Takes::kNothing, "", "no table: errors, the report and the exit status only"},
    frontend::kVersionOption,
    frontend::kHelpOption,
};

}  // namespace

Options parse_options(const std::vector<std::string>& words) {
  const Arguments arguments(option_table(), words, "scadray validate");
  Options options;
  options.request = arguments.request();
  if (options.request != frontend::ProgramRequest::kWork) return options;
  options.input = only_file(arguments);
  options.report = arguments.text_or_empty("report");
  options.quiet = arguments.has("quiet");
  options.threads = arguments.number("threads", 1u, kMostThreads, options.threads);
  Settings& settings = options.settings;
  settings.fragments = arguments.number("fn", 3, kMostFragments, settings.fragments);
  settings.points = arguments.number<uint64_t>("points", 1, kMostSamples, settings.points);
  settings.rays = arguments.number<uint64_t>("rays", 1, kMostSamples, settings.rays);
  settings.views = arguments.number<uint64_t>("views", 0, kMostViews, settings.views);
  settings.seed = arguments.number<uint64_t>("seed", 0, UINT64_MAX, settings.seed);
  settings.time_limit_s =
      arguments.number("time-limit", 0.0, kLongestLimit_s, settings.time_limit_s);
  settings.renderer = frontend::read_renderer(arguments);
  if (const char* error = std::getenv(kPlantedErrorVariable)) settings.planted_error = error;
  frontend::read_reading_options(arguments, options);
  return options;
}

std::string help_text() {
  std::ostringstream text;
  text << "Usage: scadray validate [options] FILE\n"
          "Compares what scadray draws of a design with exact arithmetic by CGAL. FILE is a .csg, "
          "a\n"
          ".scad, a mesh or a drawing, or - for standard input. Exit status: 0 agrees, 2 "
          "disagrees,\n"
          "1 failed.\n"
       << option_table();
  return text.str();
}

std::span<const OptionRow> option_rows() { return kOptions; }

}  // namespace validation
