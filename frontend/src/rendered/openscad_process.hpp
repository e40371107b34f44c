// Has openscad evaluate a design, in a process of its own.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>

#include "meshes/face_set.hpp"

namespace frontend {

/// The boundary of what openscad made of a design, or why there is none.
struct OpenScadResult {
  std::optional<RingedFaces> faces;
  std::string problem;  // empty if there are faces
};

enum class OpenScadFormat : uint8_t {
  kNef3,  // no digits are lost, and faces in a plane are one; no solid may cross itself
  kOff,   // the triangles that OpenSCAD shows, by six digits, whatever they enclose
};

/// Runs openscad on the text of a design of solids, and returns its boundary. Where the design is
/// empty, there are no faces in it. Throws Stopped (stop.hpp) as soon as `stop` is requested. In
/// every case openscad and everything that it has started have ended when this returns or throws;
/// they also end if this program is killed.
OpenScadResult evaluate_by_openscad(std::string_view design, OpenScadFormat format,
                                    bool is_in_background,
                                    std::chrono::steady_clock::time_point deadline,
                                    const std::stop_token& stop);

}  // namespace frontend
