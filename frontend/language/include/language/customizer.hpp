// What a design lets its user choose: the variables of its main file that a parameter set can give
// values to, and what the comments around them say (LANGUAGE.md, "Parameters").
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "language/value.hpp"

namespace language {

/// Texts that stand for values, by the variables' names, as a parameter set's file has them.
using ParameterSet = std::map<std::string, std::string, std::less<>>;

/// A vector or a range, as a parameter set spells it.
struct LiteralText {
  ValueType type = ValueType::kVector;
  std::string text;
  bool operator==(const LiteralText&) const = default;
};

/// A vector of one to four numbers is a std::vector, any other is a LiteralText.
using ParameterValue = std::variant<bool, double, std::string, std::vector<double>, LiteralText>;

/// The most numbers of a vector that are set one by one.
constexpr size_t kMostNumbers = 4;

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

  // What the comment behind the assignment says.
  std::vector<ParameterChoice> choices;  // of a number or a string; empty: any value
  std::optional<ParameterRange> range;   // of a number, or of each in a vector
  std::optional<double> step;            // of the same without a range; above 0
  std::optional<uint32_t> longest;       // of a string, in characters

  /// Returns whether the design asks not to show it: it stands in the group "Hidden".
  bool is_hidden() const { return group == "Hidden"; }
};

/// Returns the parameters in the text of a main file, in its order. Nothing if it cannot be parsed.
/// Files that it includes are not looked at.
std::optional<std::vector<CustomizerParameter>> customizer_parameters(std::string_view text);

/// Returns a value as a parameter set's file has it.
std::string set_text(const ParameterValue& value);
/// Returns the value that the text of a parameter set stands for; nothing if it is not of the
/// default's type, and the default counts.
std::optional<ParameterValue> value_of_text(std::string_view text, const ParameterValue& fallback);

}  // namespace language
