// What differs between two scenes, a design before and after a save: what was made from the earlier
// one need not be made again where the later one is the same.
//
//   const SceneEdit edit = compare(before, after);
//   auto primitives = canonical_primitives(after, *earlier_primitives, edit);
//   const Solid solid(primitives, after.model, earlier_solid, edit, edit.model);
//   subdivision.update(solid, edit, edit.model);
//   for (const PixelArea& area : changed_areas(…)) draw(…);
//
// See solid.hpp, subdivision.hpp, changed_areas.hpp and TraceOptions::area.
#pragma once

#include <cstdint>
#include <vector>

#include "csgcore/scene.hpp"

namespace csgcore {

/// How a tree of the later scene compares with that of the earlier.
enum class TreeEdit : uint8_t {
  kSame,      // token by token, whatever became of the primitives
  kWithin,    // the solids are the same wherever no primitive that was removed or added reaches
  kAnywhere,  // nothing is known
};

/// From an earlier scene to a later one. A primitive that was changed was removed and added. All
/// others are kept: they are the same solids, in the same order.
struct SceneEdit {
  uint32_t primitives_before = 0;
  uint32_t primitives_after = 0;
  std::vector<uint32_t> removed;    // indices into the earlier scene, ascending
  std::vector<uint32_t> added;      // indices into the later scene, ascending
  std::vector<uint32_t> recolored;  // kept primitives; indices into the later scene, ascending
  bool has_other_ids = false;       // of kept primitives
  bool has_other_layers = false;    // the picture is composed of other layers
  TreeEdit model = TreeEdit::kAnywhere;

  /// All that is kept has its index: primitives were changed in place, or not at all.
  bool keeps_indices() const { return removed == added; }
  /// No solid has changed, in shape or in colour; nor have ids.
  bool nothing() const;
  /// No solid has changed in shape: colours have, or ids.
  bool surfaces_only() const;
  /// By the index of an earlier primitive its later one; kGone if it was removed.
  static constexpr uint32_t kGone = 0xFFFFFFFFu;
  std::vector<uint32_t> later_indices() const;
};

/// Primitives are matched in file order: index by index where the trees are the same; else those
/// before the first and after the last that differ. Takes time proportional to the scenes' sizes.
SceneEdit compare(const Scene& before, const Scene& after);

/// The same convex solid, number by number; colour and id aside.
bool same_shape(const Primitive& a, const Primitive& b);

}  // namespace csgcore
