// The lines in which the faces of two bodies cross.
#pragma once

#include <cstdint>
#include <functional>

#include "edges/bodies.hpp"

namespace frontend {

/// Calls visit(from, to) for each pair of faces, one of each body, that cross in more than a point.
/// An edge of one face that lies in the other face's plane is no crossing. `steps` is counted up by
/// one for each box that is looked at; visit() returns false to end the search.
/// Precondition: both bodies have meshes.
void cross_faces(const Body& a, const Body& b, uint64_t& steps,
                 const std::function<bool(const csgcore::Vec3&, const csgcore::Vec3&)>& visit);

}  // namespace frontend
