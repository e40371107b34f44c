// A line that the evaluation of a design says.
#pragma once

#include <functional>
#include <string>

#include "frontend/source_place.hpp"

namespace frontend {

struct DesignMessage {
  const std::string& text;
  SourcePlace place{};         // that the text names; line 0: none, or the text alone tells it
  bool follows_error = false;  // it was said after the ERROR that ends the reading
  operator const std::string&() const { return text; }
};

using DesignMessageSink = std::function<void(const DesignMessage&)>;

}  // namespace frontend
