// The difference between two scenes, such as a design before and after a save: only a part of the
// picture has to be drawn again (changed_areas.hpp, TraceOptions::area).
#pragma once

#include <cstdint>
#include <vector>

#include "csgcore/scene.hpp"

namespace csgcore {

/// How a tree of the later scene compares with the same tree of the earlier one.
enum class TreeEdit : uint8_t {
  kSame,      // the tokens are the same; primitives may have changed
  kWithin,    // the solids are the same outside of all removed and added primitives
  kAnywhere,  // nothing is known
};

/// The edit that leads from an earlier scene to a later one. A primitive whose shape was changed
/// counts as removed and added. All others are kept: they are the same solids, in the same order.
struct SceneEdit {
  uint32_t primitives_before = 0;
  uint32_t primitives_after = 0;
  std::vector<uint32_t> removed;    // indices into the earlier scene, ascending
  std::vector<uint32_t> added;      // indices into the later scene, ascending
  std::vector<uint32_t> recolored;  // kept primitives; indices into the later scene, ascending
  bool has_other_ids = false;       // ids of kept primitives have changed
  bool has_other_layers = false;    // the picture is composed of other layers
  TreeEdit model = TreeEdit::kAnywhere;

  /// Returns whether kept primitives have kept their indices: others were changed in place.
  bool keeps_indices() const { return removed == added; }
  /// Returns whether no shape, colour or id has changed.
  bool nothing() const;
  /// Returns whether no shape has changed; colours and ids may have.
  bool surfaces_only() const;
  /// For each earlier primitive its index in the later scene; kGone if it was removed.
  static constexpr uint32_t kGone = 0xFFFFFFFFu;
  std::vector<uint32_t> later_indices() const;
};

/// Compares two scenes, in time proportional to their sizes. If the trees are the same, primitives
/// are matched by index. Otherwise those before the first difference and those after the last one
/// are matched, and all between count as removed or added.
SceneEdit compare(const Scene& before, const Scene& after);

/// Returns whether two primitives have the same numbers, colour and id aside.
bool same_shape(const Primitive& a, const Primitive& b);

/// The cost of following an edit, beside the totals: counts of one edit, from the later scene to
/// its picture. Anything that was made anew as a whole counts in full.
struct EditStats {
  uint64_t primitives = 0;          // of the later scene
  uint64_t primitives_changed = 0;  // removed, added, recoloured; once if in place
  uint64_t cells_made = 0;          // leaves of new subdivisions
  uint64_t pixels = 0;              // of the picture
  uint64_t pixels_traced = 0;       // those in changed_areas(); all if OpenGL draws
};

}  // namespace csgcore
