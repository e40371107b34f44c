// How a design is parsed.
#pragma once

#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

namespace language {

struct ParseOptions {
  std::vector<std::string> definitions;  // -D, in order, as typed
  bool hard_warnings = false;
  std::stop_token stop;
  std::optional<std::string_view> text;  // of the main file; nothing: it is read
};

}  // namespace language
