#include "follow/included_files.hpp"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <set>

#include "frontend/error.hpp"
#include "frontend/files.hpp"

namespace frontend {
namespace {

namespace fs = std::filesystem;

bool is_word(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
         c == '$';
}

/// Returns the position after what begins at `at`: a string, a comment, or else one byte.
std::size_t after_token(std::string_view text, std::size_t at) {
  const auto past = [text](std::size_t found, std::size_t length) {
    return found == std::string_view::npos ? text.size() : found + length;
  };
  if (text.substr(at, 2) == "//") return past(text.find('\n', at), 1);
  if (text.substr(at, 2) == "/*") return past(text.find("*/", at + 2), 2);
  if (text[at] != '"') return at + 1;
  for (++at; at < text.size() && text[at] != '"'; ++at) {
    if (text[at] == '\\') ++at;
  }
  return std::min(at + 1, text.size());
}

/// Returns the name in `<…>` at `at`, after spaces; empty if there is none.
std::string_view bracketed(std::string_view text, std::size_t at) {
  at = text.find_first_not_of(" \t\r\n", at);
  if (at == std::string_view::npos || text[at] != '<') return {};
  const std::size_t end = text.find_first_of(">\t\r\n", at);
  if (end == std::string_view::npos || text[end] != '>') return {};
  return text.substr(at + 1, end - at - 1);
}

/// Returns the folders where OpenSCAD looks for files that are not beside the file that includes
/// them.
std::vector<fs::path> library_folders() {
  std::vector<fs::path> folders;
  if (const char* set = std::getenv("OPENSCADPATH")) {
    for (std::string_view rest = set; !rest.empty();) {
      const std::string_view folder = rest.substr(0, rest.find(':'));
      if (!folder.empty()) folders.emplace_back(folder);
      rest.remove_prefix(std::min(folder.size() + 1, rest.size()));
    }
  }
  if (const char* home = std::getenv("HOME")) {
    folders.push_back(fs::path(home) / ".local/share/OpenSCAD/libraries");
  }
  folders.emplace_back("/usr/local/share/openscad/libraries");
  folders.emplace_back("/usr/share/openscad/libraries");
  return folders;
}

/// Returns the path of a name at which there is a file, or else all paths at which it may be.
std::vector<std::string> places_of(const std::string& name, const std::string& including,
                                   const std::vector<fs::path>& libraries) {
  if (fs::path(name).is_absolute()) return {name};
  std::vector<std::string> places = {
      (fs::path(including).parent_path() / name).lexically_normal().string()};
  for (const fs::path& folder : libraries) {
    places.push_back((folder / name).lexically_normal().string());
  }
  const auto found = std::find_if(places.begin(), places.end(), [](const std::string& path) {
    return language::FileSignature(path).is_regular();
  });
  if (found != places.end()) return {*found};
  return places;
}

}  // namespace

std::vector<std::string> included_names(std::string_view scad) {
  std::vector<std::string> names;
  for (std::size_t at = 0; at < scad.size();) {
    if (!is_word(scad[at])) {
      at = after_token(scad, at);
      continue;
    }
    const std::size_t start = at;
    while (at < scad.size() && is_word(scad[at])) ++at;
    const std::string_view word = scad.substr(start, at - start);
    if (word != "include" && word != "use") continue;
    const std::string_view name = bracketed(scad, at);
    if (name.empty()) continue;
    names.emplace_back(name);
    at = static_cast<std::size_t>(name.data() + name.size() - scad.data());
  }
  return names;
}

bool is_font_name(std::string_view name) {
  constexpr std::size_t kSuffix = 4;
  if (name.size() < kSuffix) return false;
  std::string suffix(name.substr(name.size() - kSuffix));
  for (char& c : suffix) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return suffix == ".ttf" || suffix == ".otf";
}

std::vector<std::string> IncludedFiles::of(const std::string& scad_path) {
  const std::vector<fs::path> libraries = library_folders();
  std::vector<std::string> paths = {scad_path};
  std::set<std::string> seen = {scad_path};
  for (std::size_t i = 0; i < paths.size(); ++i) {
    const std::string path = paths[i];
    for (const std::string& name : names_in(path)) {
      for (std::string& place : places_of(name, path, libraries)) {
        if (seen.insert(place).second) paths.push_back(std::move(place));
      }
    }
  }
  std::erase_if(known_, [&seen](const auto& entry) { return !seen.contains(entry.first); });
  return paths;
}

std::vector<std::string> IncludedFiles::fonts_of(const std::string& scad_path) {
  std::vector<std::string> paths = of(scad_path);
  std::erase_if(paths, [](const std::string& path) {
    return !is_font_name(path) || !language::FileSignature(path).is_regular();
  });
  return paths;
}

const std::vector<std::string>& IncludedFiles::names_in(const std::string& path) {
  Known& known = known_[path];
  const language::FileSignature signature(path);
  if (signature == known.signature) return known.names;
  known = {signature, {}};
  if (!signature.is_regular() || is_font_name(path)) return known.names;
  try {
    known.names = included_names(read_file(path).view());
  } catch (const Error&) {
    known.signature = language::FileSignature();  // the file vanished, or may not be read: examine
                                                  // it again next time
  }
  return known.names;
}

}  // namespace frontend
