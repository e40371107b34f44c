// What openscad makes of parts of a design, all of them at once.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "frontend/import_options.hpp"
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

/// A part of a design.
struct RenderRequest {
  std::string text;    // a design of solids, for openscad
  std::string inputs;  // changes whenever the files that the text names change
  uint32_t line = 0;   // where the part stands in the design
};

struct Rendering {
  std::shared_ptr<const RingedFaces> faces;  // null: there is none
  std::string problem;                       // why there is none; empty: it is left for later
};

/// Returns the rendering of each request: from the cache (render_cache.hpp), or else by openscad,
/// as many at once as there are processors. Equal requests share theirs. Throws what
/// throw_if_stopped() throws.
std::vector<Rendering> render_all(std::span<const RenderRequest> requests,
                                  const RenderingOptions& options, const std::stop_token& stop);

}  // namespace frontend
