#include "options.hpp"

#include <sstream>

#include "command/arguments.hpp"
#include "command/option_words.hpp"

namespace serve {
namespace {

using frontend::OptionRow;
using frontend::Takes;

constexpr OptionRow kOptions[] = {
    frontend::kLanguageOption,
    {"http", Takes::kOptionalText, "PORT",
     "show the design in a browser, at the address that is printed; default: any port"},
    {"bind", Takes::kText, "ADDRESS", "the address to listen at; default 127.0.0.1"},
    {"origin", Takes::kText, "URL",
     "the address that browsers see, where a proxy or a forwarded port is in front"},
    {"panel", Takes::kText, "FOLDER", "the files of the browser's page", frontend::kAnyFile},
    {"stdio", Takes::kNothing, "", "without effect: it speaks on standard input and output anyway"},
    frontend::kVersionOption,
    frontend::kHelpOption,
};

boost::program_options::options_description option_table() {
  constexpr unsigned kColumns = 100;
  return frontend::table_of("Options", option_rows(), kColumns);
}

/// `--http design.scad` takes the design for its value.
void read_http(const frontend::Arguments& arguments, std::vector<std::string> files,
               Options& options) {
  const std::string value = arguments.text("http");
  if (!value.empty() && !frontend::parse_number<double>(value)) {
    files.insert(files.begin(), value);
  } else if (!value.empty()) {
    constexpr uint16_t kMost = 65535;
    options.port = arguments.number<uint16_t>("http", 1, kMost, 0);
  }
  if (files.size() != 1) frontend::fail("--http shows one design", "name its file");
  options.design = files[0];
  options.bind = arguments.has("bind") ? arguments.text("bind") : options.bind;
  options.origin = arguments.text_or_empty("origin");
  options.panel = arguments.text_or_empty("panel");
}

}  // namespace

Options parse_options(const std::vector<std::string>& words) {
  const frontend::Arguments arguments(option_table(), words, "scadray serve");
  Options options;
  options.request = arguments.request();
  if (options.request != frontend::ProgramRequest::kWork) return options;
  options.language = frontend::read_language(arguments);
  std::vector<std::string> files = arguments.texts("file");
  if (arguments.has("http")) {
    read_http(arguments, std::move(files), options);
    return options;
  }
  if (!files.empty())
    frontend::fail("scadray serve takes no file: " + files[0],
                   "the editor opens documents; a browser shows one with --http");
  for (const char* option : {"bind", "origin", "panel"}) {
    if (arguments.has(option))
      frontend::fail(std::string("--") + option + " has no effect without --http", "add --http");
  }
  return options;
}

std::string help_text() {
  std::ostringstream text;
  text
      << "Usage: scadray serve [options]\n"
         "       scadray serve --http[=PORT] [options] DESIGN\n"
         "A language server for OpenSCAD's language, with previews: editors start it, and speak\n"
         "the Language Server Protocol with it on standard input and output. With --http it shows\n"
         "the design in any browser.\n"
      << option_table();
  return text.str();
}

std::span<const OptionRow> option_rows() { return kOptions; }

}  // namespace serve
