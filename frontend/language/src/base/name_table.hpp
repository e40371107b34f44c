// Identifiers of a design, each stored once.
#pragma once

#include <cstdint>
#include <deque>
#include <string>
#include <string_view>
#include <vector>

namespace language {

/// An identifier; equal identifiers of one NameTable have equal numbers.
using Name = uint32_t;
constexpr Name kNoName = 0xFFFFFFFFu;

class NameTable {
 public:
  /// Returns the number of an identifier, which is stored at its first use. Numbers count from 0.
  Name intern(std::string_view text);
  /// Returns the number of an identifier that is stored, or kNoName.
  Name find(std::string_view text) const;
  /// Returns an identifier with its `$`, if it has one. The text stays where it is.
  std::string_view text(Name name) const { return texts_[name]; }
  /// Returns whether a name is looked up dynamically: whether it begins with `$`.
  bool is_dynamic(Name name) const { return texts_[name].front() == '$'; }
  size_t size() const { return texts_.size(); }

 private:
  struct Slot {
    uint64_t hash = 0;
    uint32_t size = 0;  // of the text
    Name name = kNoName;
  };

  size_t slot_of(std::string_view text, uint64_t hash) const;
  Name intern_hashed(std::string_view text, uint64_t hash);
  Name add(std::string_view text, uint64_t hash);
  void grow();

  std::deque<std::string> texts_;                     // a deque, whose elements do not move
  std::vector<Slot> slots_ = std::vector<Slot>(256);  // open addressing, at most half full
};

/// Makes a number count in a hash. For one number, different hashes stay different, and the other
/// way round: every step can be undone.
inline uint64_t mix_hash(uint64_t hash, uint64_t number) {
  constexpr uint64_t kFactor = 0x9E3779B97F4A7C15u;  // 2^64 divided by the golden ratio
  hash = (hash ^ number) * kFactor;
  return hash ^ hash >> 32;
}

}  // namespace language
