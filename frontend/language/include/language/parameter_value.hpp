// The values that a parameter set can give to a design's variables (LANGUAGE.md, "Text").
#pragma once

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

/// Returns a value as a parameter set's file has it.
std::string set_text(const ParameterValue& value);
/// Returns the value that the text of a parameter set stands for; nothing if it is not of the
/// default's type, and the default counts.
std::optional<ParameterValue> value_of_text(std::string_view text, const ParameterValue& fallback);

}  // namespace language
