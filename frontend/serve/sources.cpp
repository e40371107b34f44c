#include "sources.hpp"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "base/read_file.hpp"
#include "syntax/program_reader.hpp"

namespace serve {
namespace {

namespace fs = std::filesystem;
using language::TextOverlay;

std::string folder_of(const Source& source) {
  std::error_code failed;
  return source.path == "-" ? fs::current_path(failed).string()
                            : fs::path(source.path).parent_path().string();
}

SourcePointer make_source(std::string key, std::string path, TextPointer text) {
  return std::make_shared<const Source>(
      Source{std::move(key), std::move(path), outline_of(std::move(text))});
}

NameSpace space_of(ReferenceKind kind) {
  return kind == ReferenceKind::kModule ? NameSpace::kModules : NameSpace::kVariables;
}

}  // namespace

void Sources::invalidate(bool are_files_new) {
  included_.clear();
  used_.clear();
  if (!are_files_new) return;
  links_.clear();
  for (auto& [key, entry] : entries_) entry.is_checked = false;
}

SourcePointer Sources::of_document(const std::string& key) {
  const DocumentPointer document = workspace_.find(key);
  if (!document) return nullptr;
  Entry& entry = entries_[key];
  if (!entry.source || entry.source->outline.text != document->text) {
    entry = {make_source(key, document->path, document->text), {}, false};
  }
  return entry.source;
}

SourcePointer Sources::of_file(const std::string& path) {
  return of_file(path, TextOverlay::key_of(path));
}

SourcePointer Sources::of_file(const std::string& path, const std::string& key) {
  constexpr std::size_t kMostBytes = std::size_t{64} << 20;
  if (SourcePointer open = of_document(key)) return open;
  Entry& entry = entries_[key];
  if (entry.is_checked) return entry.source;
  entry.is_checked = true;
  const language::FileSignature signature(path);
  if (entry.source && signature.has_bytes_of(entry.signature)) return entry.source;
  entry.signature = signature;
  auto bytes = language::read_regular_file(path);
  if (!bytes || bytes->size() > kMostBytes) {
    entry.source = nullptr;
  } else if (!entry.source || entry.source->outline.text->bytes() != *bytes) {
    entry.source = make_source(key, path, std::make_shared<const Text>(std::move(*bytes)));
  }
  return entry.source;
}

bool Sources::is_editable(const Source& source) const {
  return workspace_.find(source.key) || std::ranges::any_of(folders_, [&](const auto& folder) {
           return source.key.starts_with(TextOverlay::key_of(folder) + '/');
         });
}

std::string Sources::find_file(const Source& source, std::string_view name) const {
  std::vector<std::string> lookups;
  const auto overlay = workspace_.overlay();
  return language::LibrarySearch(lookups, overlay.get()).find(name, folder_of(source));
}

std::vector<std::string> Sources::search_folders(const Source& source) const {
  std::vector<std::string> lookups;
  std::vector<std::string> folders = language::LibrarySearch(lookups).library_folders();
  folders.insert(folders.begin(), folder_of(source));
  return folders;
}

const std::vector<Sources::Link>& Sources::links(const Source& source) {
  auto& [owner, links] = links_[source.key];
  if (owner.get() == &source) return links;
  links.clear();
  owner = entries_[source.key].source;
  for (const FileName& file : source.outline.files) {
    const std::string path = find_file(source, source.outline.text->at(file.path));
    if (!path.empty()) links.push_back({file.is_use, path, TextOverlay::key_of(path)});
  }
  return links;
}

const std::vector<SourcePointer>& Sources::included(const SourcePointer& source) {
  const auto [known, is_new] = included_.try_emplace(source->key);
  std::vector<SourcePointer>& all = known->second;
  if (!is_new && all.front() == source) return all;
  all = {source};
  std::set<std::string> keys{source->key};
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (const Link& link : std::vector<Link>(links(*all[i]))) {
      if (link.is_use) continue;
      const SourcePointer other = of_file(link.path, link.key);
      if (other && keys.insert(other->key).second) all.push_back(other);
    }
  }
  return all;
}

const std::vector<SourcePointer>& Sources::used(const SourcePointer& source) {
  const auto [known, is_new] = used_.try_emplace(source->key);
  std::vector<SourcePointer>& all = known->second;
  if (!is_new) return all;
  std::set<std::string> keys;
  const std::vector<SourcePointer> own = included(source);
  for (auto file = own.rbegin(); file != own.rend(); ++file) {
    const std::vector<Link> named = links(**file);
    for (auto link = named.rbegin(); link != named.rend(); ++link) {  // a later one wins
      const SourcePointer other = link->is_use ? of_file(link->path, link->key) : nullptr;
      if (!other) continue;
      for (const SourcePointer& part : included(other))
        if (keys.insert(part->key).second) all.push_back(part);
    }
  }
  return all;
}

