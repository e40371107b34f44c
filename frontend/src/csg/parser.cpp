#include "frontend/parser.hpp"

#include <limits>
#include <utility>

#include "base/name_table.hpp"
#include "csg/lexer.hpp"
#include "frontend/stop.hpp"

namespace frontend {
namespace {

constexpr NameTable kNodeTable(kNodeNames);

/// All argument names that OpenSCAD writes or that a primitive takes. They need no storage in the
/// tree.
constexpr NameTable kArgumentTable(std::to_array<std::string_view>({
    "$fn",       "$fa",       "$fs",      "$fe",    "r",        "r1",      "r2",     "d",
    "d1",        "d2",        "h",        "center", "size",     "points",  "faces",  "triangles",
    "paths",     "convexity", "cut",      "delta",  "chamfer",  "newsize", "auto",   "height",
    "twist",     "slices",    "scale",    "v",      "segments", "file",    "layer",  "origin",
    "timestamp", "angle",     "start",    "dpi",    "id",       "invert",  "text",   "spacing",
    "font",      "direction", "language", "script", "halign",   "valign",  "method", "m",
    "c",         "alpha",     "radius",
}));

/// Means no node and no list: the end of a chain of indices.
constexpr uint32_t kNone = std::numeric_limits<uint32_t>::max();

/// The largest text. A node, argument, value or byte of a string takes at least one byte of text,
/// so that no 32-bit count, index, line or column overflows, and none equals kNone.
constexpr size_t kMaxTextBytes = kNone - 1;

/// The deepest nesting of lists, far above any use: OpenSCAD nests them at most three deep. It
/// keeps a damaged file of nothing but brackets from taking 16 bytes for each.
constexpr uint32_t kMaxListDepth = 1u << 20;

constexpr const char* kValueHint = "write a number, true, false, undef, a \"string\" or a [list]";

bool is_modifier(char c) { return c == '%' || c == '#' || c == '!' || c == '*'; }

Modifier modifier_of(char c) {
  switch (c) {
    case '%':
      return kBackground;
    case '#':
      return kHighlight;
    case '!':
      return kRoot;
    default:
      return kDisable;
  }
}

/// Returns whether nodes of the kind have no children in any version.
bool is_leaf(NodeKind kind) { return kind <= NodeKind::kText; }

Value number_value(double number) {
  Value value;
  value.kind = ValueKind::kNumber;
  value.number = number;
  return value;
}

/// Parses undef, true, false, nan or inf into `value`; returns false for any other word.
bool constant(std::string_view word, Value& value) {
  if (word == "true" || word == "false") {
    value.kind = ValueKind::kBool;
    value.boolean = word == "true";
  } else if (word == "inf") {
    value = number_value(std::numeric_limits<double>::infinity());
  } else if (word == "nan") {
    value = number_value(std::numeric_limits<double>::quiet_NaN());
  } else if (word != "undef") {
    return false;
  }
  return true;
}

/// Builds the tree in one pass. Nesting is kept in vectors, not on the call stack. The `first` of
/// an open list is its parent's index in lists_.
class Parser {
 public:
  /// `tree` has a file name and nothing else.
  Parser(std::string_view text, SyntaxTree& tree);
  void run(const std::stop_token& stop);
  /// Ends after the first node.
  void run_one_node();
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
  Value value();
  Value scalar();
  Value list();
  bool list_of_numbers(Value& list);
  Value string();
  Value store(std::string_view text);
  void give_names();
  uint32_t open_list(uint32_t parent);
  uint32_t close_list(uint32_t list);
  [[noreturn]] void fail_unclosed() const;
  [[noreturn]] void fail_value() const;
  [[noreturn]] void fail_word(const char* start, std::string_view word) const;

