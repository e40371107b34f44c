// Where points of a plane lie relative to each other.
#pragma once

#include <glm/vec2.hpp>

namespace frontend {

/// Returns 1 if a, b, c run counterclockwise, −1 if they run clockwise, and 0 on a line. The sign
/// is exact for coordinates whose sizes are 0 or between 1e-140 and 1e140.
int orientation(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c);

/// Returns 1 if d lies within the circle through a, b and c, which run counterclockwise, −1 if it
/// lies outside, and 0 if it lies on the circle up to rounding.
int in_circle(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c, const glm::dvec2& d);

}  // namespace frontend
