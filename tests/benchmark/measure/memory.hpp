// Measures how much memory this program's own work takes.
#pragma once

#include <cstdint>
#include <optional>

namespace measure {

/// Watches the memory that this program holds, from now on. There is one such object at a time.
class PeakMemory {
 public:
  PeakMemory();
  /// The most that was held since, beyond what was held at the start; nothing if the system does
  /// not tell.
  std::optional<uint64_t> bytes() const;

 private:
  std::optional<uint64_t> start_;
};

}  // namespace measure
