// What a comparison of many samples adds up to, and the loop over them.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace validation {

using Clock = std::chrono::steady_clock;
using Json = nlohmann::ordered_json;

enum class Outcome : uint8_t {
  kAgreed,
  kUndecided,  // differs, or may, within what a tolerance allows
  kDisagreed,
};

struct Verdict {
  Outcome outcome = Outcome::kAgreed;
  double error = 0;  // ≥ 0, in the unit of its check
  /// Of a disagreement: "seen" and "expected", and where. Either, or "nearest", may hold a
  /// "primitive": its index, and later its id.
  Json details;
};

/// The parts of a disagreement's details that may hold a primitive.
constexpr const char* kWithPrimitive[] = {"seen", "expected", "nearest"};

/// One row of the table.
struct CheckResult {
  std::string group;  // what is compared with what; rows of a group follow each other
  std::string name;
  uint64_t planned = 0;
  uint64_t compared = 0;  // fewer than planned if time ran out
  uint64_t agreed = 0;
  uint64_t undecided = 0;
  uint64_t disagreed = 0;
  double worst_error = 0;           // of all samples
  std::vector<Json> disagreements;  // the first kMostListed

  void add(Verdict verdict);
};

/// More disagreements than this of one check are counted, but not listed.
constexpr std::size_t kMostListed = 1000;

/// Called with what is done in [0, 1], below 0: not known.
using Progress = std::function<void(const std::string& stage, double fraction)>;

/// Judges one sample. Made once a thread.
using Judge = std::function<Verdict(uint64_t sample)>;

/// Judges samples 0, 1, … planned − 1, in parallel, until the deadline: a first kLeastSamples in
/// any case. The result depends on how many are compared alone.
CheckResult run_check(const std::string& group, const std::string& name, uint64_t planned,
                      Clock::time_point deadline, const Progress& progress,
                      const std::function<Judge()>& make_judge);

/// Judged before the time is looked at, and between two looks.
constexpr uint64_t kLeastSamples = 1024;

}  // namespace validation
