// Writes zip archives.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace frontend {

/// A file of an archive.
struct ZippedFile {
  std::string_view name;
  std::string_view bytes;
};

/// Returns an archive of the files, compressed. It holds no time. Throws Error if it would have 4
/// GiB or more.
std::string zip_of(std::span<const ZippedFile> files);

}  // namespace frontend
