// The texts of a design's files, and where their lines begin.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "language/place.hpp"

namespace language {

struct SourceFile {
  std::string
      path;  // absolute and canonical where the file exists; "<stdin>" for the standard input
  std::string text;  // of the main file and of used ones with what OpenSCAD appends (0x03 and -D)
  /// Offsets at which lines begin, as OpenSCAD counts them in messages: after each CR and each LF
  /// in code, and after each LF in comments and strings. The lexer appends them. Line 1 begins at
  /// 0, which is not listed.
  std::vector<uint32_t> message_line_starts;
  /// The same as editors count: 0, and after each LF. SourceFiles fills it in.
  std::vector<uint32_t> line_starts{};
};

/// The source files of one evaluation. A file that is read twice (included twice) is stored once.
/// Evaluations of one EvaluationCache share the files that have not changed.
class SourceFiles {
 public:
  FileId add(SourceFile file);
  /// Stores a file under a number that it has in other evaluations, too. Numbers may be left out.
  void add(FileId number, std::shared_ptr<SourceFile> file);
  bool has(FileId file) const { return file < files_.size() && files_[file]; }
  SourceFile& operator[](FileId file) { return *files_[file]; }
  const SourceFile& operator[](FileId file) const { return *files_[file]; }
  /// One more than the greatest number.
  FileId size() const { return static_cast<FileId>(files_.size()); }
  /// The numbers of the files, in the order in which they were added.
  const std::vector<FileId>& order() const { return order_; }

  /// Returns the line that OpenSCAD's messages name for a place; lines count from 1.
  uint32_t message_line(Place place) const;
  /// Returns the line as editors count it: LF only, from 1.
  uint32_t line(Place place) const;
  /// Returns the column in bytes, from 1, of a place within its line().
  uint32_t column(Place place) const;

 private:
  /// The last line that begins at or before the place: where it begins, and its number less one.
  struct LineStart {
    uint32_t offset;
    uint32_t number;
  };
  LineStart line_start(Place place) const;

  std::vector<std::shared_ptr<SourceFile>> files_;  // null: a number that is left out
  std::vector<FileId> order_;
};

}  // namespace language
