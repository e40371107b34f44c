#include "meshes/xml_scanner.hpp"

#include "meshes/number_text.hpp"

namespace frontend {
namespace {

std::string_view without_prefix(std::string_view name) {
  const size_t colon = name.find(':');
  return colon == std::string_view::npos ? name : name.substr(colon + 1);
}

/// Returns where the tag ends: the first '>' that is not within quotes.
size_t end_of_tag(std::string_view text) {
  char quote = 0;
  for (size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quote != 0) {
      if (c == quote) quote = 0;
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else if (c == '>') {
      return i;
    }
  }
  return std::string_view::npos;
}

}  // namespace

bool XmlScanner::skip_past(std::string_view end) {
  const size_t found = rest_.find(end);
  rest_.remove_prefix(found == std::string_view::npos ? rest_.size() : found + end.size());
  return found != std::string_view::npos;
}

XmlScanner::Part XmlScanner::next() {
  if (ends_at_once_) {
    ends_at_once_ = false;
    return end();
  }
  while (!rest_.empty()) {
    if (!rest_.starts_with('<')) {
      const size_t end = rest_.find('<');
      text_ = rest_.substr(0, end);
      rest_.remove_prefix(text_.size());
      return Part::kText;
    }
    if (rest_.starts_with("<!--")) {
      if (!skip_past("-->")) return damaged();
    } else if (rest_.starts_with("<![CDATA[")) {
      const std::string_view start = rest_.substr(std::string_view("<![CDATA[").size());
      text_ = start.substr(0, start.find("]]>"));
      if (!skip_past("]]>")) return damaged();
      return Part::kText;
    } else if (rest_.starts_with("<!") || rest_.starts_with("<?")) {
      if (!skip_past(">")) return damaged();
    } else {
      rest_.remove_prefix(1);
      const size_t end = end_of_tag(rest_);
      if (end == std::string_view::npos) return damaged();
      const std::string_view inside = rest_.substr(0, end);
      rest_.remove_prefix(end + 1);
      return tag(inside);
    }
  }
  return Part::kNone;
}

XmlScanner::Part XmlScanner::end() {
  if (open_.empty() || open_.back() != name_) return damaged();
  open_.pop_back();
  return Part::kEnd;
}

XmlScanner::Part XmlScanner::damaged() {
  is_damaged_ = true;
  rest_ = {};
  return Part::kNone;
}

XmlScanner::Part XmlScanner::tag(std::string_view inside) {
  const bool is_end = inside.starts_with('/');
  if (is_end) inside.remove_prefix(1);
  ends_at_once_ = !is_end && inside.ends_with('/');
  if (ends_at_once_) inside.remove_suffix(1);
  name_ = without_prefix(take_word(inside));
  attributes_ = inside;
  if (is_end) return end();
  open_.push_back(name_);
  return Part::kStart;
}

std::string_view XmlScanner::attribute(std::string_view wanted) const {
  std::string_view rest = attributes_;
  for (;;) {
    const size_t equals = rest.find('=');
    if (equals == std::string_view::npos) return {};
    const std::string_view name = trimmed(rest.substr(0, equals));
    rest = trimmed(rest.substr(equals + 1));
    if (rest.empty()) return {};
    const size_t end = rest.find(rest.front(), 1);
    if (end == std::string_view::npos) return {};
    if (name == wanted) return rest.substr(1, end - 1);
    rest.remove_prefix(end + 1);
  }
}

}  // namespace frontend
