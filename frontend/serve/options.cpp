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
    {"stdio", Takes::kNothing, "", "without effect: it speaks on standard input and output anyway"},
    frontend::kVersionOption,
    frontend::kHelpOption,
};

boost::program_options::options_description option_table() {
  constexpr unsigned kColumns = 100;
  return frontend::table_of("Options", option_rows(), kColumns);
}

}  // namespace

Options parse_options(const std::vector<std::string>& words) {
  const frontend::Arguments arguments(option_table(), words, "scadray serve");
  Options options;
  if (arguments.has("help") || arguments.has("version")) {
    options.action = arguments.has("help") ? Action::kHelp : Action::kVersion;
    return options;
  }
  const std::vector<std::string> files = arguments.texts("file");
  if (!files.empty())
    frontend::fail("scadray serve takes no file: " + files[0], "the editor opens documents");
  options.language = frontend::read_language(arguments);
  return options;
}

std::string help_text() {
  std::ostringstream text;
  text << "Usage: scadray serve [options]\n"
          "A language server for OpenSCAD's language: editors start it, and speak the Language\n"
          "Server Protocol with it on standard input and output.\n"
       << option_table();
  return text.str();
}

std::span<const OptionRow> option_rows() { return kOptions; }

}  // namespace serve
