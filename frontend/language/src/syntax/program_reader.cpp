#include "syntax/program_reader.hpp"

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "base/read_file.hpp"
#include "language/stopped.hpp"
#include "syntax/lexer.hpp"
#include "syntax/parser.hpp"

namespace language {

namespace fs = std::filesystem;

namespace {

/// The user's library folder where there is no folder for it. OpenSCAD then takes names that have a
/// folder in them as they are, on the folder where the program was started.
constexpr char kNoFolder[] = "";

constexpr std::string_view kMissingLibrary = "Can't open library '{}'";

/// Returns a path made absolute on the folder where the program was started, which is also what an
/// empty path means.
std::string absolute(const std::string& path) {
  std::error_code error;
  return path.empty() ? fs::current_path(error).string() : fs::absolute(path, error).string();
}

bool is_font(const std::string& name) {
  std::string extension = fs::path(name).extension().string();
  for (char& c : extension) {
    if ('A' <= c && c <= 'Z') c = static_cast<char>(c + 'a' - 'A');
  }
  return extension == ".ttf" || extension == ".otf";
}

}  // namespace

LibrarySearch::LibrarySearch(std::vector<std::string>& lookups, const TextOverlay* overlay)
    : lookups_(lookups), overlay_(overlay) {
  if (const char* parts = std::getenv("OPENSCADPATH")) {
    for (std::string_view rest = parts;; rest.remove_prefix(rest.find(':') + 1)) {
      library_folders_.push_back(absolute(std::string(rest.substr(0, rest.find(':')))));
      if (rest.find(':') == rest.npos) break;
    }
  }
  std::error_code error;
  const char* home = std::getenv("HOME");
  const fs::path share = fs::path(home ? home : "") / ".local/share";
  library_folders_.push_back(fs::exists(share, error) ? (share / "OpenSCAD/libraries").string()
                                                      : kNoFolder);
  library_folders_.push_back("/usr/share/openscad/libraries");
}

std::string LibrarySearch::find(std::string_view name, const std::string& folder,
                                std::span<const std::string> excluded) {
  const fs::path first = fs::path(folder) / name;  // `name` alone if it is absolute
  if (is_file(first)) {
    std::error_code error;
    std::string found = (overlay_ ? resolved(first) : fs::canonical(first, error)).string();
    if (!error && !std::ranges::count(excluded, found)) return found;
  }
  if (name.starts_with('/')) return "";
  for (const std::string& library_folder : library_folders_) {
    if (library_folder == kNoFolder && name.find('/') == name.npos) continue;
    const fs::path path = fs::path(library_folder) / name;
    if (!is_file(path)) continue;
    return std::ranges::count(excluded, path.string()) ? "" : path.string();
  }
  return "";
}

bool LibrarySearch::is_file(const fs::path& path) {
  if (overlay_ && overlay_->find(path)) return true;
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status))
    lookups_.push_back(fs::path(absolute(path.string())).lexically_normal().string());
  return fs::exists(status) && !fs::is_directory(status);
}

ProgramReader::ProgramReader(Program& program, Messages& messages, const ParseOptions& options)
    : program_(program),
      messages_(messages),
      options_(options),
      search_(program.lookups, options.overlay) {}

bool ProgramReader::read_main(const std::string& path) {
  std::error_code error;
  const bool is_standard_input = path == "-";
  std::optional<std::string> text;
  if (options_.text || is_standard_input) {
    text = options_.text.value_or(std::string_view());
  } else {
    text = read_file(path);
  }
  if (!text) return false;
  if (is_standard_input) {
    program_.files.add("<stdin>", unit_text(std::move(*text)));
    add_unit(0, fs::current_path(error).string());
  } else {
    const fs::path absolute = fs::absolute(path, error);
    program_.files.add(absolute.string(), unit_text(std::move(*text)));
    add_unit(0, absolute.lexically_normal().parent_path().string());
  }
  program_.kept->begin(program_.files[0].path, options_.definitions, options_.overlay);
  set_main_unit(0);
  return true;
}

void ProgramReader::parse_used() {
  struct Use {
    uint32_t used, user;  // units
  };
  std::vector<Use> waiting;  // the next one last
  const auto add_uses_of = [&](uint32_t user) {
    for (const uint32_t used : program_.units[user].uses) waiting.push_back({used, user});
  };
  std::vector<bool> is_parsed{true};
  add_uses_of(0);
  while (!waiting.empty()) {
    const auto [unit, user] = waiting.back();
    waiting.pop_back();
    is_parsed.resize(program_.units.size());
    if (is_parsed[unit]) continue;
    is_parsed[unit] = true;
    set_main_unit(user);  // as its messages see it
    if (parse(unit)) add_uses_of(unit);
  }
  set_main_unit(0);
  program_.kept->end();
}

