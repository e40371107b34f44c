#include "candidate.hpp"

namespace measure {

Run run_of(const ProcessResult& result) {
  Run run{result.wall_ms, result.timed_out, {}, {}};
  if (!result.succeeded() && !result.timed_out) {
    constexpr size_t kMostWords = 200;
    const size_t length = result.output.size();
    run.failure = "it failed: " + result.output.substr(length - std::min(length, kMostWords));
  }
  return run;
}

std::vector<uint32_t> fragment_counts(const Settings& settings) {
  if (find_program("openscad").empty()) return {};
  return settings.quick ? std::vector<uint32_t>{kCoarsest, 48}
                        : std::vector<uint32_t>{kCoarsest, 24, 48, 96, 192};
}

}  // namespace measure
