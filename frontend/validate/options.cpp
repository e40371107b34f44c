#include "options.hpp"

#include <boost/program_options.hpp>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <sstream>

#include "frontend/error.hpp"
#include "option_rows.hpp"
#include "planted_error.hpp"

namespace validation {
namespace {

namespace po = boost::program_options;
using frontend::RendererKind;

// A sphere of 200 fragments has 20,002 facets, and takes CGAL a minute alone.
constexpr int kMostFragments = 200;
constexpr uint64_t kMostSamples = 1'000'000'000;
constexpr uint64_t kMostViews = 100;  // their pictures are held in memory
constexpr double kLongestLimit_s = 1e7;
constexpr unsigned kMostThreads = 1024;

po::options_description option_table() {
  constexpr unsigned kColumns = 100;
  return frontend::table_of("Options", option_rows(), kColumns);
}

class Arguments {
 public:
  explicit Arguments(const std::vector<std::string>& words) {
    po::options_description all = option_table();
    po::options_description files;
    files.add_options()("file", po::value<std::vector<std::string>>());
    all.add(files);
    po::positional_options_description positions;
    positions.add("file", -1);
    try {
      po::store(po::command_line_parser(words).options(all).positional(positions).run(), values_);
      po::notify(values_);
    } catch (const po::error& error) {
      throw frontend::Error("", {}, error.what(), "see scadray validate --help");
    }
  }

  bool has(const char* option) const { return values_.count(option) > 0; }
  std::string text(const char* option) const {
    return has(option) ? values_[option].as<std::string>() : std::string();
  }
  std::vector<std::string> texts(const char* option) const {
    return has(option) ? values_[option].as<std::vector<std::string>>()
                       : std::vector<std::string>{};
  }

  /// The option's value as a number in [least, most], or `missing`.
  template <typename Number>
  Number number(const char* option, Number least, Number most, Number missing) const {
    if (!has(option)) return missing;
    const std::string value = text(option);
    Number number{};
    const auto [end, failed] = std::from_chars(value.data(), value.data() + value.size(), number);
    if (failed != std::errc() || end != value.data() + value.size() ||
        !(number >= least && number <= most)) {
      std::ostringstream range;
      range << "give a number from " << least << " to " << most;
      bad_value(option, value, range.str());
    }
    return number;
  }

  [[noreturn]] static void bad_value(const std::string& option, const std::string& value,
                                     const std::string& todo) {
    throw frontend::Error("", {}, "--" + option + "=" + value + " is not understood", todo);
  }

 private:
  po::variables_map values_;
};

RendererKind renderer_of(const Arguments& arguments) {
  const std::string name = arguments.text("renderer");
  if (name.empty() || name == "auto") return RendererKind::kAuto;
  if (name == "cpu") return RendererKind::kCpu;
  if (name == "gl") return RendererKind::kGl;
  Arguments::bad_value("renderer", name, "give auto, gl or cpu");
}

std::string only_file(const Arguments& arguments) {
  const std::vector<std::string> files = arguments.texts("file");
  if (files.empty()) {
    throw frontend::Error("", {}, "no file to validate", "give a .csg or .scad file, or -");
  }
  if (files.size() > 1) {
    throw frontend::Error("", {}, "more than one file to validate: " + files[1], "give one");
  }
  return files[0];
}

}  // namespace

Options parse_options(const std::vector<std::string>& words) {
  const Arguments arguments(words);
  Options options;
  if (arguments.has("help") || arguments.has("version")) {
    options.action = arguments.has("help") ? Action::kHelp : Action::kVersion;
    return options;
  }
  options.input = only_file(arguments);
  options.report = arguments.text("report");
  options.quiet = arguments.has("quiet");
  options.import.skip_unsupported = arguments.has("skip-unsupported");
  options.threads = arguments.number("threads", 1u, kMostThreads, options.threads);
  Settings& settings = options.settings;
  settings.fragments = arguments.number("fn", 3, kMostFragments, settings.fragments);
  settings.points = arguments.number<uint64_t>("points", 1, kMostSamples, settings.points);
  settings.rays = arguments.number<uint64_t>("rays", 1, kMostSamples, settings.rays);
  settings.views = arguments.number<uint64_t>("views", 0, kMostViews, settings.views);
  settings.seed = arguments.number<uint64_t>("seed", 0, UINT64_MAX, settings.seed);
  settings.time_limit_s =
      arguments.number("time-limit", 0.0, kLongestLimit_s, settings.time_limit_s);
  settings.renderer = renderer_of(arguments);
  if (const char* error = std::getenv(kPlantedErrorVariable)) settings.planted_error = error;
  for (const std::string& variable : arguments.texts("D")) {
    options.openscad_arguments.insert(options.openscad_arguments.end(), {"-D", variable});
  }
  for (const char* name : {"p", "P"}) {
    if (!arguments.has(name)) continue;
    options.openscad_arguments.insert(options.openscad_arguments.end(),
                                      {std::string("-") + name, arguments.text(name)});
  }
  return options;
}

std::string help_text() {
  std::ostringstream text;
  text << "Usage: scadray validate [options] FILE\n"
          "Compares what scadray draws of a design with exact arithmetic by CGAL. FILE is a .csg, "
          "a\n"
          ".scad (exported by OpenSCAD), or - for a .csg from standard input. Exit status: 0 "
          "agrees,\n"
          "2 disagrees, 1 failed.\n"
       << option_table();
  return text.str();
}

}  // namespace validation
