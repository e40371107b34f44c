#include "meshes/zip_archive.hpp"

#include <isa-l/crc.h>

#include <algorithm>

#include "meshes/inflate.hpp"

namespace frontend {
namespace {

// The fields of the format (APPNOTE.TXT, "ZIP File Format Specification", 4.3).
constexpr std::string_view kEndOfDirectory = "PK\x05\x06", kEndOfDirectory64 = "PK\x06\x06",
                           kLocator64 = "PK\x06\x07", kDirectoryEntry = "PK\x01\x02",
                           kLocalHeader = "PK\x03\x04";
constexpr size_t kEndBytes = 22, kLocatorBytes = 20, kEnd64Bytes = 56, kEntryBytes = 46,
                 kLocalBytes = 30;
constexpr size_t kLongestComment = 0xFFFF;
constexpr uint64_t kIn64 = 0xFFFFFFFFu;  // the number stands in the extra field
constexpr uint16_t kExtra64 = 1;
constexpr uint16_t kStored = 0, kDeflated = 8;

constexpr size_t kMostGrowth = 64;
constexpr size_t kFreeBytes = size_t{64} << 20;

/// Reads little-endian numbers, which are 0 beyond the end.
uint64_t number_at(std::string_view bytes, size_t offset, size_t size) {
  if (offset > bytes.size() || bytes.size() - offset < size) return 0;
  uint64_t value = 0;
  for (size_t i = size; i-- > 0;) {
    value = value << 8 | static_cast<unsigned char>(bytes[offset + i]);
  }
  return value;
}

std::string_view part_of(std::string_view bytes, uint64_t offset, uint64_t size) {
  if (offset > bytes.size() || size > bytes.size() - offset) return {};
  return bytes.substr(offset, size);
}

struct Directory {
  uint64_t offset = 0, entries = 0;
};

Directory find_directory(std::string_view bytes) {
  const size_t reach = std::min(bytes.size(), kEndBytes + kLongestComment);
  const size_t end = bytes.rfind(kEndOfDirectory);
  if (end == std::string_view::npos || bytes.size() - end > reach) return {};
  Directory result{number_at(bytes, end + 16, 4), number_at(bytes, end + 10, 2)};
  if (end < kLocatorBytes || part_of(bytes, end - kLocatorBytes, 4) != kLocator64) return result;
  const uint64_t end64 = number_at(bytes, end - kLocatorBytes + 8, 8);
  const std::string_view record = part_of(bytes, end64, kEnd64Bytes);
  if (!record.starts_with(kEndOfDirectory64)) return result;
  return {number_at(record, 48, 8), number_at(record, 32, 8)};
}

/// Takes the numbers that are too large for the entry's own fields.
void read_extra(std::string_view extra, ZipArchive::Entry& entry) {
  while (extra.size() >= 4) {
    const uint64_t size = number_at(extra, 2, 2);
    std::string_view field = part_of(extra, 4, size);
    if (number_at(extra, 0, 2) == kExtra64) {
      for (uint64_t* number : {&entry.bytes, &entry.packed_bytes, &entry.offset}) {
        if (*number != kIn64) continue;
        *number = number_at(field, 0, 8);
        field = field.substr(std::min<size_t>(field.size(), 8));
      }
    }
    extra.remove_prefix(std::min<size_t>(extra.size(), 4 + size));
  }
}

}  // namespace

ZipArchive::ZipArchive(std::string_view bytes) : bytes_(bytes) {
  Directory directory = find_directory(bytes);
  while (directory.entries-- > 0) {
    const std::string_view fixed = part_of(bytes, directory.offset, kEntryBytes);
    if (!fixed.starts_with(kDirectoryEntry)) return;
    const uint64_t name = number_at(fixed, 28, 2), extra = number_at(fixed, 30, 2),
                   comment = number_at(fixed, 32, 2);
    Entry entry{part_of(bytes, directory.offset + kEntryBytes, name),
                number_at(fixed, 42, 4),
                number_at(fixed, 20, 4),
                number_at(fixed, 24, 4),
                static_cast<uint32_t>(number_at(fixed, 16, 4)),
                static_cast<uint16_t>(number_at(fixed, 10, 2))};
    read_extra(part_of(bytes, directory.offset + kEntryBytes + name, extra), entry);
    entries_.push_back(entry);
    directory.offset += kEntryBytes + name + extra + comment;
  }
}

std::optional<std::string> ZipArchive::unpack(const Entry& entry) const {
  const std::string_view header = part_of(bytes_, entry.offset, kLocalBytes);
  if (!header.starts_with(kLocalHeader)) return std::nullopt;
  const uint64_t start =
      entry.offset + kLocalBytes + number_at(header, 26, 2) + number_at(header, 28, 2);
  const std::string_view packed = part_of(bytes_, start, entry.packed_bytes);
  if (packed.size() != entry.packed_bytes) return std::nullopt;
  if (entry.bytes > kFreeBytes + kMostGrowth * packed.size()) return std::nullopt;
  std::optional<std::string> result;
  if (entry.method == kStored) {
    result.emplace(packed);
  } else if (entry.method == kDeflated) {
    // One byte more, so that the end shows.
    result = inflate(packed, Wrapping::kNone, entry.bytes + 1);
  }
  if (!result || result->size() != entry.bytes) return std::nullopt;
  const uint32_t checksum =
      crc32_gzip_refl(0, reinterpret_cast<const unsigned char*>(result->data()), result->size());
  if (checksum != entry.checksum) return std::nullopt;
  return result;
}

}  // namespace frontend
