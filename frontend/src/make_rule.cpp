#include "make_rule.hpp"

#include <algorithm>

namespace frontend {
namespace {

constexpr std::string_view kContinued = " \\";

std::string escaped(const std::string& name) {
  std::string result;
  for (const char c : name) {
    if (c == ' ' || c == '#') result += '\\';
    if (c == '$') result += '$';
    result += c;
  }
  return result;
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
  std::vector<std::string> names;
  while (!rule.empty()) {
    std::string_view line = rule.substr(0, rule.find('\n'));
    rule.remove_prefix(std::min(line.size() + 1, rule.size()));
    if (!line.starts_with('\t')) continue;  // the targets'
    line.remove_prefix(1);
    if (line.ends_with(kContinued)) line.remove_suffix(kContinued.size());
    names.push_back(without_escapes(line));
  }
  return names;
}

std::string make_rule(const std::vector<std::string>& targets,
                      const std::vector<std::string>& prerequisites) {
  std::string rule;
  for (const std::string& target : targets) rule += (rule.empty() ? "" : " ") + escaped(target);
  rule += ':';
  for (const std::string& name : prerequisites) {
    rule += std::string(kContinued) + "\n\t" + escaped(name);
  }
  return rule + '\n';
}

}  // namespace frontend
