// The tags and texts of an XML document, one after another. It knows neither entities nor document
// types, so that no document is larger than its text.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

namespace frontend {

class XmlScanner {
 public:
  enum class Part : uint8_t { kStart, kEnd, kText, kNone /* the end, or damage */ };

  explicit XmlScanner(std::string_view document) : rest_(document) {}

  /// Goes on to the next part. A tag that closes itself is a start and an end. Comments,
  /// declarations and processing instructions are passed over.
  Part next();
  /// Returns whether all of the document was read, and every tag in it is closed.
  bool is_whole() const { return !is_damaged_ && rest_.empty() && open_.empty(); }

  /// Of a start or an end: its name, without the prefix of a name space.
  std::string_view name() const { return name_; }
  /// Of a text: as it stands there.
  std::string_view text() const { return text_; }
  /// Of a start: the value of the attribute as it stands there; empty if there is none.
  std::string_view attribute(std::string_view wanted) const;

 private:
  Part tag(std::string_view inside);
  Part end();
  Part damaged();
  bool skip_past(std::string_view end);

  std::string_view rest_;
  std::string_view name_, text_, attributes_;
  std::vector<std::string_view> open_;  // names of tags
  bool ends_at_once_ = false;           // the last start was of a tag that closes itself
  bool is_damaged_ = false;
};

}  // namespace frontend
