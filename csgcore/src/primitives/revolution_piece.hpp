// The crossings of a ray's path with the pieces of a revolved profile (revolution_path.hpp).
#pragma once

#include <cstdint>
#include <vector>

#include "csgcore/profile.hpp"
#include "primitives/crossings.hpp"
#include "primitives/revolution_path.hpp"

namespace csgcore {

/// Appends the crossings of the path with a piece, whose number is `face`.
void cross_piece(const Profile& profile, const RevolutionPath& path, const Profile::Piece& piece,
                 uint32_t face, std::vector<Crossing>& found);

}  // namespace csgcore
