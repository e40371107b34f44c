#include "lower/tight_box.hpp"

#include <unordered_map>
#include <vector>

#include "csgcore/canonical_primitive.hpp"
#include "lower/faceted_box.hpp"

namespace frontend {

using csgcore::Affine;
using csgcore::Box;
using csgcore::Primitive;

Box tight_box(std::span<const Primitive> primitives, const csgcore::CsgTree& solid,
              const Affine& frame_to_world, csgcore::BoundsBudget& budget) {
  std::vector<uint32_t> used;
  std::unordered_map<uint32_t, uint32_t> new_indices;
  const csgcore::CsgTree tree = csgcore::renamed(solid, [&](uint32_t index) {
    const auto [entry, is_new] = new_indices.try_emplace(index, static_cast<uint32_t>(used.size()));
    if (is_new) used.push_back(index);
    return entry->second;
  });
  Affine to_frame;
  to_frame.linear = csgcore::inverse(frame_to_world.linear);
  to_frame.translation = -(to_frame.linear * frame_to_world.translation);
  std::vector<csgcore::CanonicalPrimitive> in_frame;
  in_frame.reserve(used.size());
  for (const uint32_t index : used) {
    Primitive primitive = primitives[index];
    primitive.local_to_world = csgcore::compose(to_frame, primitive.local_to_world);
    if (!csgcore::is_valid(primitive)) return tight_box(primitives, solid, {}, budget);
    in_frame.push_back(csgcore::canonicalize(primitive));
  }
  const Box box = csgcore::tight_bounds(in_frame, tree, budget);
  return box.empty() ? box : mapped(frame_to_world, box);
}

}  // namespace frontend
