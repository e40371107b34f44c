// Numbers as integers, as the C casts of OpenSCAD on x86-64 convert them.
#pragma once

#include <cstdint>

namespace language {

/// Returns the low 32 bits of a number cut to an integer; 0 for what 64 bits cannot hold.
inline uint32_t low_bits(double number) {
  constexpr double kEnd = 9223372036854775808.0;
  if (!(number >= -kEnd && number < kEnd)) return 0;
  return static_cast<uint32_t>(static_cast<int64_t>(number));
}

}  // namespace language
