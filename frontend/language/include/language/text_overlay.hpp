// Texts of files that an editor has not saved.
#pragma once

#include <map>
#include <memory>
#include <string>

namespace language {

/// Texts that are read in place of those of files, which need not exist. Everything that reads the
/// sources of a design asks here first.
class TextOverlay {
 public:
  using Text = std::shared_ptr<const std::string>;

  /// Returns the name under which a file's text is kept: its absolute path, without dots and links.
  static std::string key_of(const std::string& path);

  void set(const std::string& path, Text text) { texts_[key_of(path)] = std::move(text); }
  void erase(const std::string& path) { texts_.erase(key_of(path)); }
  /// Returns the text of a file; null if it is to be read.
  Text find(const std::string& path) const {
    if (texts_.empty()) return nullptr;
    const auto found = texts_.find(key_of(path));
    return found == texts_.end() ? nullptr : found->second;
  }

 private:
  std::map<std::string, Text> texts_;
};

}  // namespace language