std::optional<Found> Sources::find_in(const SourcePointer& source, NameSpace space,
                                      std::string_view name) {
  const auto look = [&](const std::vector<SourcePointer>& sources) -> std::optional<Found> {
    for (const SourcePointer& other : sources) {
      const uint32_t found = other->outline.find(space, name, 0, nullptr);
      if (found != kNone) return Found{other, found};
    }
    return std::nullopt;
  };
  if (auto found = look(included(source))) return found;
  return space == NameSpace::kVariables ? std::nullopt : look(used(source));
}

std::optional<Found> Sources::find(const SourcePointer& source, NameSpace space,
                                   std::string_view name) {
  if (auto found = find_in(source, space, name)) return found;
  for (const DocumentPointer& document : workspace_.documents()) {
    if (document->key == source->key) continue;
    const SourcePointer other = of_document(document->key);
    if (!other || std::ranges::find(included(other), source) == included(other).end()) continue;
    if (auto found = find_in(other, space, name)) return found;
  }
  return std::nullopt;
}

std::optional<Found> Sources::resolve(const SourcePointer& source, const Reference& reference) {
  const uint32_t local = source->outline.resolve(reference);
  if (local != kNone) return Found{source, local};
  if (reference.kind == ReferenceKind::kArgument) {
    if (reference.callee == kNone) return std::nullopt;
    const auto callee = resolve(source, source->outline.references[reference.callee]);
    if (!callee) return std::nullopt;
    for (const uint32_t parameter : (*callee)->parameters) {
      const Found found{callee->source, parameter};
      if (found->name == reference.name) return found;
    }
    return std::nullopt;
  }
  if (auto found = find(source, space_of(reference.kind), reference.name)) return found;
  return reference.kind == ReferenceKind::kCall
             ? find(source, NameSpace::kFunctions, reference.name)
             : std::nullopt;
}

std::optional<Found> Sources::meaning_at(const SourcePointer& source, std::size_t offset) {
  const Outline& outline = source->outline;
  const uint32_t definition = outline.definition_at(offset);
  if (definition != kNone) return Found{source, definition};
  const uint32_t reference = outline.reference_at(offset);
  return reference == kNone ? std::nullopt : resolve(source, outline.references[reference]);
}

bool Sources::are_same(const Found& a, const Found& b) {
  if (a.source->key == b.source->key) return a.source->outline.are_same(a.definition, b.definition);
  // What a file defines, and another one that it includes, is one thing.
  if (a->scope != 0 || b->scope != 0 || a->name != b->name || a->name_space() != b->name_space())
    return false;
  const auto includes = [this](const Found& from, const Found& to) {
    return std::ranges::any_of(included(from.source), [&](const SourcePointer& source) {
      return source->key == to.source->key;
    });
  };
  return includes(a, b) || includes(b, a);
}

/// Returns the sources that are open, those that they read, and those in the folders.
std::vector<SourcePointer> Sources::known_sources() {
  constexpr std::size_t kMostFiles = 5000;
  std::vector<SourcePointer> known;
  std::set<std::string> keys;
  const auto add = [&](const SourcePointer& source) {
    if (source && keys.insert(source->key).second) known.push_back(source);
  };
  for (const DocumentPointer& document : workspace_.documents()) add(of_document(document->key));
  for (const std::string& folder : folders_) {
    std::error_code failed;
    using Files = fs::recursive_directory_iterator;
    const auto skips = fs::directory_options::skip_permission_denied;
    for (Files file(folder, skips, failed), end; !failed && file != end; file.increment(failed)) {
      if (known.size() > kMostFiles) break;
      const std::string name = file->path().filename();
      std::error_code unknown;
      if (name.starts_with('.') && file->is_directory(unknown)) file.disable_recursion_pending();
      if (name.ends_with(".scad")) add(of_file(file->path()));
    }
  }
  for (std::size_t i = 0; i < known.size() && known.size() < kMostFiles; ++i)
    for (const Link& link : std::vector<Link>(links(*known[i]))) add(of_file(link.path, link.key));
  return known;
}

std::vector<PlaceInSource> Sources::occurrences(const Found& found) {
  const std::string_view name = found->name;
  const bool is_local = found->scope != 0 && found->kind != SymbolKind::kParameter;
  std::vector<PlaceInSource> places;
  for (const SourcePointer& source : is_local ? std::vector{found.source} : known_sources()) {
    const Outline& outline = source->outline;
    for (uint32_t i = 0; i < outline.definitions.size(); ++i) {
      if (outline.definitions[i].name == name && are_same({source, i}, found))
        places.push_back({source, outline.definitions[i].name_span});
    }
    for (const Reference& reference : outline.references) {
      if (reference.name != name) continue;
      const auto meant = resolve(source, reference);
      if (meant && are_same(*meant, found)) places.push_back({source, reference.span});
    }
  }
  return places;
}

std::vector<PlaceInSource> Sources::dynamic_occurrences(std::string_view name) {
  std::vector<PlaceInSource> places;
  for (const SourcePointer& source : known_sources()) {
    for (const Definition& made : source->outline.definitions)
      if (made.name == name) places.push_back({source, made.name_span});
    for (const Reference& reference : source->outline.references)
      if (reference.name == name) places.push_back({source, reference.span});
  }
  return places;
}

}  // namespace serve
