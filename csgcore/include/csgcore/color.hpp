// The colours of a design.
#pragma once

namespace csgcore {

/// RGBA as the file gives it; no gamma curve is applied to it. A channel above 1 makes a surface
/// brighter than white would; a negative r, g or b stands for that channel of the scheme's colour.
/// The alpha is in [0, 1].
struct Color {
  float r, g, b, a;
  bool operator==(const Color&) const = default;
};

}  // namespace csgcore
