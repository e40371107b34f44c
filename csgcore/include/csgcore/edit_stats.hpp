// The cost of following an edit, beside the totals.
#pragma once

#include <cstdint>

namespace csgcore {

/// Counts of one edit, from the later scene to its picture. Anything that was made anew as a whole
/// counts in full.
struct EditStats {
  uint64_t primitives = 0;          // of the later scene
  uint64_t primitives_changed = 0;  // removed, added, recoloured; once if in place
  uint64_t cells_made = 0;          // leaves of new subdivisions
  uint64_t pixels = 0;              // of the picture
  uint64_t pixels_traced = 0;       // those in changed_areas(); all if OpenGL draws
  uint64_t bytes_uploaded = 0;      // to the GPU
  uint64_t comparisons = 0;         // of two scenes; time proportional to their sizes
};

}  // namespace csgcore
