// What an evaluation has said, sorted for the message panel.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "frontend/design_version.hpp"

namespace window {

enum class MessageKind : uint8_t { kError, kWarning, kEcho, kOther };

/// A place in a file that a message names.
struct MessagePlace {
  std::string file;     // as the message spells it; empty: the message names no place
  uint32_t line = 0;    // from 1
  uint32_t column = 0;  // from 1; 0: unknown
  /// A relative path begins in the working folder, and not in the design's.
  bool is_from_here = false;
  bool operator==(const MessagePlace&) const = default;
};

/// A line that was said, as a whole, and the place that it names.
struct MessageLine {
  std::string text;
  MessagePlace place;
  bool operator==(const MessageLine&) const = default;
};

struct Message : MessageLine {
  MessageKind kind = MessageKind::kOther;
  uint32_t count = 1;               // how often it was said
  std::vector<MessageLine> traces;  // the calls that led to it, innermost first
};

bool has_error(const std::vector<Message>& messages);

struct MessageCounts {
  std::size_t errors = 0, warnings = 0, echoes = 0, others = 0;
  std::size_t without_echoes() const { return errors + warnings + others; }
};

/// Returns the place that a line names: OpenSCAD's "in file NAME, line N" (the last one), or
/// scadray's "NAME:line:column: error: " or "warning: ", which may be without a column.
MessagePlace place_of_message(std::string_view line);

/// Returns the messages in the order in which each was first said: equal ones, with the same
/// traces, are one. An ECHO that repeats another is folded only if it follows it directly, since
/// the order of ECHOs matters. `places`, of which there may be fewer, count before what the lines
/// themselves tell.
std::vector<Message> messages_of(const std::vector<std::string>& lines,
                                 const std::vector<frontend::SourcePlace>& places = {});

/// Returns the version's error, if it has one, with its traces, and then its other messages.
std::vector<Message> messages_of(const frontend::DesignVersion& version);

/// Counts repeated messages as often as they were said.
MessageCounts count_messages(const std::vector<Message>& messages);

/// Returns whether a message, or one of its traces, contains a text; case does not matter.
bool contains(const Message& message, std::string_view text);

}  // namespace window
