#include "base/name_table.hpp"

#include <cstring>

namespace language {

namespace {

/// Mixes eight bytes at a time: names are short, and a table this small needs no stronger hash.
uint32_t hash_of(std::string_view text) {
  constexpr uint64_t kFactor = 0x9E3779B97F4A7C15u;  // 2^64 divided by the golden ratio
  uint64_t hash = text.size();
  while (!text.empty()) {
    const size_t count = text.size() < 8 ? text.size() : 8;
    uint64_t word = 0;
    std::memcpy(&word, text.data(), count);
    hash = (hash ^ word) * kFactor;
    hash ^= hash >> 32;
    text.remove_prefix(count);
  }
  return static_cast<uint32_t>(hash);
}

}  // namespace

/// Returns the slot that holds a text, or the free one where it belongs.
size_t NameTable::slot_of(std::string_view text, uint32_t hash) const {
  const size_t mask = slots_.size() - 1;
  size_t slot = hash & mask;
  while (slots_[slot].name != kNoName &&
         (slots_[slot].hash != hash || texts_[slots_[slot].name] != text)) {
    slot = (slot + 1) & mask;
  }
  return slot;
}

void NameTable::grow() {
  std::vector<Slot> old(2 * slots_.size());
  old.swap(slots_);
  const size_t mask = slots_.size() - 1;
  for (const Slot& slot : old) {
    if (slot.name == kNoName) continue;
    size_t free = slot.hash & mask;
    while (slots_[free].name != kNoName) free = (free + 1) & mask;
    slots_[free] = slot;
  }
}

Name NameTable::intern(std::string_view text) {
  const uint32_t hash = hash_of(text);
  size_t slot = slot_of(text, hash);
  if (slots_[slot].name != kNoName) return slots_[slot].name;
  if (2 * texts_.size() >= slots_.size()) {
    grow();
    slot = slot_of(text, hash);
  }
  const auto name = static_cast<Name>(texts_.size());
  texts_.emplace_back(text);
  slots_[slot] = {hash, name};
  return name;
}

Name NameTable::find(std::string_view text) const {
  return slots_[slot_of(text, hash_of(text))].name;
}

}  // namespace language
