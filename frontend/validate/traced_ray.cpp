#include "traced_ray.hpp"

#include <tbb/task_arena.h>

namespace validation {

Seen traced_ray(const csgcore::Subdivision& subdivision, const csgcore::View& view) {
  csgcore::Hits hits;
  csgcore::TraceStats stats;
  // Without isolation, a thread that waits for the tracer's tasks might begin with another ray
  // meanwhile, and nest without end.
  tbb::this_task_arena::isolate([&] { csgcore::trace(subdivision, view, {}, hits, stats); });
  return seen_at(hits, 0);
}

}  // namespace validation
