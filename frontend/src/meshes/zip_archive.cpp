#include "meshes/zip_archive.hpp"

#include <minizip/unzip.h>

#include <algorithm>
#include <cstdint>
#include <cstring>

namespace frontend {
namespace {

constexpr uint64_t kMostGrowth = 64;
constexpr uint64_t kFreeBytes = uint64_t{64} << 20;

/// A file in memory, for minizip.
struct MemoryFile {
  std::string_view bytes;
  uint64_t position = 0;
};

MemoryFile& file_of(voidpf stream) { return *static_cast<MemoryFile*>(stream); }

voidpf open_file(voidpf file, const void*, int) { return file; }

uLong read_file(voidpf, voidpf stream, void* buffer, uLong size) {
  MemoryFile& file = file_of(stream);
  const uint64_t left = file.bytes.size() - std::min<uint64_t>(file.position, file.bytes.size());
  const uint64_t count = std::min<uint64_t>(size, left);
  if (count > 0) std::memcpy(buffer, file.bytes.data() + file.position, count);
  file.position += count;
  return count;
}

uLong write_file(voidpf, voidpf, const void*, uLong) { return 0; }

ZPOS64_T tell(voidpf, voidpf stream) { return file_of(stream).position; }

long seek(voidpf, voidpf stream, ZPOS64_T offset, int origin) {
  MemoryFile& file = file_of(stream);
  const uint64_t base = origin == ZLIB_FILEFUNC_SEEK_SET   ? 0
                        : origin == ZLIB_FILEFUNC_SEEK_CUR ? file.position
                                                           : file.bytes.size();
  if (offset > file.bytes.size() - std::min<uint64_t>(base, file.bytes.size())) return -1;
  file.position = base + offset;
  return 0;
}

int close_file(voidpf, voidpf) { return 0; }
int has_error(voidpf, voidpf) { return 0; }

}  // namespace

struct ZipArchive::Impl {
  MemoryFile file;
  unzFile archive = nullptr;
};

ZipArchive::ZipArchive(std::string_view bytes) : impl_(std::make_unique<Impl>()) {
  impl_->file.bytes = bytes;
  zlib_filefunc64_def functions{open_file, read_file,  write_file, tell,
                                seek,      close_file, has_error,  &impl_->file};
  impl_->archive = unzOpen2_64("", &functions);
}

ZipArchive::~ZipArchive() {
  if (impl_->archive) unzClose(impl_->archive);
}

std::optional<std::string> ZipArchive::unpack_first() {
  if (!impl_->archive || unzGoToFirstFile(impl_->archive) != UNZ_OK) return std::nullopt;
  return unpack_current();
}

std::optional<std::string> ZipArchive::unpack(const std::string& name) {
  constexpr int kCaseSensitive = 1;
  if (!impl_->archive) return std::nullopt;
  if (unzLocateFile(impl_->archive, name.c_str(), kCaseSensitive) != UNZ_OK) return std::nullopt;
  return unpack_current();
}

std::optional<std::string> ZipArchive::unpack_current() {
  const unzFile archive = impl_->archive;
  unz_file_info64 info;
  if (unzGetCurrentFileInfo64(archive, &info, nullptr, 0, nullptr, 0, nullptr, 0) != UNZ_OK) {
    return std::nullopt;
  }
  const uint64_t packed = std::min<uint64_t>(info.compressed_size, impl_->file.bytes.size());
  if (info.uncompressed_size > kFreeBytes + kMostGrowth * packed) return std::nullopt;
  if (unzOpenCurrentFile(archive) != UNZ_OK) return std::nullopt;
  // One byte more, so that the end shows.
  std::string bytes(info.uncompressed_size + 1, '\0');
  size_t size = 0;
  int count = 0;
  do {
    constexpr size_t kAtOnce = size_t{1} << 20;
    const auto wanted = static_cast<unsigned>(std::min(bytes.size() - size, kAtOnce));
    count = unzReadCurrentFile(archive, bytes.data() + size, wanted);
    if (count > 0) size += static_cast<size_t>(count);
  } while (count > 0 && size < bytes.size());
  // Closing tells whether the checksum is right.
  const bool is_whole = unzCloseCurrentFile(archive) == UNZ_OK;
  if (count < 0 || !is_whole || size != info.uncompressed_size) return std::nullopt;
  bytes.resize(size);
  return bytes;
}

}  // namespace frontend
