// The files within a zip archive in memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace frontend {

class ZipArchive {
 public:
  /// `bytes` must outlive this. A damaged archive has no files, or those before the damage.
  explicit ZipArchive(std::string_view bytes);

  static bool is_one(std::string_view bytes) { return bytes.starts_with("PK\x03\x04"); }

  /// These return the contents of the first file, or of that name; nothing if there is none, if it
  /// is damaged or encrypted, or if it unpacks to more than 64 times its size and 64 MiB, or to
  /// more than `most_bytes`.
  std::optional<std::string> unpack_first() const;
  std::optional<std::string> unpack(std::string_view name,
                                    size_t most_bytes = std::numeric_limits<size_t>::max()) const;

 private:
  /// A file as the directory at the archive's end lists it.
  struct Entry {
    std::string_view name;
    uint64_t flags, method, checksum, packed_size, size;
    uint64_t offset;  // of its local header
  };
  void read_entries(std::string_view directory);
  std::optional<std::string> unpack(const Entry& entry) const;

  std::string_view archive_;
  std::vector<Entry> entries_;
};

}  // namespace frontend
