// --summary: figures of a design's solid or plane figure, in OpenSCAD's words.
#pragma once

#include <optional>
#include <string>

#include "frontend/camera.hpp"
#include "frontend/model_export.hpp"
#include "frontend/options.hpp"

namespace frontend {

struct Summary {
  double time_ms = 0;
  Camera camera;
  std::optional<ModelFigures> figures;  // nothing: the design has no solid and no plane figure
};

/// Returns the lines of these parts, as OpenSCAD 2025.07 prints them. A solid is told of as
/// Manifold's; it has an area, too: that of its surface.
std::string summary_text(const SummaryParts& parts, const Summary& summary);

/// Returns these parts as OpenSCAD's JSON, with the area beside the bounding box, and these also
/// where "geometry" is not asked for.
std::string summary_json(const SummaryParts& parts, const Summary& summary);

}  // namespace frontend
