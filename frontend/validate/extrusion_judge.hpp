// Compares the extrusions of a design whose sides turn with OpenSCAD's own facets.
#pragma once

#include "frontend/design_tree.hpp"
#include "frontend/import_options.hpp"
#include "validation.hpp"

namespace validation {

/// Compares each linear_extrude that turns, or that is scaled differently in x and y, with the
/// triangles that the installed openscad makes of the same node: rays in exact arithmetic trace the
/// triangles that scadray has made, and cannot tell whether these are right. Each ray is a line
/// from outside, along which both must see the same place.
///
/// What openscad cannot judge is left out, with a note. It gets until the deadline.
Result judge_extrusions(const frontend::DesignTree& tree, const frontend::ImportOptions& options,
                        const Settings& settings, Clock::time_point deadline,
                        const Progress& progress);

}  // namespace validation
