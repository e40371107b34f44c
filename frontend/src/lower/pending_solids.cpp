#include "lower/pending_solids.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "csgcore/stop_scope.hpp"
#include "lower/solid_lowering.hpp"

namespace frontend {

std::vector<LoweredSubtree> lower_all(const std::vector<PendingSolid>& pending, HullPool& hulls,
                                      const std::stop_token& stop) {
  std::vector<LoweredSubtree> result(pending.size());
  const auto lower = [&](size_t begin, size_t end) {
    const csgcore::StopScope scope(&stop);
    for (size_t i = begin; i < end; ++i) {
      const PendingSolid& solid = pending[i];
      if (solid.rendering) continue;
      result[i] = lower_solid(solid.value, solid.to_world, solid.frame, solid.id, hulls);
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
