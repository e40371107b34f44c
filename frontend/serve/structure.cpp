// The structure of a text: its symbols, what may be folded, its colours.
#include <algorithm>
#include <charconv>
#include <cmath>

#include "features.hpp"
#include "language/color_names.hpp"

namespace serve {
namespace {

std::string_view word(const Outline& outline, const Token& token) {
  return outline.text->at(token.span);
}

/// Adds the symbols of those scopes that belong to no inner module.
class SymbolLister {
 public:
  explicit SymbolLister(const Source& source) : outline_(source.outline) {
    // The scopes of children and conditions are no symbols: what stands in them belongs to the
    // module around.
    owner_.resize(outline_.scopes.size(), kNone);
    for (uint32_t i = 0; i < outline_.definitions.size(); ++i)
      if (outline_.definitions[i].inner != kNone) owner_[outline_.definitions[i].inner] = i;
    for (uint32_t scope = 1; scope < owner_.size(); ++scope)
      if (owner_[scope] == kNone) owner_[scope] = owner_[outline_.scopes[scope].parent];
    members_.resize(outline_.definitions.size());
    for (uint32_t i = 0; i < outline_.definitions.size(); ++i) {
      const Definition& made = outline_.definitions[i];
      if (made.kind == SymbolKind::kParameter) continue;
      const uint32_t owner = owner_[made.scope];
      (owner == kNone || owner == i ? top_ : members_[owner]).push_back(i);
    }
  }

  std::vector<Symbol> list() const { return listed(top_, 0); }

 private:
  std::vector<Symbol> listed(const std::vector<uint32_t>& members, int depth) const {
    constexpr int kDeepest = 50;
    std::vector<Symbol> result;
    if (depth > kDeepest) return result;
    for (const uint32_t member : members) {
      const Definition& made = outline_.definitions[member];
      const ItemKind kind = made.kind == SymbolKind::kModule     ? ItemKind::kModule
                            : made.kind == SymbolKind::kFunction ? ItemKind::kFunction
                                                                 : ItemKind::kVariable;
      std::string detail;
      for (const uint32_t parameter : made.parameters) {
        detail += detail.empty() ? "(" : ", ";
        detail += outline_.definitions[parameter].name;
      }
      if (!detail.empty()) detail += ')';
      result.push_back({std::string(made.name), std::move(detail), kind, made.span, made.name_span,
                        listed(members_[member], depth + 1)});
    }
    return result;
  }

  const Outline& outline_;
  std::vector<uint32_t> owner_;                 // of scopes: the definition around
  std::vector<uint32_t> top_;                   // definitions
  std::vector<std::vector<uint32_t>> members_;  // of definitions
};

/// Reads the calls of color().
class ColorReader {
 public:
  explicit ColorReader(const Outline& outline) : outline_(outline) {
    for (const Token& token : outline.tokens)
      if (token.kind != TokenKind::kComment) code_.push_back(token);
  }

  std::vector<ColorPlace> read() const {
    std::vector<ColorPlace> places;
    for (std::size_t i = 0; i + 2 < code_.size(); ++i) {
      if (said(i) != "color" || said(i + 1) != "(") continue;
      std::size_t at = i + 2;
      if (said(at) == "c" && said(at + 1) == "=") at += 2;
      auto place = said(at) == "[" ? vector_at(at) : name_at(at);
      if (!place) continue;
      if (said(at) == ",") {
        at += said(at + 1) == "alpha" && said(at + 2) == "=" ? 3 : 1;
        if (const auto alpha = number_at(at)) place->color[3] = *alpha;
      }
      places.push_back(*place);
    }
    return places;
  }

 private:
  std::string_view said(std::size_t at) const {
    return at < code_.size() ? word(outline_, code_[at]) : "";
  }
  std::optional<double> number_at(std::size_t at) const {
    const std::string_view text = said(at);
    if (text.empty() || code_[at].kind != TokenKind::kNumber) return std::nullopt;
    double number = 0;
    const auto read = std::from_chars(text.data(), text.data() + text.size(), number);
    const bool is_channel = read.ec == std::errc() && number >= 0 && number <= 1;
    return is_channel ? std::optional(number) : std::nullopt;
  }
  /// Both move `at` behind what they have read.
  std::optional<ColorPlace> vector_at(std::size_t& at) const {
    ColorPlace place{{code_[at].span.begin, 0}, {0, 0, 0, 1}};
    std::size_t channel = 0;
    for (++at; channel < place.color.size(); ++at, ++channel) {
      const auto number = number_at(at);
      if (!number) return std::nullopt;
      place.color[channel] = *number;
      if (said(++at) != ",") break;
    }
    if (said(at) != "]" || channel < 2) return std::nullopt;
    place.span.end = code_[at++].span.end;
    return place;
  }
  std::optional<ColorPlace> name_at(std::size_t& at) const {
    std::string_view text = said(at);
    if (text.size() < 2 || code_[at].kind != TokenKind::kString) return std::nullopt;
    const auto color = language::color_of_name(text.substr(1, text.size() - 2));
    if (!color) return std::nullopt;
    const auto& [r, g, b, a] = *color;
    return ColorPlace{code_[at++].span, {r, g, b, a}};
  }

