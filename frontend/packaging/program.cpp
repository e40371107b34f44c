#include "program.hpp"

#include <algorithm>
#include <cstring>

namespace packaging {

std::string function_of(const Program& program) {
  std::string name = program.name;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

std::vector<std::string> spellings(const frontend::OptionRow& row) {
  const std::string names = row.names;
  const std::size_t comma = names.find(',');
  const std::string long_name = names.substr(0, comma);
  std::vector<std::string> all;
  if (comma != std::string::npos) all.push_back("-" + names.substr(comma + 1));
  if (long_name.size() > 1) all.push_back("--" + long_name);
  return all;
}

std::string brief_of(const frontend::OptionRow& row) {
  std::string help = row.help;
  help = help.substr(0, help.find(';'));
  if (help.ends_with(':')) help.pop_back();
  return help;
}

std::string escaped(const std::string& text, const char* characters) {
  std::string result;
  for (const char c : text) {
    if (std::strchr(characters, c)) result += '\\';
    result += c;
  }
  return result;
}

}  // namespace packaging
