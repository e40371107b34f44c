// The outlines of a design's files, and what names mean across them.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "language/file_signature.hpp"
#include "outline.hpp"
#include "workspace.hpp"

namespace serve {

/// A file, as it is open or as it was read.
struct Source {
  std::string key;   // TextOverlay::key_of its path
  std::string path;  // as it was found; "-": none
  Outline outline;
};
using SourcePointer = std::shared_ptr<const Source>;

/// A definition in a file.
struct Found {
  SourcePointer source;
  uint32_t definition;

  const Definition& operator*() const { return source->outline.definitions[definition]; }
  const Definition* operator->() const { return &**this; }
};

/// A part of a file.
struct PlaceInSource {
  SourcePointer source;
  Span span;
};

/// Belongs to one thread.
class Sources {
 public:
  explicit Sources(const Workspace& workspace) : workspace_(workspace) {}

  /// To be called when an open text has changed; `are_files_new`: or a file, or what is open.
  void invalidate(bool are_files_new);
  /// Folders whose files are looked through for references.
  void set_folders(std::vector<std::string> folders) { folders_ = std::move(folders); }

  /// Returns an open document's source; null: none is open with that key.
  SourcePointer of_document(const std::string& key);
  /// Returns a file's; null: it cannot be read, or is larger than a design.
  SourcePointer of_file(const std::string& path);
  /// Returns whether a source is open, or lies in one of the folders.
  bool is_editable(const Source& source) const;

  /// Returns the path of a file that a source names; "": there is none.
  std::string find_file(const Source& source, std::string_view name) const;
  /// Returns the folders in which names of a source's files are looked for.
  std::vector<std::string> search_folders(const Source& source) const;

  /// A source, with all whose text stands in it: those that it includes, and so on. Itself first.
  const std::vector<SourcePointer>& included(const SourcePointer& source);
  /// The files whose functions and modules it can call by `use`.
  const std::vector<SourcePointer>& used(const SourcePointer& source);

  /// Finds what a name means at the top level of a source: what it has itself, includes, uses; or
  /// what an open document has that includes it.
  std::optional<Found> find(const SourcePointer& source, NameSpace space, std::string_view name);
  /// Finds what a reference means; nothing: it is a builtin, or unknown.
  std::optional<Found> resolve(const SourcePointer& source, const Reference& reference);
  /// Finds what the name at an offset means.
  std::optional<Found> meaning_at(const SourcePointer& source, std::size_t offset);
  /// Returns all places where a definition's name stands, its definitions among them, in the open
  /// documents, in what they read, and in the folders.
  std::vector<PlaceInSource> occurrences(const Found& found);
  /// The same of a name with a `$`, which means the same wherever it stands.
  std::vector<PlaceInSource> dynamic_occurrences(std::string_view name);
  /// Returns whether two definitions are of the same thing.
  bool are_same(const Found& a, const Found& b);

 private:
  struct Link {
    bool is_use;
    std::string path, key;
  };
  struct Entry {
    SourcePointer source;
    language::FileSignature signature;
    bool is_checked = false;  // since the last change
  };

  SourcePointer of_file(const std::string& path, const std::string& key);
  const std::vector<Link>& links(const Source& source);
  std::optional<Found> find_in(const SourcePointer& source, NameSpace space, std::string_view name);
  std::vector<SourcePointer> known_sources();

  const Workspace& workspace_;
  std::vector<std::string> folders_;
  std::map<std::string, Entry> entries_;  // by key
  std::map<std::string, std::pair<SourcePointer, std::vector<Link>>> links_;
  std::map<std::string, std::vector<SourcePointer>> included_, used_;
};

}  // namespace serve