  const Outline& outline_;
  std::vector<Token> code_;
};

void add_fold(const Text& text, std::vector<Fold>& folds, Span span, Fold::Kind kind,
              bool shows_last) {
  const uint32_t first = text.line_of(span.begin), last = text.line_of(span.end);
  const uint32_t end = shows_last && last > first ? last - 1 : last;
  if (end > first) folds.push_back({first, end, kind});
}

/// Returns the spans of runs of tokens in lines that follow each other.
template <typename IsMember>
std::vector<Span> runs(const Outline& outline, IsMember is_member) {
  std::vector<Span> result;
  bool goes_on = false;
  for (const Token& token : outline.tokens) {
    if (!is_member(token)) {
      goes_on = false;
      continue;
    }
    const Text& text = *outline.text;
    if (goes_on && text.line_of(token.span.begin) == text.line_of(result.back().end) + 1)
      result.back().end = token.span.end;
    else
      result.push_back(token.span);
    goes_on = true;
  }
  return result;
}

std::string number_text(double number) {
  std::array<char, 32> digits;
  const double rounded = std::round(number * 1000) / 1000;
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), rounded).ptr;
  return {digits.data(), end};
}

}  // namespace

std::vector<Symbol> symbols(const Source& source) { return SymbolLister(source).list(); }

std::vector<Fold> folds(const Source& source) {
  const Outline& outline = source.outline;
  const Text& text = *outline.text;
  std::vector<Fold> folds;
  std::vector<Token> open;
  for (const Token& token : outline.tokens) {
    const std::string_view said = word(outline, token);
    if (token.kind == TokenKind::kComment && said.starts_with("/*"))
      add_fold(text, folds, token.span, Fold::Kind::kComment, false);
    if (token.kind != TokenKind::kSign) continue;
    constexpr std::string_view kOpening = "([{", kClosing = ")]}";
    if (kOpening.find(said) != kOpening.npos) open.push_back(token);
    const std::size_t closed = kClosing.find(said);
    if (closed == kClosing.npos) continue;
    const auto opening = std::find_if(open.rbegin(), open.rend(), [&](const Token& other) {
      return word(outline, other) == kOpening.substr(closed, 1);
    });
    if (opening == open.rend()) continue;
    add_fold(text, folds, {opening->span.begin, token.span.begin}, Fold::Kind::kRegion, true);
    open.erase(opening.base() - 1, open.end());
  }
  const auto is_line_comment = [&](const Token& token) {
    return token.kind == TokenKind::kComment && word(outline, token).starts_with("//");
  };
  const auto is_file = [](const Token& token) {
    return token.kind == TokenKind::kInclude || token.kind == TokenKind::kUse;
  };
  for (const Span span : runs(outline, is_line_comment))
    add_fold(text, folds, span, Fold::Kind::kComment, false);
  for (const Span span : runs(outline, is_file))
    add_fold(text, folds, span, Fold::Kind::kImports, false);
  std::ranges::sort(folds, {}, &Fold::first_line);
  return folds;
}

std::vector<ColorPlace> colors(const Source& source) { return ColorReader(source.outline).read(); }

std::vector<std::string> color_texts(const std::array<double, 4>& color, std::string_view now) {
  std::string vector, hex = "\"#";
  const bool is_opaque = color[3] >= 1;
  for (std::size_t channel = 0; channel < (is_opaque ? 3 : 4); ++channel) {
    const double value = std::clamp(color[channel], 0.0, 1.0);
    vector += (vector.empty() ? "[" : ", ") + number_text(value);
    constexpr std::string_view kDigits = "0123456789abcdef";
    const auto byte = static_cast<std::size_t>(std::lround(value * 255));
    hex += {kDigits[byte / 16], kDigits[byte % 16]};
  }
  vector += ']';
  hex += '"';
  if (now.starts_with('[')) return {vector, hex};
  return {hex, vector};
}

}  // namespace serve
