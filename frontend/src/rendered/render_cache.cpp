#include "rendered/render_cache.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <filesystem>
#include <span>
#include <system_error>
#include <vector>

#include "base/hashes.hpp"
#include "frontend/error.hpp"
#include "frontend/files.hpp"

namespace frontend {
namespace {

namespace fs = std::filesystem;

/// A file begins with this, and ends with the first hash of all before. Between them are the key,
/// and the lists of RingedFaces, each after its length, in the machine's own form.
constexpr std::string_view kMagic = "scadray 1 rendered\n";
constexpr std::string_view kSuffix = ".rendered";

/// What a program that was killed may have left (write_outputs()), once it is this old.
constexpr std::string_view kUnfinishedPrefix = ".scadray-";
constexpr std::chrono::hours kUnfinishedAge{1};

std::string cache_folder() {
  const auto variable = [](const char* name) {
    const char* const value = std::getenv(name);
    return fs::path(value != nullptr ? value : "");
  };
  // The XDG specification wants relative paths to be ignored.
  if (const fs::path cache = variable("XDG_CACHE_HOME"); cache.is_absolute()) {
    return (cache / "scadray").string();
  }
  const fs::path home = variable("HOME");
  return home.is_absolute() ? (home / ".cache" / "scadray").string() : std::string();
}

uint64_t hash_of(std::string_view bytes) {
  Hashes hashes;
  hashes.add(bytes);
  return hashes.first();
}

template <typename Element>
void put(std::string& bytes, std::span<const Element> elements) {
  const uint64_t count = elements.size();
  bytes.append(reinterpret_cast<const char*>(&count), sizeof count);
  bytes.append(reinterpret_cast<const char*>(elements.data()), elements.size_bytes());
}

/// Takes a list from the front of the bytes. Returns false if they are too few.
template <typename List>
bool take(std::string_view& bytes, List& list) {
  using Element = typename List::value_type;
  uint64_t count = 0;
  if (bytes.size() < sizeof count) return false;
  std::memcpy(&count, bytes.data(), sizeof count);
  bytes.remove_prefix(sizeof count);
  if (count > bytes.size() / sizeof(Element)) return false;
  list.resize(count);
  if (count > 0) std::memcpy(list.data(), bytes.data(), count * sizeof(Element));
  bytes.remove_prefix(count * sizeof(Element));
  return true;
}

std::string bytes_of(std::string_view key, const RingedFaces& faces) {
  std::string bytes(kMagic);
  put(bytes, std::span(key));
  put(bytes, std::span(faces.points));
  put(bytes, std::span(faces.corners));
  put(bytes, std::span(faces.ring_ends));
  put(bytes, std::span(faces.face_ends));
  const uint64_t hash = hash_of(bytes);
  bytes.append(reinterpret_cast<const char*>(&hash), sizeof hash);
  return bytes;
}

bool are_ends(std::span<const uint32_t> ends, size_t count) {
  return std::ranges::is_sorted(ends) && (ends.empty() ? count == 0 : ends.back() == count);
}

/// Whether all indices are in their ranges, whoever has written the file.
bool is_valid(const RingedFaces& faces) {
  return are_ends(faces.ring_ends, faces.corners.size()) &&
         are_ends(faces.face_ends, faces.ring_ends.size()) &&
         std::ranges::all_of(faces.corners,
                             [&](uint32_t corner) { return corner < faces.points.size(); });
}

/// Returns nothing if the bytes are not those of this key.
std::optional<RingedFaces> faces_of(std::string_view bytes, std::string_view key) {
  uint64_t hash = 0;
  if (!bytes.starts_with(kMagic) || bytes.size() < kMagic.size() + sizeof hash) return {};
  std::memcpy(&hash, bytes.data() + bytes.size() - sizeof hash, sizeof hash);
  bytes.remove_suffix(sizeof hash);
  if (hash_of(bytes) != hash) return std::nullopt;
  bytes.remove_prefix(kMagic.size());
  std::string found_key;
  RingedFaces faces;
  const bool is_read = take(bytes, found_key) && take(bytes, faces.points) &&
                       take(bytes, faces.corners) && take(bytes, faces.ring_ends) &&
                       take(bytes, faces.face_ends) && bytes.empty();
  if (!is_read || found_key != key || !is_valid(faces)) return std::nullopt;
  return faces;
}

struct CacheFile {
  fs::path path;
  fs::file_time_type used;
  uint64_t bytes;
};

}  // namespace

RenderCache::RenderCache(uint64_t most_bytes) : folder_(cache_folder()), most_bytes_(most_bytes) {}

std::string RenderCache::path_of(std::string_view key) const {
  Hashes hashes;
  hashes.add(key);
  std::string name;
  for (const uint64_t hash : {hashes.first(), hashes.second()}) {
    std::array<char, 16> digits;
    const char* const end =
        std::to_chars(digits.data(), digits.data() + digits.size(), hash, 16).ptr;
    name.append(digits.size() - static_cast<size_t>(end - digits.data()), '0');
    name.append(std::string_view(digits.data(), static_cast<size_t>(end - digits.data())));
  }
  return folder_ + '/' + name.append(kSuffix);
}

std::optional<RingedFaces> RenderCache::find(std::string_view key) const {
  if (folder_.empty()) return std::nullopt;
  const std::string path = path_of(key);
  struct stat status {};
  // Another's file may be of any size, and a link may lead anywhere.
  if (lstat(path.c_str(), &status) != 0 || !S_ISREG(status.st_mode) ||
      static_cast<uint64_t>(status.st_size) > kMostBytesOfFile) {
    return std::nullopt;
  }
  try {
    std::optional<RingedFaces> faces = faces_of(read_regular_file(path).view(), key);
    if (faces) utimensat(AT_FDCWD, path.c_str(), nullptr, 0);  // it was used now
    return faces;
  } catch (const Error&) {
    return std::nullopt;
  }
}

void RenderCache::keep(std::string_view key, const RingedFaces& faces) const {
  if (folder_.empty()) return;
  if (!make_private_folder()) return;
  const std::string bytes = bytes_of(key, faces);
  if (bytes.size() > kMostBytesOfFile) return;
  try {
    const PendingOutput file{path_of(key), frontend::bytes_of(bytes)};
    // Outputs go where links lead; what is kept here does not.
    std::error_code failed;
    if (fs::is_symlink(fs::symlink_status(file.path, failed))) fs::remove(file.path);
    write_outputs({&file, 1});
    make_room();
  } catch (const std::exception&) {
    // The disk is full, or the folder is not ours: it will be rendered again.
  }
}

/// Makes the folder, if need be, and closes it to others: the files tell what their designs hold.
bool RenderCache::make_private_folder() const {
  std::error_code failed;
  fs::create_directories(fs::path(folder_).parent_path(), failed);
  if (failed) return false;
  if (mkdir(folder_.c_str(), S_IRWXU) != 0 && errno != EEXIST) return false;
  fs::permissions(folder_, fs::perms::owner_all, failed);
  return !failed;
}

void RenderCache::make_room() const {
  std::vector<CacheFile> files;
  uint64_t bytes = 0;
  std::error_code failed;
  for (fs::directory_iterator entry(folder_, failed), end; !failed && entry != end;
       entry.increment(failed)) {
    std::error_code gone;  // another program may have removed it
    CacheFile file{entry->path(), entry->last_write_time(gone), entry->file_size(gone)};
    if (gone) continue;
    const std::string name = file.path.filename().string();
    if (name.starts_with(kUnfinishedPrefix) &&
        fs::file_time_type::clock::now() - file.used > kUnfinishedAge) {
      fs::remove(file.path, gone);
    }
    if (!name.ends_with(kSuffix)) continue;
    bytes += file.bytes;
    files.push_back(std::move(file));
  }
  if (bytes <= most_bytes_) return;
  std::ranges::sort(files, {}, &CacheFile::used);
  for (const CacheFile& file : files) {
    if (bytes <= most_bytes_) break;
    std::error_code gone;
    fs::remove(file.path, gone);
    bytes -= file.bytes;
  }
}

}  // namespace frontend
