#include "message_list.hpp"

#include <algorithm>
#include <charconv>
#include <optional>
#include <unordered_map>
#include <utility>

#include "frontend/design_version.hpp"
#include "frontend/terminal.hpp"

namespace window {
namespace {

bool is_trace(std::string_view line) { return line.starts_with("TRACE: "); }

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

bool contains_text(std::string_view text, std::string_view part) {
  return std::search(text.begin(), text.end(), part.begin(), part.end(),
                     [](char a, char b) { return lower(a) == lower(b); }) != text.end();
}

/// Returns the number at the front of a text, and removes it; 0: there is none.
uint32_t take_number(std::string_view& text) {
  uint32_t number = 0;
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (problem != std::errc{}) return 0;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return number;
}

/// Returns the place of "… in file NAME, line N …".
std::optional<MessagePlace> openscad_place(std::string_view line) {
  constexpr std::string_view kFile = "in file ", kLine = ", line ";
  const std::size_t file_at = line.rfind(kFile);
  if (file_at == std::string_view::npos) return std::nullopt;
  const std::string_view rest = line.substr(file_at + kFile.size());
  const std::size_t line_at = rest.rfind(kLine);
  if (line_at == std::string_view::npos) return std::nullopt;
  std::string_view file = rest.substr(0, line_at);
  if (file.size() >= 2 && file.front() == '"' && file.back() == '"') {  // of a parser error
    file = file.substr(1, file.size() - 2);
  }
  std::string_view number = rest.substr(line_at + kLine.size());
  MessagePlace place{std::string(file), take_number(number), 0};
  if (place.file.empty() || place.line == 0) return std::nullopt;
  return place;
}

/// Returns the place of "NAME:line:column: error: …", or of a warning; the column may be missing.
std::optional<MessagePlace> scadray_place(std::string_view line) {
  for (std::size_t colon = line.find(':'); colon != std::string_view::npos;
       colon = line.find(':', colon + 1)) {
    std::string_view rest = line.substr(colon + 1);
    MessagePlace place{std::string(line.substr(0, colon)), take_number(rest), 0, true};
    if (place.line == 0 || place.file.empty()) continue;
    if (std::string_view behind = rest; behind.starts_with(':')) {
      behind.remove_prefix(1);
      place.column = take_number(behind);
      if (place.column > 0) rest = behind;
    }
    if (rest.starts_with(": error: ") || rest.starts_with(": warning: ")) return place;
  }
  return std::nullopt;
}

/// Returns the word that says what a line is: before its text, or behind its place.
MessageKind kind_of(std::string_view line) {
  if (frontend::is_echo(line)) return MessageKind::kEcho;
  const std::string_view start = line.substr(0, line.find(", in file "));
  if (start.starts_with("ERROR: ") || contains_text(start, ": error: ") ||
      start.starts_with("error: ")) {
    return MessageKind::kError;
  }
  if (start.starts_with("WARNING: ") || start.starts_with("DEPRECATED: ") ||
      contains_text(start, ": warning: ") || start.starts_with("warning: ")) {
    return MessageKind::kWarning;
  }
  return MessageKind::kOther;
}

void add_line(const MessageLine& line, std::string& key) {
  key += line.text + '\0' + line.place.file + '\n';
}

std::string key_of(const Message& message) {
  std::string key;
  add_line(message, key);
  for (const MessageLine& trace : message.traces) add_line(trace, key);
  return key;
}

/// Returns a line with the place that is known, or else the one that it tells itself.
MessageLine placed(const std::string& line, const frontend::SourcePlace& known) {
  const std::string text = frontend::visible(line);
  if (known.path.empty() || frontend::is_echo(line)) return {text, place_of_message(line)};
  return {text, {known.path, known.line, known.column}};
}

/// Returns each line with the traces that follow it.
std::vector<Message> traced_lines(const std::vector<std::string>& lines,
                                  const std::vector<frontend::SourcePlace>& places) {
  std::vector<Message> messages;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    MessageLine line = placed(lines[i], i < places.size() ? places[i] : frontend::SourcePlace{});
    if (is_trace(line.text) && !messages.empty()) {
      messages.back().traces.push_back(std::move(line));
    } else {
      const MessageKind kind = kind_of(line.text);
      messages.push_back({std::move(line), kind, 1, {}});
    }
  }
  return messages;
}

}  // namespace

MessagePlace place_of_message(std::string_view line) {
  if (frontend::is_echo(line)) return {};
  if (auto place = openscad_place(line)) return *place;
  return scadray_place(line).value_or(MessagePlace{});
}

std::vector<Message> messages_of(const std::vector<std::string>& lines,
                                 const std::vector<frontend::SourcePlace>& places) {
  std::vector<Message> folded;
  std::unordered_map<std::string, std::size_t> known;
  std::optional<std::size_t> last_echo;
  for (Message& message : traced_lines(lines, places)) {
    if (message.kind == MessageKind::kEcho) {
      if (last_echo && folded[*last_echo].text == message.text) {
        ++folded[*last_echo].count;
        continue;
      }
      last_echo = folded.size();
    } else if (const auto [known_at, is_new] = known.emplace(key_of(message), folded.size());
               !is_new) {
      ++folded[known_at->second].count;
      continue;
    }
    folded.push_back(std::move(message));
  }
  return folded;
}

std::vector<Message> messages_of(const frontend::DesignVersion& version) {
  std::vector<std::string> lines = version.messages;
  std::vector<frontend::SourcePlace> places = version.places;
  if (!version.error.empty()) {
    places.resize(lines.size());
    // The error comes before its traces, and both before all else.
    const auto at = static_cast<std::ptrdiff_t>(std::min(version.before_error, lines.size()));
    const auto end = std::find_if_not(lines.begin() + at, lines.end(), is_trace) - lines.begin();
    std::rotate(lines.begin(), lines.begin() + at, lines.begin() + end);
    std::rotate(places.begin(), places.begin() + at, places.begin() + end);
    lines.insert(lines.begin(), version.error);
    places.insert(places.begin(), frontend::SourcePlace{});
  }
  return messages_of(lines, places);
}

bool has_error(const std::vector<Message>& messages) {
  return std::any_of(messages.begin(), messages.end(),
                     [](const Message& message) { return message.kind == MessageKind::kError; });
}

MessageCounts count_messages(const std::vector<Message>& messages) {
  MessageCounts counts;
  for (const Message& message : messages) {
    switch (message.kind) {
      case MessageKind::kError:
        counts.errors += message.count;
        break;
      case MessageKind::kWarning:
        counts.warnings += message.count;
        break;
      case MessageKind::kEcho:
        counts.echoes += message.count;
        break;
      case MessageKind::kOther:
        counts.others += message.count;
        break;
    }
  }
  return counts;
}

bool contains(const Message& message, std::string_view text) {
  return contains_text(message.text, text) ||
         std::any_of(message.traces.begin(), message.traces.end(),
                     [&](const MessageLine& trace) { return contains_text(trace.text, text); });
}

}  // namespace window
