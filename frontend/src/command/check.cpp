#include "command/check.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string_view>

#include "base/descriptor.hpp"
#include "follow/evaluated_design.hpp"
#include "frontend/error.hpp"
#include "frontend/files.hpp"
#include "frontend/openscad_export.hpp"
#include "frontend/terminal.hpp"
#include "language/csg_writer.hpp"
#include "process/child_process.hpp"
#include "process/openscad_program.hpp"

namespace frontend {
namespace {

namespace fs = std::filesystem;

constexpr const char* kUsage =
    "Usage: scadray check [options] FILE...\n"
    "Evaluates each FILE (.scad) by scadray and by openscad, and shows the first difference of\n"
    "their trees and of their messages, in the language that openscad's version speaks. Options: "
    "-D VAR=VALUE, -p FILE, -P SET, --hardwarnings,\n"
    "--check-parameters=BOOL, --check-parameter-ranges=BOOL. Exit status: 0 if all are the same,\n"
    "2 if any differs, 1 after a failure.\n";

/// What an evaluation gives.
struct Result {
  std::string tree;      // the text of the .csg; empty if there is none
  std::string messages;  // a line each
};

/// A folder of its own, removed at the end.
class WorkFolder {
 public:
  WorkFolder() {
    std::string pattern = (fs::temp_directory_path() / "scadray-check-XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr) {
      throw Error(pattern, {}, "cannot be made", "check $TMPDIR");
    }
    path_ = pattern;
  }
  ~WorkFolder() {
    std::error_code failed;
    fs::remove_all(path_, failed);
  }
  WorkFolder(const WorkFolder&) = delete;
  WorkFolder& operator=(const WorkFolder&) = delete;
  std::string file(const char* name) const { return (path_ / name).string(); }

 private:
  fs::path path_;
};

std::string text_of(const std::string& path) {
  std::error_code failed;
  return fs::exists(path, failed) ? std::string(read_regular_file(path).view()) : std::string();
}

Result by_openscad(const std::string& file, const std::vector<std::string>& options) {
  const WorkFolder folder;
  const std::string tree = folder.file("tree.csg"), messages = folder.file("messages");
  std::vector<std::string> command = {openscad_program(), "-o", tree};
  const std::vector<std::string> known =
      known_to_openscad(options, [](const std::string& line) { print_text(stderr, line + "\n"); });
  command.insert(command.end(), known.begin(), known.end());
  command.insert(command.end(), {"--", file});
  std::FILE* const errors = std::fopen(messages.c_str(), "we");
  if (errors == nullptr) throw Error(messages, {}, "cannot be written", "check $TMPDIR");
  // Its standard output has no messages, but what OpenSCAD's lexer copies there (LANGUAGE.md).
  const Descriptor nowhere(open("/dev/null", O_WRONLY | O_CLOEXEC));
  ChildProcess({command, nowhere.number(), fileno(errors)}).wait();
  std::fclose(errors);
  return {text_of(tree), text_of(messages)};
}

/// Returns what `openscad --version` prints behind "version ": "2021.01"; empty if it is not
/// understood.
std::string openscad_version() {
  constexpr std::string_view kWord = "version ";
  const std::string text = said_by_openscad({"--version"});
  const std::size_t found = text.find(kWord);
  if (found == std::string::npos) return {};
  const std::size_t begin = found + kWord.size();
  return text.substr(begin, text.find_first_of(" \r\n", begin) - begin);
}

/// Returns the language that a version of OpenSCAD speaks: snapshots are named by their day.
language::LanguageVersion language_of(const std::string& version) {
  constexpr std::string_view kLastRelease = "2021.01";
  const bool is_snapshot =
      version > std::string(kLastRelease) && !version.starts_with(kLastRelease);
  return is_snapshot ? language::LanguageVersion::k2026 : language::LanguageVersion::k2021;
}

Result by_scadray(const std::string& file, const std::vector<std::string>& options,
                  language::LanguageVersion language) {
  std::optional<language::EvaluationOptions> known = evaluation_options(options, file);
  if (!known) throw Error("", {}, "an option of check is not known", "see scadray check --help");
  known->language = language;
  Result result;
  const language::Evaluation evaluation = language::evaluate(
      file, *known, [&](std::string_view line) { result.messages.append(line) += '\n'; });
  const bool is_read = evaluation.outcome == language::Outcome::kDone ||
                       evaluation.outcome == language::Outcome::kAborted;
  if (is_read) result.tree = language::csg_text(*evaluation.tree);
  return result;
}

/// Removes and returns the first line, without its end; nothing after the last one. After a text's
/// last line feed there is one more line, which is empty.
std::optional<std::string_view> take_line(std::optional<std::string_view>& text) {
  if (!text) return std::nullopt;
  const std::size_t end = text->find('\n');
  const std::string_view line = text->substr(0, end);
  text = end == std::string_view::npos ? std::nullopt : std::optional(text->substr(end + 1));
  return line;
}

/// Returns a line as it is shown beside another one, from which it differs.
std::string shown_line(const std::optional<std::string_view>& line) {
  if (!line) return "(the end)";
  return line->empty() ? "(an empty line)" : std::string(*line);
}

/// Says where two texts differ first. Returns whether they do.
bool show_difference(const std::string& file, const char* what, const std::string& own,
                     const std::string& openscad) {
  if (own == openscad) return false;
  std::size_t number = 0;
  std::optional<std::string_view> our_rest = own, their_rest = openscad, ours, theirs;
  do {
    ++number;
    ours = take_line(our_rest);
    theirs = take_line(their_rest);
  } while (ours == theirs);
  print_text(stdout, file + ": the " + what + " differ in line " + std::to_string(number) +
                         ":\n  scadray:  " + shown_line(ours) +
                         "\n  openscad: " + shown_line(theirs) + "\n");
  return true;
}

bool check_design(const std::string& file, const std::vector<std::string>& options,
                  language::LanguageVersion language) {
  check_input(file);
  const Result own = by_scadray(file, options, language);
  const Result openscad = by_openscad(file, options);
  const bool trees = show_difference(file, "trees", own.tree, openscad.tree);
  const bool messages = show_difference(file, "messages", own.messages, openscad.messages);
  if (!trees && !messages) print_text(stdout, file + ": the same\n");
  return !trees && !messages;
}

}  // namespace

ExitCode check_designs(const std::vector<std::string>& arguments) {
  std::vector<std::string> options, files;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const std::string& word = arguments[i];
    if (word == "--help" || word == "-h") {
      std::fputs(kUsage, stdout);
      return ExitCode::kDone;
    }
    if (!word.starts_with('-')) {
      files.push_back(word);
      continue;
    }
    options.push_back(word);
    const bool has_value = word == "-D" || word == "-p" || word == "-P";
    if (has_value && i + 1 < arguments.size()) options.push_back(arguments[++i]);
  }
  if (files.empty()) throw Error("", {}, "no file to check", "see scadray check --help");
  const std::string version = openscad_version();
  const language::LanguageVersion language = language_of(version);
  const bool is_2021 = language == language::LanguageVersion::k2021;
  print_text(stdout, "compared with openscad " +
                         (version.empty() ? "of no known version" : version) +
                         ", in the language of " + (is_2021 ? "2021.01" : "2026") + "\n");
  bool are_same = true;
  for (const std::string& file : files)
    are_same = check_design(file, options, language) && are_same;
  return are_same ? ExitCode::kDone : ExitCode::kDisagreement;
}

}  // namespace frontend
