#include "base/work_meter.hpp"

#include "language/stopped.hpp"

namespace language {

constinit thread_local WorkMeter work_meter;

void look_whether_to_stop() {
  constexpr int64_t kUnitsBetweenLooks = int64_t{1} << 18;
  work_meter.left = kUnitsBetweenLooks;
  if (work_meter.stop && work_meter.stop->stop_requested()) throw Stopped();
}

}  // namespace language
