// Writes the options of a manual page, in roff with the man macros.
#include "program.hpp"

namespace packaging {
namespace {

using frontend::OptionRow;
using frontend::Takes;

/// Escapes a text for roff: hyphens stay such that they can be copied into a shell, and no line is
/// taken for a request.
std::string roff(const std::string& text) {
  std::string result;
  if (text.starts_with('.') || text.starts_with('\'')) result = "\\&";
  for (const char c : text) {
    switch (c) {
      case '-':
        result += "\\-";
        break;
      case '\\':
        result += "\\e";
        break;
      default:
        result += c;
    }
  }
  return result;
}

/// "-o OUT", "-q, --quiet", "--show=WHAT"
std::string tag_of(const OptionRow& row) {
  std::string tag;
  for (const std::string& name : spellings(row)) {
    tag += (tag.empty() ? "" : ", ") + ("\\fB" + roff(name) + "\\fR");
  }
  if (row.takes == Takes::kNothing) return tag;
  const bool is_short = spellings(row).back().size() == 2;
  // A value that may be missing follows an equals sign; otherwise the next word might be taken for
  // it.
  const std::string value = (is_short ? " " : "=") + ("\\fI" + roff(row.value_name) + "\\fR");
  return tag + (row.takes == Takes::kOptionalText ? "[" + value + "]" : value);
}

}  // namespace

std::string manual_options(const Program& program) {
  std::string text;
  for (const OptionGroup& group : program.groups) {
    if (program.groups.size() > 1) text += ".SS \"" + roff(group.title) + "\"\n";
    for (const OptionRow& row : group.rows) {
      text += ".TP\n" + tag_of(row) + "\n" + roff(help_of(row)) + ".\n";
    }
  }
  return text;
}

}  // namespace packaging
