// The files that designs include and use, kept between evaluations as long as they do not change.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/name_table.hpp"
#include "language/file_signature.hpp"
#include "syntax/kept_file.hpp"

namespace language {

class KeptSources {
 public:
  enum class Role : uint8_t { kIncluded, kUsed };  // a file in two roles counts as two files

  KeptSources();

  /// Identifiers of all that is kept; it begins with kFirstNames.
  NameTable names;

  /// To be called before the first file of an evaluation is opened. Forgets all files if the main
  /// file is another one, or is parsed with other definitions, as they bear on how others are read.
  void begin(const std::string& main_path, const std::vector<std::string>& definitions);
  /// Returns a file as it is now; null if it cannot be read, or is not regular. `text_of` makes the
  /// text of its bytes.
  std::shared_ptr<KeptFile> open(Role role, const std::string& path,
                                 const std::function<std::string(std::string bytes)>& text_of);
  /// To be called when all is parsed. Forgets the files that were not opened.
  void end();
  /// Returns how many names and paths are known, which only grows.
  size_t size() const { return names.size() + numbers_.size(); }

 private:
  struct Entry {
    std::shared_ptr<KeptFile> file;  // null: none is kept
    FileSignature signature;
    bool is_open = false;
  };

  std::string main_path_;
  std::vector<std::string> definitions_;
  std::map<std::pair<Role, std::string>, FileId> numbers_;
  std::vector<Entry> files_;  // by number; the first one, the main file, is never kept
  uint64_t versions_ = 0;
};

}  // namespace language