void ProgramReader::set_main_unit(uint32_t unit) {
  messages_.set_main_file(program_.units[unit].file, program_.shown_folder(unit));
}

bool ProgramReader::parse(uint32_t unit_number) {
  current_unit_ = unit_number;
  Unit& unit = program_.units[unit_number];
  Lexer lexer(program_.dialect, program_.files, program_.names, program_.arena, messages_, *this,
              {unit.file, unit.folder, options_.hard_warnings, last_path_name_});
  Parser parser(lexer, program_, messages_, options_.stop);
  try {
    unit.scope = parser.parse_file();
  } catch (const SyntaxError&) {
  }
  last_path_name_ = lexer.last_path_name();
  return unit.scope;
}

/// Files that only name others yield no tokens, between which the parser looks.
void ProgramReader::look_whether_to_stop() const {
  if (options_.stop.stop_requested()) throw Stopped();
}

/// Says why there is no text; `path` is empty where nothing was found. The words and the lack of a
/// place are OpenSCAD's but for what it would read: pipes and devices, which may never end.
void ProgramReader::cannot_open(std::string_view words, const FileReference& file,
                                const std::string& path) {
  const std::string text = filled(words, {file.name});
  if (path.empty() || is_regular_file(path)) {
    if (program_.dialect.tells_place_of_missing_files)
      return messages_.warn(text + ".", file.place);
    return messages_.say_without_place(MessageGroup::kWarning, text + ".", file.place);
  }
  messages_.warn(text + ": it is no regular file", file.place);
}

FileId ProgramReader::include(const FileReference& file) {
  look_whether_to_stop();
  const std::string path = search_.find(file.name, file.folder, file.being_included);
  if (const auto known = included_.find(path); known != included_.end()) return known->second;
  const FileId id = path.empty() ? kNoFile : open(KeptSources::Role::kIncluded, path);
  if (id == kNoFile) {
    cannot_open(program_.dialect.missing_include, file, path);
    return kNoFile;
  }
  included_.emplace(path, id);
  return id;
}

FileId ProgramReader::open(KeptSources::Role role, const std::string& path) {
  const std::shared_ptr<KeptFile> file = program_.kept->open(role, path, [&](std::string bytes) {
    if (role == KeptSources::Role::kUsed) return unit_text(std::move(bytes));
    return bytes;
  });
  if (!file) return kNoFile;
  const FileId number = file->number();
  if (number >= program_.kept_files.size()) program_.kept_files.resize(number + 1);
  program_.kept_files[number] = file;
  program_.files.add(number, file->source());
  return number;
}

void ProgramReader::use(const FileReference& file) {
  look_whether_to_stop();
  std::string path = search_.find(file.name, file.folder, file.being_included);
  if (path.empty()) cannot_open(kMissingLibrary, file, path);
  if (const std::string name(file.name); is_font(name)) return use_font(name, path);
  // What an included file does not find, the file that is parsed may: OpenSCAD tries again there,
  // without a word.
  if (path.empty()) path = search_.find(file.name, program_.units[current_unit_].folder, {});
  if (path.empty()) return;
  auto known = used_.find(path);
  if (known == used_.end()) {
    const FileId id = open(KeptSources::Role::kUsed, path);
    if (id == kNoFile) return cannot_open(kMissingLibrary, file, path);
    const std::string folder = fs::path(path).parent_path().string();
    known = used_.emplace(path, add_unit(id, folder)).first;
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

uint32_t ProgramReader::add_unit(FileId file, std::string folder) {
  Unit& unit = program_.units.emplace_back();
  unit.folder = std::move(folder);
  unit.file = file;
  return static_cast<uint32_t>(program_.units.size() - 1);
}

/// Returns a file's text with what OpenSCAD appends. It reads no further than a NUL.
std::string ProgramReader::unit_text(std::string text) const {
  text += "\n\x03\n";
  for (const std::string& definition : options_.definitions) text += definition + ";\n";
  text.resize(std::min(text.find('\0'), text.size()));
  return text;
}

}  // namespace language
