// Compile-time hash tables of the words a .csg is made of.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace language {

/// Finds a word's index in a fixed list. The hash combines the length and the first, middle and
/// last letters, by which the words that OpenSCAD writes seldom collide.
template <size_t kCount>
class WordTable {
 public:
  static constexpr uint8_t kNone = 255;
  static_assert(kCount < kNone);

  explicit consteval WordTable(const std::array<std::string_view, kCount>& names) : names_(names) {
    slots_.fill(kNone);
    for (size_t i = 0; i < kCount; ++i) {
      size_t slot = hash(names[i]);
      while (slots_[slot] != kNone) slot = (slot + 1) % kSlots;
      slots_[slot] = static_cast<uint8_t>(i);
    }
  }

  /// Returns the index of `word`, which must not be empty, or kNone.
  constexpr uint8_t find(std::string_view word) const {
    for (size_t slot = hash(word); slots_[slot] != kNone; slot = (slot + 1) % kSlots) {
      if (names_[slots_[slot]] == word) return slots_[slot];
    }
    return kNone;
  }

  constexpr std::string_view operator[](uint8_t index) const { return names_[index]; }
  static constexpr size_t size() { return kCount; }

 private:
  static constexpr size_t kSlots = 256;  // several times the words, so that most have their own

  static constexpr size_t hash(std::string_view word) {
    const auto at = [&](size_t i) { return static_cast<size_t>(static_cast<uint8_t>(word[i])); };
    return (word.size() * 5 + at(0) * 7 + at(word.size() - 1) * 3 + at(word.size() / 2) * 11) %
           kSlots;
  }

  std::array<std::string_view, kCount> names_;
  std::array<uint8_t, kSlots> slots_{};
};

template <size_t kCount>
WordTable(const std::array<std::string_view, kCount>&) -> WordTable<kCount>;

}  // namespace language
