#include "subtrees/solid_lowering.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "csgcore/stop_scope.hpp"
#include "solids/faceted_box.hpp"
#include "solids/leaves.hpp"

namespace frontend {
namespace {

using csgcore::CsgTreeBuilder;
using csgcore::Op;
using csgcore::Primitive;

/// What cannot be drawn at any scale is beyond double's numbers in places.
std::vector<Primitive> pieces_of(const SolidPart& part, SolidPool& pool, bool& is_faceted) {
  if (part.primitive) {
    is_faceted = is_faceted || part.is_faceted;
    return {*part.primitive};
  }
  const Generators& generators = part.body.generators;
  if (!std::all_of(generators.begin(), generators.end(), is_finite)) return {};
  ConvexSolid solid = pool.solid(generators);
  is_faceted = is_faceted || solid.is_faceted || part.body.is_faceted;
  return std::move(solid.pieces);
}

}  // namespace

LoweredSubtree lower_solid(const SolidValue& value, const csgcore::Affine& to_world, uint32_t frame,
                           uint32_t id, SolidPool& pool) {
  LoweredSubtree result;
  const auto add_part = [&](CsgTreeBuilder& builder, uint32_t index) {
    csgcore::stop_point();
    const SolidPart& part = value.parts[index];
    const csgcore::Box box = mapped(to_world, part.box);
    builder.open(Op::kUnion);
    for (Primitive& piece : pieces_of(part, pool, result.is_faceted)) {
      piece.local_to_world = compose(to_world, piece.local_to_world);
      piece.id = id;
      piece.color = part.color;
      builder.primitive(static_cast<uint32_t>(result.parts.size()));
      result.parts.push_back({std::move(piece), frame, box});
    }
    builder.close();
  };
  CsgTreeBuilder builder;
  rebuild(value.tree.tokens(), builder, add_part);
  result.solid = builder.finish();
  result.has_operations = !value.is_union();
  if (value.is_union()) result.box = mapped(to_world, value.box());
  return result;
}

std::vector<LoweredSubtree> lower_all(const std::vector<PendingSolid>& pending, SolidPool& pool,
                                      const std::stop_token& stop) {
  std::vector<LoweredSubtree> result(pending.size());
  const auto lower = [&](size_t begin, size_t end) {
    const csgcore::StopScope scope(&stop);
    for (size_t i = begin; i < end; ++i) {
      const PendingSolid& solid = pending[i];
      result[i] = lower_solid(solid.value, solid.to_world, solid.frame, solid.id, pool);
    }
  };
  // Fewer take less than the threads take to start.
  constexpr size_t kAtOnce = 8;
  if (pending.size() <= kAtOnce) {
    lower(0, pending.size());
  } else {
    tbb::parallel_for(tbb::blocked_range<size_t>(0, pending.size(), kAtOnce),
                      [&](const auto& range) { lower(range.begin(), range.end()); });
  }
  return result;
}

}  // namespace frontend
