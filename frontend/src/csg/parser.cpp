#include "frontend/parser.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>
#include <vector>

#include "csg/lexer.hpp"
#include "frontend/stop.hpp"
#include "language/make.hpp"

namespace frontend {
namespace {

using language::ArgumentName;
using language::ArgumentStyle;
using language::CallModifier;
using language::NodeKind;
using language::NodeTree;
using language::Value;

/// The largest text. A node, argument, number or byte of a string takes at least one byte of text,
/// so that no 32-bit count, index, line or column overflows.
constexpr size_t kMaxTextBytes = std::numeric_limits<uint32_t>::max() - 1;

/// The deepest nesting of lists, far above any use: OpenSCAD nests them at most three deep. It
/// keeps a damaged file of nothing but brackets from taking 16 bytes for each.
constexpr uint32_t kMaxListDepth = 1u << 20;

constexpr const char* kValueHint = "write a number, true, false, undef, a \"string\" or a [list]";

bool is_modifier(char c) { return c == '%' || c == '#' || c == '!' || c == '*'; }

/// What has it is dropped: no CallModifier.
constexpr uint8_t kDisabled = 0x80;

uint8_t modifier_of(char c) {
  switch (c) {
    case '%':
      return CallModifier::kBackgroundModifier;
    case '#':
      return CallModifier::kHighlightModifier;
    case '!':
      return CallModifier::kRootModifier;
    default:
      return kDisabled;
  }
}

/// Returns whether nodes of the kind have no children in any version.
bool is_leaf(NodeKind kind) { return kind <= NodeKind::kText; }

/// Parses undef, true, false, nan or inf into `value`; returns false for any other word.
bool constant(std::string_view word, Value& value) {
  if (word == "true" || word == "false") {
    value = Value::boolean(word == "true");
  } else if (word == "inf") {
    value = std::numeric_limits<double>::infinity();
  } else if (word == "nan") {
    value = std::numeric_limits<double>::quiet_NaN();
  } else if (word == "undef") {
    value = Value::undef();
  } else {
    return false;
  }
  return true;
}

Value list_of(std::span<const double> numbers) {
  language::NumberWriter list(numbers.size());
  for (const double number : numbers) list.put(number);
  return list.take();
}

/// Builds the tree in one pass. Nesting is kept in vectors, not on the call stack.
class Parser {
 public:
  /// `tree` is empty.
  Parser(std::string_view text, const std::string& file_name, NodeTree& tree)
      : tree_(tree), text_(text.data()), lexer_(text, file_name) {}
  void run(const std::stop_token& stop);
  const Lexer& lexer() const { return lexer_; }

 private:
  bool step();
  uint8_t modifiers();
  void node(uint8_t modifiers);
  NodeKind node_kind();
  void close_node();
  void arguments(NodeKind kind);
  void argument();
  void raw_text_argument();
  void add_value(ArgumentName name);
  Value scalar();
  Value list();
  bool matrix();
  bool list_of_numbers();
  Value string();
  void open_list();
  void close_list();
  [[noreturn]] void fail_unclosed() const;
  [[noreturn]] void fail_value() const;
  [[noreturn]] void fail_word(const char* start, std::string_view word) const;

