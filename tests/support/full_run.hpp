// The convention of tests/run: a test with a long version runs that version if the environment has
// SCADRAY_TEST_FULL=1, and else a sample of some seconds.
#pragma once

#include <cstdlib>
#include <string_view>

namespace test_support {

inline bool full_run() {
  const char* value = std::getenv("SCADRAY_TEST_FULL");
  return value != nullptr && std::string_view(value) == "1";
}

}  // namespace test_support
