// What openscad makes of a design.
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <string_view>

#include "meshes/face_set.hpp"

namespace validation {

/// The boundary of what openscad made of a design, or why there is none.
struct OpenScadFacets {
  std::optional<frontend::FaceSet> faces;
  std::string problem;  // empty if there are faces
};

/// Runs openscad on the text of a design of solids, and returns the triangles that it shows, by six
/// digits. Where the design is empty, there are none. When this returns, openscad and everything
/// that it has started have ended; they also end if this program is killed.
OpenScadFacets facets_by_openscad(std::string_view design,
                                  std::chrono::steady_clock::time_point deadline);

}  // namespace validation
