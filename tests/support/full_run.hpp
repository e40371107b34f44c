// The convention of tests/run: a test with a long version runs that version if the environment has
// SCADRAY_TEST_FULL=1, and else a sample of some seconds.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <string_view>

namespace test_support {

inline bool full_run() {
  const char* value = std::getenv("SCADRAY_TEST_FULL");
  return value != nullptr && std::string_view(value) == "1";
}

/// Whether a test of random inputs, or of what is not compiled with the sanitizer, a driver or
/// another program, should do less: that takes long, and the same run without the sanitizer does
/// all of it.
inline bool does_less() {
#if defined(SCADRAY_SANITIZED)
  return !full_run();
#else
  return false;
#endif
}

/// Returns how many random inputs a test takes of a sample of so many.
inline uint32_t sample_size(uint32_t inputs) {
  return does_less() ? std::max(1u, inputs / 8) : inputs;
}

}  // namespace test_support
