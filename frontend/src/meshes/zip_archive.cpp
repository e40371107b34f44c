#include "meshes/zip_archive.hpp"

#include <isa-l/crc.h>
#include <isa-l/igzip_lib.h>

#include <algorithm>
#include <cstdint>
#include <memory>

namespace frontend {
namespace {

constexpr uint64_t kMostGrowth = 64;
constexpr uint64_t kFreeBytes = uint64_t{64} << 20;

/// The records of an archive (PKWARE's APPNOTE 6.3, §4.3). Each begins with a signature, and has
/// these bytes before its names and comments.
constexpr std::string_view kLocalHeader = "PK\x03\x04", kEntry = "PK\x01\x02", kEnd = "PK\x05\x06",
                           kEnd64 = "PK\x06\x06", kLocator64 = "PK\x06\x07";
constexpr size_t kLocalBytes = 30, kEntryBytes = 46, kEndBytes = 22, kEnd64Bytes = 56,
                 kLocatorBytes = 20;
constexpr size_t kMostComment = 0xFFFF;  // bytes behind the end record

/// A number of 32 bits that stands elsewhere, in 64 (ZIP64).
constexpr uint64_t kIn64Bits = 0xFFFFFFFFu;

/// Returns the whole number of `size` bytes at `at`, the lowest first. They must be there.
uint64_t zip_number(std::string_view bytes, size_t at, size_t size) {
  uint64_t result = 0;
  for (size_t i = size; i-- > 0;) {
    result = result << 8 | static_cast<unsigned char>(bytes[at + i]);
  }
  return result;
}

/// Returns the record at `at`, and what follows it; empty if there is none.
std::string_view zip_record(std::string_view bytes, uint64_t at, std::string_view signature,
                            size_t size) {
  if (at > bytes.size() || bytes.size() - at < size) return {};
  const std::string_view found = bytes.substr(at);
  return found.starts_with(signature) ? found : std::string_view();
}

/// Reads the numbers that are elsewhere, in their order, from an entry's extra fields.
bool read_zip64(std::string_view extra, std::initializer_list<uint64_t*> numbers) {
  constexpr uint64_t kZip64 = 1;
  while (extra.size() >= 4) {
    const uint64_t id = zip_number(extra, 0, 2), size = zip_number(extra, 2, 2);
    std::string_view field = extra.substr(4, size);
    if (field.size() < size) return false;
    extra.remove_prefix(4 + size);
    if (id != kZip64) continue;
    for (uint64_t* const value : numbers) {
      if (*value != kIn64Bits) continue;
      if (field.size() < 8) return false;
      *value = zip_number(field, 0, 8);
      field.remove_prefix(8);
    }
    return true;
  }
  return std::ranges::all_of(numbers, [](const uint64_t* n) { return *n != kIn64Bits; });
}

std::optional<std::string> inflated(std::string_view packed, uint64_t size) {
  const auto state = std::make_unique_for_overwrite<inflate_state>();
  isal_inflate_init(state.get());
  std::string bytes(size, '\0');
  // ISA-L counts in 32 bits, which hold the most that is unpacked: the caller sees to that.
  state->next_in = reinterpret_cast<uint8_t*>(const_cast<char*>(packed.data()));
  state->avail_in = static_cast<uint32_t>(packed.size());
  state->next_out = reinterpret_cast<uint8_t*>(bytes.data());
  state->avail_out = static_cast<uint32_t>(bytes.size());
  if (isal_inflate_stateless(state.get()) != ISAL_DECOMP_OK) return std::nullopt;
  if (state->total_out != size) return std::nullopt;
  return bytes;
}

}  // namespace

ZipArchive::ZipArchive(std::string_view bytes) {
  const std::string_view tail =
      bytes.substr(bytes.size() - std::min(bytes.size(), kEndBytes + kMostComment));
  const size_t found = tail.rfind(kEnd);
  if (found == std::string_view::npos) return;
  uint64_t end_at = bytes.size() - tail.size() + found;
  const std::string_view end = zip_record(bytes, end_at, kEnd, kEndBytes);
  if (end.empty()) return;
  uint64_t size = zip_number(end, 12, 4), offset = zip_number(end, 16, 4);
  if (const std::string_view locator =
          end_at < kLocatorBytes
              ? std::string_view()
              : zip_record(bytes, end_at - kLocatorBytes, kLocator64, kLocatorBytes);
      !locator.empty()) {
    const uint64_t end64_at = zip_number(locator, 8, 8);
    const std::string_view end64 = zip_record(bytes, end64_at, kEnd64, kEnd64Bytes);
    if (end64.empty()) return;
    end_at = end64_at;
    size = zip_number(end64, 40, 8);
    offset = zip_number(end64, 48, 8);
  }
  // Something may stand before the archive, which counts from its own beginning.
  if (size > end_at || offset > end_at - size) return;
  archive_ = bytes.substr(end_at - size - offset);
  read_entries(archive_.substr(offset, size));
}

void ZipArchive::read_entries(std::string_view directory) {
  for (std::string_view at; !(at = zip_record(directory, 0, kEntry, kEntryBytes)).empty();) {
    const size_t name = zip_number(at, 28, 2), extra = zip_number(at, 30, 2),
                 comment = zip_number(at, 32, 2);
    if (at.size() - kEntryBytes < name + extra + comment) return;
    Entry entry{at.substr(kEntryBytes, name), zip_number(at, 8, 2),  zip_number(at, 10, 2),
                zip_number(at, 16, 4),        zip_number(at, 20, 4), zip_number(at, 24, 4),
                zip_number(at, 42, 4)};
    if (!read_zip64(at.substr(kEntryBytes + name, extra),
                    {&entry.size, &entry.packed_size, &entry.offset})) {
      return;
    }
    entries_.push_back(entry);
    directory.remove_prefix(kEntryBytes + name + extra + comment);
  }
}

std::optional<std::string> ZipArchive::unpack_first() const {
  return entries_.empty() ? std::nullopt : unpack(entries_.front());
}

std::optional<std::string> ZipArchive::unpack(std::string_view name, size_t most_bytes) const {
  const auto entry = std::ranges::find(entries_, name, &Entry::name);
  if (entry == entries_.end() || entry->size > most_bytes) return std::nullopt;
  return unpack(*entry);
}

std::optional<std::string> ZipArchive::unpack(const Entry& entry) const {
  constexpr uint64_t kEncrypted = 1, kStored = 0, kDeflated = 8;
  const std::string_view header = zip_record(archive_, entry.offset, kLocalHeader, kLocalBytes);
  if (header.empty() || (entry.flags & kEncrypted) != 0) return std::nullopt;
  const size_t begin = kLocalBytes + zip_number(header, 26, 2) + zip_number(header, 28, 2);
  if (begin > header.size() || entry.packed_size > header.size() - begin) return std::nullopt;
  const std::string_view packed = header.substr(begin, entry.packed_size);
  constexpr uint64_t kMost = 0xFFFFFFFFu;
  if (entry.size > std::min(kMost, kFreeBytes + kMostGrowth * packed.size())) return std::nullopt;
  if (packed.size() > kMost) return std::nullopt;
  std::optional<std::string> bytes;
  if (entry.method == kDeflated) bytes = inflated(packed, entry.size);
  if (entry.method == kStored && packed.size() == entry.size) bytes = packed;
  if (!bytes) return std::nullopt;
  const auto* const data = reinterpret_cast<const unsigned char*>(bytes->data());
  if (crc32_gzip_refl(0, data, bytes->size()) != entry.checksum) return std::nullopt;
  return bytes;
}

}  // namespace frontend
