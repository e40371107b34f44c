// Triangles for plane figures that are bounded by several rings.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

namespace frontend {

/// Appends the triangles of the figure that the rings bound to `triangles`. The rings are vertices
/// by their numbers, which are also the indices of their `places`. Outer ones run counterclockwise
/// and holes clockwise; they may touch, but do not cross themselves or each other. The directed
/// edges of all triangles together are those of the rings, and others in both directions.
void triangulate_rings(const std::vector<std::vector<uint32_t>>& rings,
                       std::span<const glm::dvec2> places,
                       std::vector<std::array<uint32_t, 3>>& triangles);

}  // namespace frontend
