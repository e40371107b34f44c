#include "messages/messages.hpp"

#include <algorithm>
#include <filesystem>

namespace language {

namespace {

std::string suffix_of(const std::string& path, uint32_t line) {
  return " in file " + path + ", line " + std::to_string(line);
}

}  // namespace

std::string_view name_of(MessageGroup group) {
  switch (group) {
    case MessageGroup::kError:
      return "ERROR";
    case MessageGroup::kWarning:
    case MessageGroup::kSoftWarning:
      return "WARNING";
    case MessageGroup::kDeprecated:
      return "DEPRECATED";
    case MessageGroup::kTrace:
      return "TRACE";
    case MessageGroup::kEcho:
      return "ECHO";
    case MessageGroup::kPlain:
      break;
  }
  return "";
}

Messages::Messages(const SourceFiles& files, Sink sink) : files_(files), sink_(std::move(sink)) {
  std::error_code no_folder;
  start_folder_ = std::filesystem::current_path(no_folder).string();
}

void Messages::set_main_file(FileId file, std::string folder) {
  main_file_ = file;
  main_folder_ = std::move(folder);
}

void Messages::set_unit_folder(std::string_view folder) { unit_folder_ = folder; }

void Messages::say(MessageGroup group, std::string text) {
  say(group, std::move(text), Place{}, std::string());
}

void Messages::say(MessageGroup group, std::string text, Place place, PathBase base) {
  say(group, std::move(text), place, place.file == kNoFile ? "" : place_suffix(place, base));
}

void Messages::say_parser_error(std::string text, Place place, uint32_t line) {
  const std::string path = relative_path(place.file, start_folder_);
  say(MessageGroup::kError, std::move(text), place, suffix_of(path, line));
}

void Messages::say(MessageGroup group, std::string text, Place place, const std::string& suffix) {
  ++said_;
  if (group == MessageGroup::kWarning) ++warnings_;
  const std::string_view name = name_of(group);
  std::string line = std::string(name) + (name.empty() ? "" : ": ") + text + suffix;
  const Message message{group, std::move(text), place, std::move(line)};
  if (!is_repeat(message)) sink_(message);
}

bool Messages::is_repeat(const Message& message) {
  switch (message.group) {
    case MessageGroup::kDeprecated:
      return !deprecations_.insert(message.line).second;
    case MessageGroup::kError:
    case MessageGroup::kWarning:
    case MessageGroup::kSoftWarning:
    case MessageGroup::kTrace:
      break;
    case MessageGroup::kEcho:
    case MessageGroup::kPlain:
      return false;
  }
  constexpr size_t kRemembered = 5;  // lines that all have to be the same
  if (last_lines_.size() == kRemembered &&
      std::ranges::all_of(last_lines_,
                          [&](const std::string& last) { return last == message.line; }))
    return true;
  last_lines_.push_back(message.line);
  if (last_lines_.size() > kRemembered) last_lines_.pop_front();
  return false;
}

const std::string& Messages::canonical_path(FileId file) const {
  const auto [known, is_new] = canonical_paths_.try_emplace(file);
  if (is_new) known->second = files_[file].canonical_path();
  return known->second;
}

std::string Messages::relative_path(FileId file, const std::string& folder) const {
  const std::string& path = canonical_path(file);
  if (!path.starts_with('/') || folder.empty()) return path;
  const std::filesystem::path base(folder);
  return std::filesystem::path(path).lexically_relative(base.lexically_normal()).string();
}

std::string Messages::shown_path(FileId file, PathBase base) const {
  return relative_path(file, base == PathBase::kMainFile ? main_folder_ : unit_folder_);
}

std::string Messages::place_suffix(Place place, PathBase base) const {
  return suffix_of(shown_path(place.file, base), files_.message_line(place));
}

}  // namespace language
