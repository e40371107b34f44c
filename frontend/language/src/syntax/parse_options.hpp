// How a design is parsed.
#pragma once

#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

namespace language {

struct ParseOptions {
  std::vector<std::string> definitions;  // -D, in order, as typed
  bool hard_warnings = false;
  std::stop_token stop;
  std::string_view standard_input;  // the text of the file "-"
};

}  // namespace language
