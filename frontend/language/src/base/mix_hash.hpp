// A hash of numbers, for tables in memory.
#pragma once

#include <cstdint>

namespace language {

/// Makes a number count in a hash. For one number, different hashes stay different, and the other
/// way round: every step can be undone.
inline uint64_t mix_hash(uint64_t hash, uint64_t number) {
  constexpr uint64_t kFactor = 0x9E3779B97F4A7C15u;  // 2^64 divided by the golden ratio
  hash = (hash ^ number) * kFactor;
  return hash ^ hash >> 32;
}

}  // namespace language
