// A variable that a design lets its user choose (customizer.hpp).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "language/parameter_value.hpp"

namespace language {

struct ParameterChoice {
  ParameterValue value;  // a number or a string, as the default is
  std::string label;
};

/// Limits of numbers; `step` is above 0.
struct ParameterRange {
  double min = 0, max = 0;
  std::optional<double> step;
};

struct CustomizerParameter {
  std::string name;
  std::string description;  // may be empty
  std::string group;        // empty: none
  ParameterValue value;     // the default
  uint32_t offset = 0;      // of the assignment's name within the text

  // What the comment behind the assignment says, which -o x.param takes by rules of its own.
  std::string comment;
  std::vector<ParameterChoice> choices;  // of a number or a string; empty: any value
  std::optional<ParameterRange> range;   // of a number, or of each in a vector
  std::optional<double> step;            // of the same without a range; above 0
  std::optional<uint32_t> longest;       // of a string, in characters

  /// Returns whether the design asks not to show it: it stands in the group "Hidden".
  bool is_hidden() const { return group == "Hidden"; }
};

}  // namespace language
