// What openscad has rendered, kept on disk.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "meshes/face_set.hpp"

namespace frontend {

/// A folder of files, one for each key. Several programs may use it at once: a file appears whole,
/// under its final name, or not at all. What cannot be read or written counts as missing.
class RenderCache {
 public:
  /// The most bytes of the files together, and of one of them. The largest mesh that openscad makes
  /// in a minute has some 2 MB.
  static constexpr uint64_t kMostBytes = uint64_t{256} << 20;
  static constexpr uint64_t kMostBytesOfFile = kMostBytes / 8;

  /// The folder is scadray in $XDG_CACHE_HOME, or else in ~/.cache. Without $HOME nothing is kept.
  explicit RenderCache(uint64_t most_bytes = kMostBytes);

  std::optional<RingedFaces> find(std::string_view key) const;
  /// Makes room, where it is needed, by removing what was not used for the longest time.
  void keep(std::string_view key, const RingedFaces& faces) const;

 private:
  std::string path_of(std::string_view key) const;
  bool make_private_folder() const;
  void make_room() const;

  std::string folder_;  // empty: none
  uint64_t most_bytes_;
};

}  // namespace frontend
