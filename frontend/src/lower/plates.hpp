// The plates that stand for plane figures, where they cut.
#pragma once

#include <span>
#include <vector>

#include "frontend/import_options.hpp"
#include "lower/collector.hpp"
#include "lower/composition.hpp"
#include "lower/leaf_boxes.hpp"
#include "solids/leaves.hpp"

namespace frontend {

/// Returns the boxes of all leaves where those of plates, which are flat, are of so thick ones.
/// Empty: they are the same.
std::vector<csgcore::Box> boxes_of_thick_plates(double thickness, const Collector& collected,
                                                const Leaves& leaves,
                                                std::span<const csgcore::Box> boxes);

/// OpenSCAD cuts with thicker plates than it draws. A plate that cuts in one tree and is drawn in
/// another one, as a `#` part is over its own cut, becomes two leaves; but not in the
/// thrown-together picture, where the plate that cuts hides the other one. Adds primitives, leaves
/// and boxes.
void thicken_cutting_plates(PictureKind picture, Design& trees, Collector& collected,
                            Leaves& leaves, LeafBoxes& boxes);

}  // namespace frontend
