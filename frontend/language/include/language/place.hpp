// A place in the source files of a design.
#pragma once

#include <cstdint>

namespace language {

/// Index of a file in SourceFiles.
using FileId = uint32_t;
constexpr FileId kNoFile = 0xFFFFFFFFu;

/// A byte of a source file. SourceFiles turns it into lines and columns.
struct Place {
  FileId file = kNoFile;
  uint32_t offset = 0;  // bytes from the file's start

  bool operator==(const Place&) const = default;
};

}  // namespace language
