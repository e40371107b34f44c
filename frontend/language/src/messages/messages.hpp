// What an evaluation says: OpenSCAD's messages, in order, with its suppression of repeats.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "language/message_group.hpp"
#include "language/source_files.hpp"

namespace language {

/// Returns the word that lines of the group begin with: "WARNING"; empty: none.
std::string_view name_of(MessageGroup group);

struct Message {
  MessageGroup group;
  std::string text;  // without group and place
  Place place;       // of its cause; kNoFile: none is known
  std::string line;  // as OpenSCAD prints it: "WARNING: … in file x.scad, line 3"
};

/// The folder that a message's path is relative to (LANGUAGE.md, "Messages").
enum class PathBase : uint8_t { kMainFile, kUnit };

class Messages {
 public:
  using Sink = std::function<void(const Message&)>;
  Messages(const SourceFiles& files, Sink sink);

  /// Sets the main file, and the absolute folder that its path was given with, or that paths are
  /// shown from. While a used file is parsed, the file that uses it counts as the main file.
  void set_main_file(FileId file, std::string folder);
  FileId main_file() const { return main_file_; }
  /// Sets the absolute folder of the unit whose code is being evaluated.
  void set_unit_folder(std::string_view folder);

  /// Says a message unless it is a repeat that OpenSCAD drops (LANGUAGE.md, "Messages").
  void say(MessageGroup group, std::string text);
  void say(MessageGroup group, std::string text, Place place, PathBase base);
  void warn(std::string text, Place place = {}, PathBase base = PathBase::kMainFile) {
    say(MessageGroup::kWarning, std::move(text), place, base);
  }
  /// Says something of a place that the line does not name.
  void say_without_place(MessageGroup group, std::string text, Place place) {
    say(group, std::move(text), place, std::string());
  }

  /// Says an error of the parser, whose lines are counted differently, and whose path is relative
  /// to the folder where the program was started.
  void say_parser_error(std::string text, Place place, uint32_t line);

  /// Returns a file's path relative to a folder, as messages show it.
  std::string shown_path(FileId file, PathBase base) const;
  /// Returns " in file ‹path›, line ‹n›".
  std::string place_suffix(Place place, PathBase base) const;
  /// Returns how many warnings were made, dropped ones too: --hardwarnings stops at the first.
  size_t warnings() const { return warnings_; }
  /// Returns how many messages were made, dropped ones too.
  size_t said() const { return said_; }

 private:
  bool is_repeat(const Message& message);
  void say(MessageGroup group, std::string text, Place place, const std::string& suffix);
  std::string relative_path(FileId file, const std::string& folder) const;
  const std::string& canonical_path(FileId file) const;

  const SourceFiles& files_;
  Sink sink_;
  std::string start_folder_;
  FileId main_file_ = kNoFile;
  std::string main_folder_;
  std::string unit_folder_;
  mutable std::unordered_map<FileId, std::string> canonical_paths_;
  std::deque<std::string> last_lines_;            // the last five of ERROR, WARNING and TRACE
  std::unordered_set<std::string> deprecations_;  // that were said
  size_t warnings_ = 0;
  size_t said_ = 0;
};

}  // namespace language
