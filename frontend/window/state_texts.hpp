// The state in words: what is measured, and what is said of the design.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "state.hpp"

namespace window {

/// Returns the distance of both points, and the way from the first to the second. Precondition: two
/// points are measured.
std::string distance_text(const std::vector<MeasuredPoint>& points);

/// Returns what is known of the last point, in a line, and its relation to the one before.
/// Precondition: a point is measured.
std::vector<std::string> measured_lines(const std::vector<MeasuredPoint>& points);

/// Returns what Ctrl+C copies: all that is measured, or else all messages; empty: there is neither.
std::string text_to_copy(const State& state);

/// Returns a message with the calls that led to it.
std::string text_of(const Message& message);

/// Visits the texts that the panels show and that are not the program's own.
void visit_texts(const State& state, const std::function<void(std::string_view)>& visit);

}  // namespace window
