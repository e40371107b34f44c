#include "syntax/program_reader.hpp"

#include <algorithm>
#include <filesystem>

#include "base/read_file.hpp"
#include "syntax/lexer.hpp"
#include "syntax/parser.hpp"

namespace language {

namespace fs = std::filesystem;

namespace {

bool is_font(const std::string& name) {
  std::string extension = fs::path(name).extension().string();
  for (char& c : extension) {
    if ('A' <= c && c <= 'Z') c = static_cast<char>(c + 'a' - 'A');
  }
  return extension == ".ttf" || extension == ".otf";
}

/// OpenSCAD follows links to the main file's folder in messages, but neither a link to the file
/// itself, nor those on the way to what it includes.
std::string shown_main_path(const fs::path& path) {
  std::error_code error;
  const fs::path folder = fs::canonical(path.parent_path(), error);
  return ((error ? path.parent_path() : folder) / path.filename()).string();
}

}  // namespace

ProgramReader::ProgramReader(Program& program, Messages& messages, const ParseOptions& options)
    : program_(program), messages_(messages), options_(options), search_(program.lookups) {
  add_first_names(program.names);
}

bool ProgramReader::read_main(const std::string& path) {
  std::error_code error;
  if (path == "-") {
    add_unit("<stdin>", fs::current_path(error).string(), options_.standard_input);
  } else {
    const auto text = read_file(path);
    if (!text) return false;
    const fs::path absolute = fs::absolute(path, error).lexically_normal();
    add_unit(shown_main_path(absolute), absolute.parent_path().string(), *text);
  }
  messages_.set_main_folder(program_.units[0].folder);
  return true;
}

void ProgramReader::parse_used() {
  std::vector<uint32_t> waiting(program_.units[0].uses);  // the next one last
  std::vector<bool> is_parsed{true};
  while (!waiting.empty()) {
    const uint32_t unit = waiting.back();
    waiting.pop_back();
    is_parsed.resize(program_.units.size());
    if (is_parsed[unit]) continue;
    is_parsed[unit] = true;
    parse(unit);
    const auto& uses = program_.units[unit].uses;
    waiting.insert(waiting.end(), uses.begin(), uses.end());
  }
}

bool ProgramReader::parse(uint32_t unit_number) {
  current_unit_ = unit_number;
  Unit& unit = program_.units[unit_number];
  Lexer lexer(program_.files, program_.names, program_.arena, messages_, *this,
              {unit.file, unit.folder, options_.hard_warnings});
  Parser parser(lexer, program_.files, program_.names, program_.arena, messages_,
                {program_.units[0].file, options_.stop});
  try {
    unit.scope = parser.parse_file();
    return true;
  } catch (const SyntaxError&) {
    return false;
  }
}

FileId ProgramReader::include(const NamedFile& file) {
  const std::string path = search_.find(file.name, file.folder, file.being_included);
  if (const auto known = included_.find(path); known != included_.end()) return known->second;
  auto text = path.empty() ? std::nullopt : read_file(path);
  if (!text) {
    messages_.warn("Can't open include file '" + std::string(file.name) + "'.");
    return kNoFile;
  }
  const FileId id = program_.files.add({path, std::move(*text), {}});
  included_.emplace(path, id);
  return id;
}

void ProgramReader::use(const NamedFile& file) {
  const std::string path = search_.find(file.name, file.folder, file.being_included);
  if (path.empty()) messages_.warn("Can't open library '" + std::string(file.name) + "'.");
  if (const std::string name(file.name); is_font(name)) return use_font(name, path);
  if (path.empty()) return;
  auto known = used_.find(path);
  if (known == used_.end()) {
    const auto text = read_file(path);
    if (!text) return messages_.warn("Can't open library '" + std::string(file.name) + "'.");
    const std::string folder = fs::path(path).parent_path().string();
    known = used_.emplace(path, add_unit(path, folder, *text)).first;
  }
  auto& uses = program_.units[current_unit_].uses;
  std::erase(uses, known->second);
  uses.push_back(known->second);
}

void ProgramReader::use_font(const std::string& name, const std::string& path) {
  if (path.empty()) {
    messages_.say(MessageGroup::kError, "Can't read font with path '" + name + "'");
  } else {
    program_.units[current_unit_].fonts.push_back(path);
  }
}

uint32_t ProgramReader::add_unit(std::string path, std::string folder, std::string_view text) {
  Unit& unit = program_.units.emplace_back();
  unit.folder = std::move(folder);
  unit.file = program_.files.add({std::move(path), unit_text(text), {}});
  return static_cast<uint32_t>(program_.units.size() - 1);
}

/// Returns a file's text with what OpenSCAD appends. It reads no further than a NUL.
std::string ProgramReader::unit_text(std::string_view file_text) const {
  std::string text(file_text);
  text += "\n\x03\n";
  for (const std::string& definition : options_.definitions) text += definition + ";\n";
  return text.substr(0, text.find('\0'));
}

}  // namespace language
