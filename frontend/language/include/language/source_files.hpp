// The texts of a design's files, and where their lines begin.
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

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

class SourceFile {
 public:
  /// `path` is absolute, as it was given or found, and "<stdin>" for the standard input.
  /// `text` is that of the file; of the main file and of used ones with what OpenSCAD appends (0x03
  /// and -D).
  SourceFile(std::string file_path, std::string file_text)
      : path(std::move(file_path)), owned_text_(std::move(file_text)), text(owned_text_) {}
  /// The same of a text in memory that somebody else shares. A path that is not absolute is a name.
  SourceFile(std::string file_path, std::shared_ptr<const char[]> bytes, std::size_t size)
      : path(std::move(file_path)),
        shared_text_(std::move(bytes)),
        text(shared_text_.get(), size) {}
  SourceFile(const SourceFile&) = delete;
  SourceFile& operator=(const SourceFile&) = delete;

  const std::string path;

 private:
  const std::string owned_text_;
  const std::shared_ptr<const char[]> shared_text_;

 public:
  const std::string_view text;

  /// Returns the path without links and dots on the way to the file, which may be a link itself.
  std::string canonical_path() const;
  /// Returns where lines begin as editors count them: 0, and after each LF. They are found at the
  /// first call, since most files get none. Several threads may call this.
  const std::vector<uint32_t>& line_starts() const;
  /// Returns the line that OpenSCAD's messages name for an offset, from 1. They count the CRs in
  /// code, too, and leave out the LFs in paths; the lexer has told which those are.
  uint32_t message_line(uint32_t offset) const;
  /// Tells of a CR or an LF that messages count unlike editors. They must come in order; what
  /// stands before the last one is known, and ignored.
  void note_counted_return(uint32_t offset) { note(counted_returns_, offset); }
  void note_uncounted_feed(uint32_t offset) { note(uncounted_feeds_, offset); }

 private:
  static void note(std::vector<uint32_t>& offsets, uint32_t offset) {
    if (offsets.empty() || offsets.back() < offset) offsets.push_back(offset);
  }

  std::vector<uint32_t> counted_returns_, uncounted_feeds_;  // offsets, in order
  mutable std::once_flag has_line_starts_;
  mutable std::vector<uint32_t> line_starts_;
};

/// The source files of one evaluation. A file that is read twice (included twice) is stored once.
/// Evaluations of one EvaluationCache share the files that have not changed.
class SourceFiles {
 public:
  FileId add(std::string path, std::string text);
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
  uint32_t message_line(Place place) const {
    return files_[place.file]->message_line(place.offset);
  }
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
