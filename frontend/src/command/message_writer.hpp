// Writes what a run of the command says to standard error: as lines for people, or as JSON.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "frontend/design_file_options.hpp"
#include "frontend/error.hpp"

namespace frontend {

class ProgressLine;

/// What --messages chooses. kJson: each message is an object on a line of its own, with `group`
/// (OpenSCAD's word: ERROR, WARNING, DEPRECATED, ECHO; else NOTE), `text` without its group and
/// place, `file`, `line` and `column` (in characters, from 1) as far as they are known, and
/// `trace`, if there is one: the calls that led there, each with `text` and place. Bytes that are
/// no UTF-8 are replaced.
enum class MessageFormat : uint8_t { kText, kJson };

/// Returns the format that the words of a command line ask for, also where they are wrong.
MessageFormat message_format(const std::vector<std::string>& words);

class MessageWriter {
 public:
  explicit MessageWriter(MessageFormat format);
  ~MessageWriter();
  MessageWriter(const MessageWriter&) = delete;
  MessageWriter& operator=(const MessageWriter&) = delete;

  bool is_json() const { return format_ == MessageFormat::kJson; }
  /// Sets what is to be cleared before a line is written; null: nothing.
  void set_progress(ProgressLine* progress) { progress_ = progress; }

  /// Each writes a message. That of a design may be a TRACE of the one before.
  void say(const DesignMessage& message);
  void say(const Warning& warning);
  void say(const Error& error);
  /// Says something of no file; `group` is in lower case: "warning". Empty: of none.
  void say(const std::string& group, const std::string& text);

 private:
  struct Json;

  void write(const std::string& line);
  void hold(Json message);
  void flush();

  MessageFormat format_;
  ProgressLine* progress_ = nullptr;
  std::unique_ptr<Json> held_;         // which may get traces; null: none
  std::unique_ptr<Json> error_trace_;  // of the error that has been kept to end the run
};

}  // namespace frontend
