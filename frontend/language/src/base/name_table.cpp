#include "base/name_table.hpp"

#include <cstring>

namespace language {

namespace {

constexpr size_t kHashedBytes = 8;  // whose hash and size tell the text

template <typename Word>
uint64_t word_at(const char* bytes) {
  Word word;
  std::memcpy(&word, bytes, sizeof word);
  return word;
}

/// Returns a number in which each byte of a text of at most eight bytes counts. (To copy a varying
/// number of bytes would take a call.)
inline uint64_t short_word(std::string_view text) {
  const size_t size = text.size();
  const char* const bytes = text.data();
  if (size >= 4) return word_at<uint32_t>(bytes) | word_at<uint32_t>(bytes + size - 4) << 32;
  if (size >= 2) return word_at<uint16_t>(bytes) | word_at<uint16_t>(bytes + size - 2) << 16;
  return size == 1 ? word_at<uint8_t>(bytes) : 0;
}

/// Mixes eight bytes at a time: names are short, and a table this small needs no stronger hash.
/// Texts of one size, of at most eight bytes, have one hash each: every step can be undone.
inline uint64_t hash_of(std::string_view text) {
  uint64_t hash = text.size();
  for (; text.size() > kHashedBytes; text.remove_prefix(kHashedBytes))
    hash = mix_hash(hash, word_at<uint64_t>(text.data()));
  return mix_hash(hash, short_word(text));
}

}  // namespace

/// Returns the slot that holds a text, or the free one where it belongs.
inline size_t NameTable::slot_of(std::string_view text, uint64_t hash) const {
  const size_t mask = slots_.size() - 1;
  size_t number = hash & mask;
  for (;; number = (number + 1) & mask) {
    const Slot& slot = slots_[number];
    if (slot.name == kNoName) return number;
    if (slot.hash != hash || slot.size != text.size()) continue;
    if (text.size() <= kHashedBytes || texts_[slot.name] == text) return number;
  }
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

Name NameTable::add(std::string_view text, uint64_t hash) {
  if (2 * texts_.size() >= slots_.size()) grow();
  Slot& slot = slots_[slot_of(text, hash)];
  const auto name = static_cast<Name>(texts_.size());
  texts_.emplace_back(text);
  slot = {hash, static_cast<uint32_t>(text.size()), name};
  return name;
}

Name NameTable::intern(std::string_view text) {
  const uint64_t hash = hash_of(text);
  const Slot& first = slots_[hash & (slots_.size() - 1)];  // where most names are found
  const bool is_found = first.hash == hash && first.size == text.size();
  return is_found && text.size() <= kHashedBytes ? first.name : intern_hashed(text, hash);
}

Name NameTable::intern_hashed(std::string_view text, uint64_t hash) {
  const Name known = slots_[slot_of(text, hash)].name;
  return known != kNoName ? known : add(text, hash);
}

Name NameTable::find(std::string_view text) const {
  return slots_[slot_of(text, hash_of(text))].name;
}

}  // namespace language
