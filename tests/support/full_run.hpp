// The convention of tests/run: a test that has a long version runs it where the environment says
// SCADRAY_TEST_FULL=1, and a sample of some seconds otherwise.
#pragma once

#include <cstdlib>
#include <string_view>

namespace test_support {

inline bool full_run() {
  const char* value = std::getenv("SCADRAY_TEST_FULL");
  return value != nullptr && std::string_view(value) == "1";
}

}  // namespace test_support
