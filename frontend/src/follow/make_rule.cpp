#include "follow/make_rule.hpp"

#include <cstdint>

#include "frontend/error.hpp"

namespace frontend {
namespace {

// GNU make reads a rule several times: to find the end of the targets and of the prerequisites,
// first with variables unexpanded, then with them expanded; then name by name for patterns and
// wildcards. A character that one of these readings would interpret, and that no escape protects,
// is written as a reference to a function that expands to it. (Found by trying each byte with make
// 4.3; make_rule_test holds it.)

constexpr std::string_view kContinued = " \\";
constexpr std::string_view kWildcards = "*?[";
constexpr std::string_view kWhiteSpace = " \t\v\f\r";

enum class Side : uint8_t { kTarget, kPrerequisite };

/// Returns text that make expands to `c`.
std::string reference_to(char c) { return std::string("$(subst x,") + c + ",x)"; }

struct Escape {
  std::string text;
  bool by_backslash = false;  // backslashes before it would be taken for escapes, too
};

Escape escape_of(char c, bool is_last, Side side) {
  switch (c) {
    case ':':
    case '#':
      return {std::string("\\") + c, true};
    case ' ':  // escaped as by OpenSCAD; before the line's end it would be lost
      return {is_last ? '\\' + reference_to(c) : "\\ ", true};
    case ';':
    case '\t':
      return {'\\' + reference_to(c), true};
    case '%':
      if (side == Side::kTarget) return {"\\%", true};
      break;
    case '|':
      if (side == Side::kPrerequisite) return {"\\|", true};
      break;
    case '=':
      return {reference_to(c)};
    case '&':
      if (side == Side::kTarget && is_last) return {reference_to(c)};
      break;
    case '$':
      return {"$$"};
    default:
      if (kWildcards.find(c) != std::string_view::npos) return {std::string("\\") + c};
  }
  return {std::string(1, c)};
}

/// Returns whether the name contains a wildcard, or a byte that is written as one.
bool has_wildcard(const std::string& name) {
  return name.starts_with('~') || name.find_first_of(kWildcards) != std::string::npos;
}

/// Throws Error for a name that cannot be escaped.
void check_name(const std::string& name, Side side) {
  const bool is_pattern =
      side == Side::kTarget && name.find('%') != std::string::npos && has_wildcard(name);
  const bool has_break = name.find('\n') != std::string::npos;
  if (!is_pattern && !has_break && !name.ends_with(')')) return;
  std::string shown;
  for (const char c : name) shown += c == '\n' ? "\\n" : std::string(1, c);
  throw Error("", {},
              "no rule for make can name '" + shown + "': it " +
                  (has_break    ? "has a line break"
                   : is_pattern ? "has both % and a wildcard"
                                : "ends in ')'"),
              "rename it, or leave out -d");
}

std::string escaped(const std::string& name, Side side) {
  check_name(name, side);
  std::string result;
  if (name.find_first_of(kWhiteSpace) == 0) result = "./";  // make drops the "./"
  // make unescapes a name with a wildcard once more.
  const std::size_t repeat = has_wildcard(name) ? 2 : 1;
  std::size_t backslashes = 0;  // before the next byte
  for (std::size_t i = 0; i < name.size(); ++i) {
    if (name[i] == '\\') {
      ++backslashes;
      continue;
    }
    Escape escape = escape_of(name[i], i + 1 == name.size(), side);
    if (i == 0 && name[i] == '~') escape.text = "[~]";  // not the home folder
    result.append(backslashes * repeat * (escape.by_backslash ? 2 : 1), '\\');
    result += escape.text;
    backslashes = 0;
  }
  return result.append(backslashes * repeat * 2, '\\');  // a space or ':' follows
}

std::string without_escapes(std::string_view name) {
  std::string result;
  for (std::size_t i = 0; i < name.size(); ++i) {
    if (!name.substr(i).starts_with("\\ ")) result += name[i];
  }
  return result;
}

}  // namespace

std::vector<std::string> prerequisites_of(std::string_view rule) {
  constexpr std::string_view kNext = "\n\t";
  std::vector<std::string> names;
  std::size_t start = rule.find(kNext);  // after the targets
  while (start != std::string_view::npos) {
    start += kNext.size();
    const std::size_t end = rule.find(kNext, start);
    std::string_view name = rule.substr(start, end - start);
    if (end == std::string_view::npos && name.ends_with('\n')) name.remove_suffix(1);
    if (name.ends_with(kContinued)) name.remove_suffix(kContinued.size());
    names.push_back(without_escapes(name));
    start = end;
  }
  return names;
}

std::string make_rule(const std::vector<std::string>& targets,
                      const std::vector<std::string>& prerequisites) {
  std::string rule;
  for (const std::string& target : targets) {
    rule += (rule.empty() ? "" : " ") + escaped(target, Side::kTarget);
  }
  rule += ':';
  for (const std::string& name : prerequisites) {
    rule += std::string(kContinued) + "\n\t" + escaped(name, Side::kPrerequisite);
  }
  // At the end of the line, white space would be lost, and a backslash would continue the line. A
  // bar, as before order-only prerequisites, prevents both.
  const bool has_open_end = !prerequisites.empty() &&
                            prerequisites.back().find_last_of(std::string(kWhiteSpace) + '\\') ==
                                prerequisites.back().size() - 1;
  return rule + (has_open_end ? " |\n" : "\n");
}

}  // namespace frontend
