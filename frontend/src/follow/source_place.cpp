#include "frontend/source_place.hpp"

#include <algorithm>
#include <filesystem>
#include <utility>

namespace frontend {
namespace {

/// Returns the column of a byte of the text, in characters.
uint32_t column_of(std::string_view text, std::size_t offset) {
  const std::string_view before = text.substr(0, std::min(offset, text.size()));
  const std::string_view line = before.substr(before.rfind('\n') + 1);  // npos + 1 = 0
  const auto others = std::count_if(line.begin(), line.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xC0) == 0x80;  // it continues a character
  });
  return static_cast<uint32_t>(line.size() - static_cast<std::size_t>(others)) + 1;
}

}  // namespace

SourcePlace source_place(const std::string& path, uint32_t line, std::string_view text,
                         std::size_t offset) {
  const bool is_file = path.starts_with('/');
  std::string name = is_file ? std::filesystem::path(path).filename().string() : path;
  if (name.empty()) name = ".csg";
  return {is_file ? path : "", std::move(name), line, column_of(text, offset)};
}

SourcePlace source_place(const language::SourceFiles& files, language::Place place) {
  const language::SourceFile& file = files[place.file];
  return source_place(file.canonical_path(), files.line(place), file.text, place.offset);
}

std::string text_of(const SourcePlace& place) {
  if (place.line == 0) return {};
  return place.file + ':' + std::to_string(place.line) + ':' + std::to_string(place.column);
}

}  // namespace frontend