  NodeTree& tree_;
  const char* const text_;
  Lexer lexer_;
  struct OpenNode {
    uint32_t node;
    bool single_child;  // it is without braces
    bool is_disabled;
  };
  std::vector<OpenNode> open_;   // the innermost is the last
  std::vector<Value> elements_;  // of the open lists, so far, from outside in
  std::vector<size_t> lists_;    // by open list: where its elements begin
  std::vector<double> numbers_;  // of the last matrix() or list_of_numbers()
  std::string string_;           // the last one, unescaped
};

void Parser::run(const std::stop_token& stop) {
  const language::UnboundedValues memory;
  do {
    throw_if_stopped(stop);
  } while (step());
  if (!open_.empty()) fail_unclosed();
}

/// Parses the next node up to its children, or an end. Returns false at the end of the text.
bool Parser::step() {
  const uint8_t found = modifiers();
  if (lexer_.at_word()) {
    node(found);
    return true;
  }
  if (found != 0) lexer_.fail_expected("a node after its modifier", "remove the modifier");
  if (lexer_.take(';')) return true;
  if (lexer_.at_end()) return false;
  if (lexer_.peek() != '}') {
    lexer_.fail_expected("a node", "a .csg holds nodes such as sphere(r = 1);");
  }
  if (open_.empty()) lexer_.fail("'}' without a '{'", "remove it");
  lexer_.advance();
  close_node();
  return true;
}

uint8_t Parser::modifiers() {
  uint8_t found = 0;
  for (lexer_.skip_space(); is_modifier(lexer_.peek()); lexer_.skip_space()) {
    found |= modifier_of(lexer_.peek());
    lexer_.advance();
  }
  return found;
}

void Parser::node(uint8_t modifiers) {
  const auto offset = static_cast<uint32_t>(lexer_.position() - text_);
  const NodeKind kind = node_kind();
  const bool is_disabled = (modifiers & kDisabled) != 0;
  const uint32_t node = tree_.open(kind, modifiers & ~kDisabled, {0, offset});
  arguments(kind);
  lexer_.skip_space();
  const bool single = !is_leaf(kind) && (lexer_.at_word() || is_modifier(lexer_.peek()));
  open_.push_back({node, single, is_disabled});
  if (lexer_.take(';')) {
    close_node();
  } else if (!single && !lexer_.take('{')) {
    lexer_.fail_expected(is_leaf(kind) ? "';'" : "';' or '{'",
                         "end the " + std::string(name_of(kind)) + " with ';'");
  }
}

NodeKind Parser::node_kind() {
  const char* const start = lexer_.position();
  const std::string_view name = lexer_.word();
  const uint8_t found = language::kNodeNames.find(name);
  if (found != language::kNodeNames.kNone) return static_cast<NodeKind>(found);
  lexer_.fail(start, "unknown node " + quoted(name),
              "a .csg holds only what OpenSCAD exports, such as multmatrix, union, sphere; if this "
              "is a .scad, name it so");
}

void Parser::close_node() {
  do {
    const OpenNode& done = open_.back();
    tree_.close(done.node);
    if (done.is_disabled) tree_.remove(done.node);
    open_.pop_back();
  } while (!open_.empty() && open_.back().single_child);
}

void Parser::arguments(NodeKind kind) {
  lexer_.skip_space();
  if (!lexer_.take('(')) lexer_.fail_expected("'('", "a node's arguments stand in parentheses");
  if (kind == NodeKind::kText) raw_text_argument();
  for (;;) {
    lexer_.skip_space();
    if (lexer_.take(')')) return;
    argument();
    lexer_.skip_space();
    if (lexer_.take(',')) continue;
    if (!lexer_.take(')')) lexer_.fail_expected("',' or ')'", "separate arguments by commas");
    return;
  }
}

void Parser::argument() {
  if (!lexer_.at_word()) return add_value({});
  const char* const start = lexer_.position();
  const std::string_view word = lexer_.word();
  lexer_.skip_space();
  if (lexer_.take('=')) {
    lexer_.skip_space();
    return add_value(ArgumentName::named(word));
  }
  Value value;
  if (!constant(word, value)) fail_word(start, word);
  tree_.add({}, std::move(value), ArgumentStyle::kGeneral);
}

void Parser::raw_text_argument() {
  std::string_view text;
  if (!lexer_.raw_text(text)) return;
  tree_.add("text", language::make_string(text), ArgumentStyle::kRawString);
  lexer_.advance();  // past the comma
}

/// Takes a value, and adds it to the last node.
void Parser::add_value(ArgumentName name) {
  if (lexer_.peek() != '[') return tree_.add(name, scalar(), ArgumentStyle::kGeneral);
  if (matrix()) return tree_.add(name, numbers_, ArgumentStyle::kMatrix);
  if (!list_of_numbers()) return tree_.add(name, list(), ArgumentStyle::kEcho);
  if (numbers_.size() <= NodeTree::kMostNumbers) {
    tree_.add(name, numbers_, ArgumentStyle::kGeneral);
  } else {
    tree_.add(name, list_of(numbers_), ArgumentStyle::kEcho);
  }
}

Value Parser::scalar() {
  if (lexer_.at_number()) return lexer_.number();
  const char c = lexer_.peek();
  if (c == '"') return string();
  const char* const start = lexer_.position();
  bool negative = false;
  bool sign = false;
  for (; lexer_.peek() == '-' || lexer_.peek() == '+'; lexer_.skip_space()) {
    sign = true;
    negative ^= lexer_.peek() == '-';
    lexer_.advance();
  }
  Value value;
  if (sign && lexer_.at_number()) {
    value = lexer_.number();
  } else if (!lexer_.at_word()) {
    fail_value();
  } else if (const std::string_view word = lexer_.word();
             !constant(word, value) || (sign && !value.is_number())) {
    fail_word(start, word);
  }
  return negative ? Value(-value.number()) : value;
}

/// Takes the list at the cursor.
Value Parser::list() {
  open_list();
  for (;;) {
    lexer_.skip_space();
    const char c = lexer_.peek();
    if (c == '[') {
      if (!list_of_numbers()) {
        open_list();
        continue;
      }
      elements_.push_back(list_of(numbers_));
    } else if (c != ']') {
      elements_.push_back(scalar());
    }
    // A value, or the list after '[' or ',', is complete. Lists that end here are closed.
    for (;;) {
      lexer_.skip_space();
      if (lexer_.take(',')) break;
      if (!lexer_.take(']')) {
        lexer_.fail_expected("',' or ']'", "separate values by commas");
      }
      close_list();
      if (lists_.empty()) {
        Value whole = std::move(elements_.back());
        elements_.clear();
        return whole;
      }
    }
  }
}

/// Takes four lists of four plain numbers, spaced as by OpenSCAD, into `numbers_`. Returns false,
/// and takes nothing, for any other list.
bool Parser::matrix() {
  constexpr size_t kRows = 4;
  const char* const start = lexer_.position();
  std::array<double, kRows * kRows> entries;
  lexer_.advance();
  for (size_t row = 0; row < kRows; ++row) {
    if (row > 0 && !lexer_.take(',')) break;
    if (row > 0) lexer_.take(' ');
    if (lexer_.peek() != '[' || !list_of_numbers() || numbers_.size() != kRows) break;
    std::copy(numbers_.begin(), numbers_.end(), entries.begin() + row * kRows);
    if (row + 1 < kRows) continue;
    if (!lexer_.take(']')) break;
    numbers_.assign(entries.begin(), entries.end());
    return true;
  }
  lexer_.go_back(start);
  return false;
}

/// Takes the list at the cursor into `numbers_` if it contains nothing but plain numbers, spaced as
/// by OpenSCAD: rows of matrices, points, faces. Returns false, and takes nothing, for any other
/// list; at most its numbers before the first inner list are then parsed twice.
bool Parser::list_of_numbers() {
  const char* const start = lexer_.position();
  numbers_.clear();
  lexer_.advance();
  double number;
  while (lexer_.plain_number(number)) {
    numbers_.push_back(number);
    if (lexer_.take(']')) return true;
    if (!lexer_.take(',')) break;
    lexer_.take(' ');
  }
  lexer_.go_back(start);
  return false;
}

void Parser::open_list() {
  if (lists_.size() == kMaxListDepth) {
    lexer_.fail("lists are nested more than " + std::to_string(kMaxListDepth) + " deep",
                "the file is damaged: export it again");
  }
  lists_.push_back(elements_.size());
  lexer_.advance();
}

/// The innermost list becomes an element of the one around it.
void Parser::close_list() {
  const size_t first = lists_.back();
  Value list = language::make_vector(elements_.size() - first);
  for (size_t i = first; i < elements_.size(); ++i) {
    language::append_in_room(list, std::move(elements_[i]));
  }
  elements_.resize(first);
  elements_.push_back(std::move(list));
  lists_.pop_back();
}

Value Parser::string() {
  const std::string_view raw = lexer_.quoted_string();
  string_.clear();
  for (size_t i = 0; i < raw.size(); ++i) {
    char c = raw[i];
    if (c == '\\' && i + 1 < raw.size()) {
      constexpr std::string_view kEscapes = "tnr\"\\", kMeanings = "\t\n\r\"\\";
      const size_t escape = kEscapes.find(raw[i + 1]);
      if (escape != std::string_view::npos) {
        c = kMeanings[escape];
        ++i;
      }
    }
    string_ += c;
  }
  return language::make_string(string_);
}

void Parser::fail_unclosed() const {
  const language::Node& node = tree_.nodes[open_.back().node];
  const auto line = 1 + std::count(text_, text_ + node.place.offset, '\n');
  lexer_.fail("the '{' of the " + std::string(name_of(node.kind)) + " in line " +
                  std::to_string(line) + " is not closed",
              "add a '}'; if the file is cut off, export it again");
}

void Parser::fail_value() const { lexer_.fail_expected("a value", kValueHint); }

void Parser::fail_word(const char* start, std::string_view word) const {
  if (lexer_.at_end()) fail_value();  // the end may have cut the word off
  lexer_.fail(start, "no value is called " + quoted(word), kValueHint);
}

/// Returns the text behind the byte order mark that it may begin with.
std::string_view without_mark(std::string_view text) {
  constexpr std::string_view kMark = "\xEF\xBB\xBF";
  return text.substr(text.starts_with(kMark) ? kMark.size() : 0);
}

void check_size(std::string_view text, const std::string& file_name) {
  if (text.size() <= kMaxTextBytes) return;
  throw Error(file_name, {}, "the file has " + std::to_string(text.size()) + " bytes",
              "at most " + std::to_string(kMaxTextBytes) + " can be read; split the design");
}

}  // namespace

DesignTree parse(const FileText& text, std::string name, std::string path,
                 const std::stop_token& stop) {
  check_size(text.view(), name);
  auto tree = std::make_shared<NodeTree>();
  tree->has_all_digits = false;
  const std::string_view view = without_mark(text.view());
  Parser(view, name, *tree).run(stop);
  auto files = std::make_shared<language::SourceFiles>();
  const std::shared_ptr<const char[]> bytes(text.bytes(), view.data());
  files->add(0, std::make_shared<language::SourceFile>(std::move(path), bytes, view.size()));
  return {std::move(tree), std::move(files), std::move(name)};
}

DesignTree parse(std::string_view text, std::string name) {
  check_size(text, name);
  return parse(FileText(text), std::move(name));
}

bool is_beyond_repair(std::string_view start, const std::stop_token& stop) {
  NodeTree tree;
  const std::string no_name;
  Parser parser(without_mark(start), no_name, tree);
  try {
    parser.run(stop);
  } catch (const Error&) {
    return !parser.lexer().may_be_cut_off();
  }
  return false;
}

}  // namespace frontend