  SyntaxTree& tree_;
  const char* const text_;
  Lexer lexer_;
  struct OpenNode {
    uint32_t node;
    bool single_child;  // it is without braces
  };
  std::vector<OpenNode> open_;  // the innermost is the last
  std::vector<Value> lists_;    // the open lists, each followed by its elements so far
  uint32_t list_depth_ = 0;
  struct StoredName {
    uint32_t argument, first, count;
  };
  std::vector<StoredName> names_;  // names in tree_.strings, which still moves
};

Parser::Parser(std::string_view text, SyntaxTree& tree)
    : tree_(tree), text_(text.data()), lexer_(text, tree.file_name) {
  // These are about the averages of OpenSCAD's files, so that the vectors of most files never move.
  // A vector that is not used in full costs addresses, not memory.
  constexpr size_t kBytesPerNode = 48, kBytesPerArgument = 20, kBytesPerValue = 6;
  tree_.nodes.reserve(text.size() / kBytesPerNode);
  tree_.offsets.reserve(text.size() / kBytesPerNode);
  tree_.arguments.reserve(text.size() / kBytesPerArgument);
  tree_.values.reserve(text.size() / kBytesPerValue);
}

void Parser::run(const std::stop_token& stop) {
  do {
    throw_if_stopped(stop);
  } while (step());
  if (!open_.empty()) fail_unclosed();
  give_names();
}

void Parser::run_one_node() {
  while (step() && !open_.empty()) {
  }
  give_names();
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

/// Sets the argument names that are not in the table, once tree_.strings does not move any more.
void Parser::give_names() {
  for (const StoredName& name : names_) {
    tree_.arguments[name.argument].name = {tree_.strings.data() + name.first, name.count};
  }
  names_.clear();
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
  SyntaxNode node;
  tree_.offsets.push_back(static_cast<uint32_t>(lexer_.position() - text_));
  node.location = lexer_.location();
  node.kind = node_kind();
  node.modifiers = modifiers;
  node.first_argument = static_cast<uint32_t>(tree_.arguments.size());
  arguments(node.kind);
  node.argument_count = static_cast<uint32_t>(tree_.arguments.size()) - node.first_argument;
  lexer_.skip_space();
  const bool single = !is_leaf(node.kind) && (lexer_.at_word() || is_modifier(lexer_.peek()));
  open_.push_back({static_cast<uint32_t>(tree_.nodes.size()), single});
  tree_.nodes.push_back(node);
  if (lexer_.take(';')) {
    close_node();
  } else if (!single && !lexer_.take('{')) {
    lexer_.fail_expected(is_leaf(node.kind) ? "';'" : "';' or '{'",
                         "end the " + std::string(name_of(node.kind)) + " with ';'");
  }
}

NodeKind Parser::node_kind() {
  const char* const start = lexer_.position();
  const std::string_view name = lexer_.word();
  const uint8_t found = kNodeTable.find(name);
  if (found != kNodeTable.kNone) return static_cast<NodeKind>(found);
  lexer_.fail(start, "unknown node " + quoted(name),
              "a .csg holds only what OpenSCAD exports, such as multmatrix, union, sphere; if this "
              "is a .scad, name it so");
}

void Parser::close_node() {
  do {
    tree_.nodes[open_.back().node].subtree_end = static_cast<uint32_t>(tree_.nodes.size());
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
  Argument& argument = tree_.arguments.emplace_back();
  if (!lexer_.at_word()) {
    argument.value = value();
    return;
  }
  const char* const start = lexer_.position();
  const std::string_view word = lexer_.word();
  lexer_.skip_space();
  if (lexer_.take('=')) {
    const uint8_t known = kArgumentTable.find(word);
    if (known != kArgumentTable.kNone) {
      argument.name = kArgumentTable[known];
    } else {
      const Value stored = store(word);
      names_.push_back({static_cast<uint32_t>(tree_.arguments.size() - 1),
                        static_cast<uint32_t>(stored.first), stored.count});
    }
    lexer_.skip_space();
    argument.value = value();
  } else if (!constant(word, argument.value)) {
    fail_word(start, word);
  }
}

void Parser::raw_text_argument() {
  std::string_view text;
  if (!lexer_.raw_text(text)) return;
  Argument& argument = tree_.arguments.emplace_back();
  argument.name = "text";
  argument.value = store(text);
  lexer_.advance();  // past the comma
}

Value Parser::value() { return lexer_.peek() == '[' ? list() : scalar(); }

Value Parser::scalar() {
  if (lexer_.at_number()) return number_value(lexer_.number());
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
    value = number_value(lexer_.number());
  } else if (!lexer_.at_word()) {
    fail_value();
  } else if (const std::string_view word = lexer_.word();
             !constant(word, value) || (sign && value.kind != ValueKind::kNumber)) {
    fail_word(start, word);
  }
  if (negative) value.number = -value.number;
  return value;
}

Value Parser::list() {
  Value numbers;
  if (list_of_numbers(numbers)) return numbers;
  uint32_t open = open_list(kNone);
  for (;;) {
    lexer_.skip_space();
    const char c = lexer_.peek();
    if (c == '[') {
      if (!list_of_numbers(numbers)) {
        open = open_list(open);
        continue;
      }
      lists_.push_back(numbers);
    } else if (c != ']') {
      lists_.push_back(scalar());
    }
    // A value, or the list after '[' or ',', is complete. Lists that end here are closed.
    for (;;) {
      lexer_.skip_space();
      if (lexer_.take(',')) break;
      if (!lexer_.take(']')) {
        lexer_.fail_expected("',' or ']'", "separate values by commas");
      }
      open = close_list(open);
      if (open == kNone) {
        const Value whole = lists_.front();
        lists_.clear();
        return whole;
      }
    }
  }
}

/// Takes the list at the cursor if it contains nothing but plain numbers, spaced as by OpenSCAD:
/// rows of matrices, points, faces. Returns false, and takes nothing, for any other list; at most
/// its numbers before the first inner list are then parsed twice.
bool Parser::list_of_numbers(Value& list) {
  if (list_depth_ == kMaxListDepth) return false;
  const char* const start = lexer_.position();
  std::vector<Value>& values = tree_.values;
  const size_t first = values.size();
  lexer_.advance();
  double number;
  while (lexer_.plain_number(number)) {
    values.push_back(number_value(number));
    if (lexer_.take(']')) {
      list.kind = ValueKind::kList;
      list.first = first;
      list.count = static_cast<uint32_t>(values.size() - first);
      return true;
    }
    if (!lexer_.take(',')) break;
    lexer_.take(' ');
  }
  values.resize(first);
  lexer_.go_back(start);
  return false;
}

uint32_t Parser::open_list(uint32_t parent) {
  if (++list_depth_ > kMaxListDepth) {
    lexer_.fail("lists are nested more than " + std::to_string(kMaxListDepth) + " deep",
                "the file is damaged: export it again");
  }
  Value& value = lists_.emplace_back();
  value.kind = ValueKind::kList;
  value.first = parent;
  lexer_.advance();
  return static_cast<uint32_t>(lists_.size() - 1);
}

uint32_t Parser::close_list(uint32_t list) {
  --list_depth_;
  Value& value = lists_[list];
  const uint32_t parent = static_cast<uint32_t>(value.first);
  value.first = tree_.values.size();
  value.count = static_cast<uint32_t>(lists_.size()) - list - 1;
  tree_.values.insert(tree_.values.end(), lists_.begin() + list + 1, lists_.end());
  lists_.resize(list + 1);
  return parent;
}

Value Parser::string() {
  const std::string_view raw = lexer_.quoted_string();
  Value value = store({});
  std::vector<char>& strings = tree_.strings;
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
    strings.push_back(c);
  }
  value.count = static_cast<uint32_t>(strings.size() - value.first);
  return value;
}

Value Parser::store(std::string_view text) {
  Value value;
  value.kind = ValueKind::kString;
  value.first = tree_.strings.size();
  value.count = static_cast<uint32_t>(text.size());
  tree_.strings.insert(tree_.strings.end(), text.begin(), text.end());
  return value;
}

void Parser::fail_unclosed() const {
  const SyntaxNode& node = tree_.nodes[open_.back().node];
  lexer_.fail("the '{' of the " + std::string(name_of(node.kind)) + " in line " +
                  std::to_string(node.location.line) + " is not closed",
              "add a '}'; if the file is cut off, export it again");
}

void Parser::fail_value() const { lexer_.fail_expected("a value", kValueHint); }

void Parser::fail_word(const char* start, std::string_view word) const {
  if (lexer_.at_end()) fail_value();  // the end may have cut the word off
  lexer_.fail(start, "no value is called " + quoted(word), kValueHint);
}

void check_size(std::string_view text, const std::string& file_name) {
  if (text.size() <= kMaxTextBytes) return;
  throw Error(file_name, {}, "the file has " + std::to_string(text.size()) + " bytes",
              "at most " + std::to_string(kMaxTextBytes) + " can be read; split the design");
}

}  // namespace

SyntaxTree parse(std::string_view text, std::string file_name, const std::stop_token& stop) {
  SyntaxTree tree;
  tree.file_name = std::move(file_name);
  check_size(text, tree.file_name);
  Parser(text, tree).run(stop);
  return tree;
}

bool is_beyond_repair(std::string_view start, const std::stop_token& stop) {
  SyntaxTree tree;
  Parser parser(start, tree);
  try {
    parser.run(stop);
  } catch (const Error&) {
    return !parser.lexer().may_be_cut_off();
  }
  return false;
}

SyntaxTree parse_subtree(std::string_view text, uint32_t offset) {
  SyntaxTree tree;
  Parser(text.substr(offset), tree).run_one_node();
  return tree;
}

}  // namespace frontend
