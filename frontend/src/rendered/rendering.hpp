// What openscad makes of parts of a design, all of them at once.
#pragma once

#include <memory>
#include <span>
#include <stop_token>
#include <string>
#include <vector>

#include "frontend/rendering_options.hpp"
#include "meshes/face_set.hpp"

namespace frontend {

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
