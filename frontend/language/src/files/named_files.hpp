// The files that a design names besides its sources: by import(), surface(), extrusions of files,
// dxf_dim() and dxf_cross().
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "messages/messages.hpp"

namespace language {

struct NamedFile {
  std::string path;    // as the .csg names it: relative to the main file's folder
  std::string opened;  // as OpenSCAD opens it: a folder and the name
  bool exists = false;
  int64_t timestamp = 0;  // when it was changed last, in whole seconds; 0: it is not there
  int64_t size = 0;       // bytes
};

/// Finds those of one evaluation, and notes what was looked at.
class NamedFiles {
 public:
  /// The main file's folder is absolute. `sources` are given where files are looked for beside the
  /// file that has the call; else beside the unit's.
  NamedFiles(Messages& messages, std::string main_folder, const SourceFiles* sources)
      : messages_(messages),
        main_folder_(std::move(main_folder)),
        unit_folder_(main_folder_),
        sources_(sources) {}

  /// Sets the folder of the main or used file whose code is being evaluated.
  void set_unit_folder(std::string_view folder) { unit_folder_ = folder; }

  /// Finds a file for a call in the folder of its code, else in the main file's. An empty name is
  /// no file.
  NamedFile find(const std::string& name, Place call);

  /// Absolute paths of the files that were named: those that are there, and those that were tried
  /// and are not.
  const std::vector<std::string>& files_read() const { return files_read_; }
  const std::vector<std::string>& lookups() const { return lookups_; }
  /// Returns how often a file has been looked for.
  size_t finds() const { return finds_; }

 private:
  std::string path_of(const std::string& name, Place call);
  std::string folder_of(Place call) const;

  Messages& messages_;
  std::string main_folder_;
  std::string unit_folder_;
  const SourceFiles* sources_;
  std::vector<std::string> files_read_;
  std::vector<std::string> lookups_;
  size_t finds_ = 0;
};

}  // namespace language
