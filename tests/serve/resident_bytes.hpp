// The memory that a test's process has taken.
#pragma once

#include <cstddef>
#include <fstream>

namespace serve {

inline std::size_t resident_bytes() {
  std::ifstream file("/proc/self/statm");
  std::size_t all = 0, resident = 0;
  file >> all >> resident;
  return resident * 4096;
}

}  // namespace serve
