// What sets the value of one parameter: a slider, a list, a box.
#pragma once

#include <optional>

#include "language/customizer_parameter.hpp"
#include "parameter_edit.hpp"

namespace window {

/// Draws the control, as wide as there is room. Returns a new value when the user gives one: while
/// something is dragged, all the time; what is typed, when it is entered.
std::optional<language::ParameterValue> draw_parameter_control(
    const language::CustomizerParameter& parameter, const language::ParameterValue& value,
    ParameterEdit& edit);

}  // namespace window
