// Hashes that tell large contents apart.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <string_view>

namespace frontend {

/// Two hashes of a sequence of words.
class Hashes {
 public:
  void add(uint64_t word) {
    first_ = (std::rotl(first_, 23) ^ word) * 0x9E3779B97F4A7C15u;
    second_ = (std::rotl(second_, 29) + word) * 0xD6E8FEB86659FD93u;
    second_ ^= second_ >> 32;
  }
  /// Adds the bytes and their number.
  void add(std::string_view bytes) {
    add(bytes.size());
    for (; bytes.size() >= sizeof(uint64_t); bytes.remove_prefix(sizeof(uint64_t))) {
      uint64_t word;
      std::memcpy(&word, bytes.data(), sizeof word);
      add(word);
    }
    uint64_t rest = 0;
    std::copy(bytes.begin(), bytes.end(), reinterpret_cast<char*>(&rest));
    add(rest);
  }
  uint64_t first() const { return first_; }
  uint64_t second() const { return second_; }

 private:
  uint64_t first_ = 1, second_ = 2;
};

}  // namespace frontend
