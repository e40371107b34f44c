// What is drawn over a finished picture.
#pragma once

namespace window {

/// OpenSCAD's --view.
struct Overlays {
  bool axes = false;
  bool crosshairs = false;
  bool scales = false;
  bool edges = false;
  bool operator==(const Overlays&) const = default;
};

}  // namespace window
