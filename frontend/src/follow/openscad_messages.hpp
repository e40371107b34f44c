// The messages of an evaluation, by openscad or in its words: the first ERROR ends the reading,
// unless the evaluation is known to have gone on after it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "frontend/design_file_options.hpp"
#include "frontend/error.hpp"

namespace frontend {

/// Collects openscad's messages line by line. The first ERROR is kept, to be thrown.
class OpenScadMessages {
 public:
  /// What happens to the lines that follow the first ERROR. They are held where pass_errors() may
  /// still put the ERROR before them.
  enum class AfterError : uint8_t { kPasses, kHolds };

  /// A message whose text is kept.
  struct Kept {
    std::string text;
    SourcePlace place;
  };

  explicit OpenScadMessages(const DesignMessageSink& message,
                            AfterError after_error = AfterError::kPasses)
      : message_(message), after_error_(after_error) {}
  /// Takes a part of what openscad prints, each of whose lines counts as a message.
  void add(std::string_view text) {
    pending_ += text;
    std::size_t start = 0;
    for (std::size_t end; (end = pending_.find('\n', start)) != std::string::npos;
         start = end + 1) {
      take({pending_.substr(start, end - start), {}});
    }
    pending_.erase(0, start);
    if (pending_.size() > kLongestLine) finish();
  }
  /// Takes a whole message, which may have several lines.
  void take(Kept message);
  void finish() {
    if (!pending_.empty()) take({pending_, {}});
    pending_.clear();
    release();
  }
  /// Shows the ERROR that is kept and all later ones like other messages.
  void pass_errors();
  /// The first ERROR, without that word.
  const std::optional<Kept>& first_error() const { return first_error_; }

 private:
  /// A longer line is shown in pieces, so that it is shown even if it never ends.
  static constexpr std::size_t kLongestLine = std::size_t{1} << 16;

  /// More than these bytes are not held: endless recursion is traced at length.
  static constexpr std::size_t kMostHeld = std::size_t{1} << 20;

  void pass(const Kept& message) const {
    message_({message.text, message.place, first_error_.has_value()});
  }
  void release();  // what is held

  const DesignMessageSink& message_;
  std::string pending_;
  AfterError after_error_;
  std::optional<Kept> first_error_;
  std::vector<Kept> held_;
  std::size_t held_bytes_ = 0;
  bool passes_errors_ = false;
};

/// Turns "what in file NAME, line N" into an Error with that place. OpenSCAD's name may leave out
/// folders; the file is that of the message's place if it has one.
Error openscad_error(const std::string& scad_path, const OpenScadMessages::Kept& message);

}  // namespace frontend
