// The tags and texts of an XML document, one after another. It knows neither entities nor document
// types, so that no document is larger than its text.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace frontend {

class XmlScanner {
 public:
  enum class Part : uint8_t { kStart, kEnd, kText, kNone /* the end, or a tag that is not closed */ };

  explicit XmlScanner(std::string_view document) : rest_(document) {}

  /// Goes on to the next part. A tag that closes itself is a start and an end. Comments,
  /// declarations and processing instructions are passed over.
  Part next();
  /// Of a start or an end: its name, without the prefix of a name space.
  std::string_view name() const { return name_; }
  /// Of a text: as it stands there.
  std::string_view text() const { return text_; }
  /// Of a start: the value of the attribute as it stands there; empty if there is none.
  std::string_view attribute(std::string_view wanted) const;

 private:
  Part tag(std::string_view inside);
  bool skip_past(std::string_view end);

  std::string_view rest_;
  std::string_view name_, text_, attributes_;
  bool ends_at_once_ = false;  // the last start was of a tag that closes itself
};

}  // namespace frontend
