// How much memory this program's own work takes.
#pragma once

#include <cstdint>
#include <optional>

namespace measure {

/// Watches the memory that this program holds, from now on; one at a time.
class PeakMemory {
 public:
  PeakMemory();
  /// The most that was held since, above what was held at the start; none where the system does not
  /// tell.
  std::optional<uint64_t> bytes() const;

 private:
  std::optional<uint64_t> start_;
};

}  // namespace measure
