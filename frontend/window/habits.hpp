// What of the window's state is remembered from run to run (memory.hpp), as text.
#pragma once

#include <optional>

#include "frontend/options.hpp"
#include "glfw_window.hpp"
#include "memory.hpp"
#include "state.hpp"

namespace window {

/// Returns what the user has chosen for all designs: colours, projection, shading, smooth edges,
/// and what is switched on.
Memory::Values habits_of(const State& state);

/// Makes these choices as they are remembered, but for those that the command line makes.
void restore_habits(const Memory& memory, const frontend::GivenLook& given, State& state);

/// Returns the window's size, and its position if that is the only window's.
Memory::Values values_of(const Placement& placement, bool has_position);

/// Returns the remembered placement, without a position if another window is open. The size is the
/// given one, or else the remembered one, or else the default.
Placement remembered_placement(const Memory& memory, const std::optional<Size>& given);

}  // namespace window
