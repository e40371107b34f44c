// The design's parameters and their sets.
#pragma once

#include "panels/section_panel.hpp"
#include "state.hpp"

namespace window {

/// Returns the right end of the room that they take at the left side; 0 if they are switched off,
/// or there are none.
float customizer_right(const State& state, const SectionCorner& section);

/// Draws them there, above `bottom`, and below the section's panel where there is no room beside
/// it.
void draw_customizer(State& state, float bottom, const SectionCorner& section);

}  // namespace window
