// The files within a zip archive in memory, by minizip.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace frontend {

class ZipArchive {
 public:
  /// `bytes` must outlive this. A damaged archive has no files.
  explicit ZipArchive(std::string_view bytes);
  ~ZipArchive();
  ZipArchive(const ZipArchive&) = delete;
  ZipArchive& operator=(const ZipArchive&) = delete;

  static bool is_one(std::string_view bytes) { return bytes.starts_with("PK\x03\x04"); }

  /// These return the contents of the first file, or of that name; nothing if there is none, if it
  /// is damaged, or if it unpacks to more than 64 times its size and 64 MiB.
  std::optional<std::string> unpack_first();
  std::optional<std::string> unpack(const std::string& name);

 private:
  struct Impl;
  std::optional<std::string> unpack_current();

  std::unique_ptr<Impl> impl_;
};

}  // namespace frontend
