#include "memory.hpp"

#include <malloc.h>

#include <fstream>
#include <string>

namespace measure {
namespace {

/// Reads a line of /proc/self/status that counts in kB.
std::optional<uint64_t> status_bytes(const std::string& name) {
  std::ifstream file("/proc/self/status");
  for (std::string word; file >> word;) {
    uint64_t kilobytes = 0;
    if (word == name + ":" && file >> kilobytes) return kilobytes * 1024;
  }
  return {};
}

}  // namespace

PeakMemory::PeakMemory() {
  malloc_trim(0);
  // By Linux' proc(5), 5 resets the peak to what is held now.
  std::ofstream reset("/proc/self/clear_refs");
  reset << 5 << std::flush;
  if (reset) start_ = status_bytes("VmRSS");
}

std::optional<uint64_t> PeakMemory::bytes() const {
  const std::optional<uint64_t> peak = status_bytes("VmHWM");
  if (!start_ || !peak) return {};
  return *peak > *start_ ? *peak - *start_ : 0;
}

}  // namespace measure
