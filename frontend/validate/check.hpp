// Compares many samples, and sums up their verdicts.
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
  kUndecided,  // differs, or may differ, but within a tolerance
  kDisagreed,
};

struct Verdict {
  Outcome outcome = Outcome::kAgreed;
  double error = 0;  // ≥ 0, in the check's unit
  /// For a disagreement: "seen", "expected" and where. These two and "nearest" may hold a
  /// "primitive": its index, which is later replaced by its id.
  Json details;
};

/// The parts of a disagreement's details that may hold a primitive.
constexpr const char* kWithPrimitive[] = {"seen", "expected", "nearest"};

/// One row of the table.
struct CheckResult {
  std::string group;  // what is compared with what; a group's rows are consecutive
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

/// The most disagreements that a check lists; further ones are only counted.
constexpr std::size_t kMostListed = 1000;

/// Called with a stage and the fraction of it that is done, in [0, 1]; below 0: unknown.
using Progress = std::function<void(const std::string& stage, double fraction)>;

/// Judges one sample. Each thread makes its own judge.
using Judge = std::function<Verdict(uint64_t sample)>;

/// Judges samples 0, 1, … planned − 1 in parallel until the deadline, but the first kLeastSamples
/// in any case. The result depends only on how many are compared.
CheckResult run_check(const std::string& group, const std::string& name, uint64_t planned,
                      Clock::time_point deadline, const Progress& progress,
                      const std::function<Judge()>& make_judge);

/// Samples that are judged between two looks at the clock.
constexpr uint64_t kLeastSamples = 1024;

}  // namespace validation
