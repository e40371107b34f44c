// What an edit cost, to be shown beside what all of it would have.
#pragma once

#include <cstdint>

namespace csgcore {

/// Of one edit, from the later scene to its picture. What was made anew as a whole counts in full.
struct EditStats {
  uint64_t primitives = 0;          // of the later scene
  uint64_t primitives_changed = 0;  // SceneEdit: removed, added or recoloured; in place counts once
  uint64_t cells_kept = 0;          // SubdivisionUpdate
  uint64_t cells_made = 0;
  uint64_t pixels = 0;          // of the picture
  uint64_t pixels_traced = 0;   // changed_areas; by OpenGL all
  uint64_t bytes_uploaded = 0;  // to the GPU
  uint64_t comparisons = 0;     // of two scenes, each in time proportional to their sizes
};

}  // namespace csgcore
