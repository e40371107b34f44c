// The files within a zip archive.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace frontend {

class ZipArchive {
 public:
  struct Entry {
    std::string_view name;
    uint64_t offset;  // of its local header
    uint64_t packed_bytes, bytes;
    uint32_t checksum;
    uint16_t method;
  };

  /// Lists the archive's files, none if it is damaged. `bytes` must outlive this.
  explicit ZipArchive(std::string_view bytes);

  static bool is_one(std::string_view bytes) { return bytes.starts_with("PK\x03\x04"); }

  const std::vector<Entry>& entries() const { return entries_; }
  /// Returns the contents of a file; nothing if it is damaged, packed in another way than by
  /// deflate, or unpacks to more than 64 times its size and 64 MiB.
  std::optional<std::string> unpack(const Entry& entry) const;

 private:
  std::string_view bytes_;
  std::vector<Entry> entries_;
};

}  // namespace frontend
