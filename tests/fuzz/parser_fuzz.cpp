// libFuzzer's entry: see CMakeLists.txt for how to build and run it.
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include "check_input.hpp"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const std::string fault = fuzz::fault_of({reinterpret_cast<const char*>(data), size});
  if (!fault.empty()) {
    std::fprintf(stderr, "%s\n", fault.c_str());
    std::abort();
  }
  return 0;
}
