#include "check.hpp"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace validation {
namespace {

/// Writes "rays, 12 s left".
std::string with_estimate(const std::string& stage, double fraction, Clock::time_point start,
                          Clock::time_point deadline) {
  const Clock::time_point now = Clock::now();
  const double spent_s = std::chrono::duration<double>(now - start).count();
  const double allowed_s = std::chrono::duration<double>(deadline - now).count();
  const double left_s = std::clamp(spent_s * (1 / fraction - 1), 0.0, std::max(0.0, allowed_s));
  return stage + ", " + std::to_string(std::lround(std::ceil(left_s))) + " s left";
}

}  // namespace

void CheckResult::add(Verdict verdict) {
  ++compared;
  worst_error = std::max(worst_error, verdict.error);
  switch (verdict.outcome) {
    case Outcome::kAgreed:
      ++agreed;
      break;
    case Outcome::kUndecided:
      ++undecided;
      break;
    case Outcome::kDisagreed:
      ++disagreed;
      if (disagreements.size() < kMostListed) disagreements.push_back(std::move(verdict.details));
      break;
  }
}

CheckResult run_check(const std::string& group, const std::string& name, uint64_t planned,
                      Clock::time_point deadline, const Progress& progress,
                      const std::function<Judge()>& make_judge) {
  const Clock::time_point start = Clock::now();
  CheckResult result;
  result.group = group;
  result.name = name;
  result.planned = planned;
  tbb::enumerable_thread_specific<Judge> judges(make_judge);
  std::vector<Verdict> verdicts;
  while (result.compared < planned && (result.compared == 0 || Clock::now() < deadline)) {
    const uint64_t first = result.compared;
    verdicts.assign(std::min(kLeastSamples, planned - first), {});
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, verdicts.size()), [&](const auto& range) {
      Judge& judge = judges.local();
      for (std::size_t i = range.begin(); i < range.end(); ++i) verdicts[i] = judge(first + i);
    });
    for (Verdict& verdict : verdicts) result.add(std::move(verdict));
    const double fraction = static_cast<double>(result.compared) / static_cast<double>(planned);
    progress(with_estimate(name, fraction, start, deadline), fraction);
  }
  return result;
}

}  // namespace validation
