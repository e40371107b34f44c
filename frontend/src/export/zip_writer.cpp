#include "export/zip_writer.hpp"

#include <isa-l/crc.h>
#include <isa-l/igzip_lib.h>

#include <cstdint>
#include <limits>
#include <memory>

#include "frontend/error.hpp"

namespace frontend {
namespace {

[[noreturn]] void fail_as_too_large() {
  throw Error("", {}, "the archive would have 4 GiB or more", "export as .stl");
}

/// Returns the size as the archive has it: this writer has no ZIP64.
uint32_t zip_number_of(size_t size) {
  if (size >= std::numeric_limits<uint32_t>::max()) fail_as_too_large();
  return static_cast<uint32_t>(size);
}

std::string deflated(std::string_view bytes) {
  constexpr size_t kGrowth = size_t{1} << 16;
  const auto stream = std::make_unique_for_overwrite<isal_zstream>();
  const auto tables = std::make_unique_for_overwrite<uint8_t[]>(ISAL_DEF_LVL1_DEFAULT);
  isal_deflate_init(stream.get());
  stream->level = 1;
  stream->level_buf = tables.get();
  stream->level_buf_size = ISAL_DEF_LVL1_DEFAULT;
  stream->next_in = reinterpret_cast<uint8_t*>(const_cast<char*>(bytes.data()));
  stream->avail_in = zip_number_of(bytes.size());
  stream->end_of_stream = 1;
  std::string packed;
  do {
    const size_t filled = packed.size();
    packed.resize(filled + kGrowth);
    stream->next_out = reinterpret_cast<uint8_t*>(packed.data() + filled);
    stream->avail_out = kGrowth;
    if (isal_deflate(stream.get()) != COMP_OK) fail_as_too_large();
    packed.resize(filled + kGrowth - stream->avail_out);
  } while (stream->avail_out == 0);
  return packed;
}

/// Appends the lowest byte first.
void append_whole(std::string& bytes, uint64_t number, int size) {
  for (int i = 0; i < size; ++i, number >>= 8) bytes += static_cast<char>(number & 0xFF);
}

}  // namespace

std::string zip_of(std::span<const ZippedFile> files) {
  std::string archive, directory;
  for (const ZippedFile& file : files) {
    const std::string packed = deflated(file.bytes);
    std::string facts;  // which both headers of the file have (PKWARE's APPNOTE 6.3, §4.3)
    constexpr uint64_t kDeflated = 8, kFirstDay = 0x21;  // 1 January 1980
    append_whole(facts, 20, 2);                          // version needed
    append_whole(facts, 0, 2);                           // flags
    append_whole(facts, kDeflated, 2);
    append_whole(facts, 0, 2);  // time
    append_whole(facts, kFirstDay, 2);
    append_whole(facts,
                 crc32_gzip_refl(0, reinterpret_cast<const unsigned char*>(file.bytes.data()),
                                 file.bytes.size()),
                 4);
    append_whole(facts, zip_number_of(packed.size()), 4);
    append_whole(facts, zip_number_of(file.bytes.size()), 4);
    append_whole(facts, file.name.size(), 2);
    append_whole(facts, 0, 2);  // extra field
    directory += "PK\x01\x02";
    append_whole(directory, 20, 2);  // version made by
    directory += facts;
    append_whole(directory, 0, 10);  // comment, disk, attributes
    append_whole(directory, zip_number_of(archive.size()), 4);
    directory += file.name;
    archive += "PK\x03\x04";
    archive.append(facts).append(file.name).append(packed);
  }
  const uint32_t offset = zip_number_of(archive.size());
  archive += directory;
  archive += "PK\x05\x06";
  append_whole(archive, 0, 4);  // disks
  append_whole(archive, files.size(), 2);
  append_whole(archive, files.size(), 2);
  append_whole(archive, zip_number_of(directory.size()), 4);
  append_whole(archive, offset, 4);
  append_whole(archive, 0, 2);  // comment
  zip_number_of(archive.size());
  return archive;
}

}  // namespace frontend
