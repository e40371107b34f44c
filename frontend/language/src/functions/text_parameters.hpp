// The parameters of text() and textmetrics().
#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "language/text_meter.hpp"
#include "language/value.hpp"

namespace language {

/// In the order of unnamed arguments. The first kOldTextParameters are those of 2021.01.
inline constexpr std::string_view kTextParameters[] = {
    "text", "size", "font", "direction", "language", "script", "halign", "valign", "spacing", "em"};
inline constexpr std::size_t kOldTextParameters = 9;

/// Returns what values of these parameters say. `halign` and `valign` are the words that count
/// where none are given. The script is that of the letters if none is named, the direction the
/// script's. `em`, where it is given, is the size of the font's em square, which is 1/0.72 of
/// `size`.
TextRequest text_request(std::span<const Value> parameters, std::string_view halign,
                         std::string_view valign);

/// Calls `warn` for each of the parameters that has a value of another type than it should, of a
/// call of text() or textmetrics().
void check_text_types(std::string_view callee, std::span<const Value> parameters,
                      const std::function<void(std::string)>& warn);

}  // namespace language
