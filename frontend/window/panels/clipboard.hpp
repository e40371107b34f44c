// Copies texts to the clipboard.
#pragma once

#include <string>

#include "state.hpp"

namespace window {

/// Copies a text, and says so.
void copy(State& state, const std::string& text);

/// Copies all that is measured, or else all messages.
void copy_measured_or_said(State& state);

}  // namespace window
