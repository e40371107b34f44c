#include <array>
#include <initializer_list>
#include <vector>

#include "base/number_text.hpp"
#include "syntax/syntax.hpp"
#include "values/value_text.hpp"

namespace language {

namespace {

constexpr std::array<std::string_view, 18> kOperatorTexts = {
    " ^ ",  " * ",  " / ",  " % ",  " + ",  " - ", " < ", " <= ", " > ",
    " >= ", " == ", " != ", " && ", " || ", " & ", " | ", " << ", " >> "};

std::string_view unary_text(UnaryOperator op) {
  switch (op) {
    case UnaryOperator::kNegate:
      return "-";
    case UnaryOperator::kNot:
      return "!";
    case UnaryOperator::kComplement:
      break;
  }
  return "~";
}

/// Returns whether an element of a vector is a comprehension rather than an expression.
bool is_comprehension(const Expression* element) {
  while (element && element->kind == ExpressionKind::kLet)
    element = as<BodyExpression>(*element).body;
  return element && element->kind >= ExpressionKind::kFor;
}

/// What is still to be printed: a text or an expression.
struct Piece {
  Piece(std::string_view piece) : text(piece) {}
  Piece(const char* piece) : text(piece) {}
  Piece(const Expression* piece) : expression(piece) {}

  std::string_view text;
  const Expression* expression = nullptr;
};

class ExpressionPrinter {
 public:
  ExpressionPrinter(std::string& out, const NameTable& names) : out_(out), names_(names) {}

  /// Prints an expression, or what add_list() left to be printed.
  void print(std::initializer_list<Piece> pieces) {
    add(pieces);
    while (!pending_.empty()) {
      const Piece piece = pending_.back();
      pending_.pop_back();
      out_ += piece.text;
      if (piece.expression) expand(*piece.expression);
    }
  }
  template <typename Entry>
  void add_list(std::span<const Entry> entries) {
    for (size_t i = entries.size(); i-- > 0;) {
      add_entry(entries[i]);
      if (i > 0) add({", "});
    }
  }

 private:
  /// Puts pieces in front of what is pending.
  void add(std::initializer_list<Piece> pieces) {
    pending_.insert(pending_.end(), std::rbegin(pieces), std::rend(pieces));
  }
  template <typename Entry>
  void add_entry(const Entry& entry) {  // an Argument or a Parameter
    if (entry.name == kNoName) {
      add({entry.value});
    } else if (entry.value) {
      add({names_.text(entry.name), " = ", entry.value});
    } else {
      add({names_.text(entry.name)});
    }
  }
  void add_entry(const Expression* const& element) { add({element}); }

  void expand(const Expression& expression);
  void expand(const TernaryExpression& ternary);
  void expand(const CallExpression& call);
  void expand(const RangeExpression& range);
  void expand(const BodyExpression& node);
  void expand(const ForCExpression& loop);
  void expand(const IfExpression& node);

  std::string& out_;
  const NameTable& names_;
  std::vector<Piece> pending_;  // the next one last
};

void ExpressionPrinter::expand(const Expression& expression) {
  switch (expression.kind) {
    case ExpressionKind::kUndef:
      return add({"undef"});
    case ExpressionKind::kBool:
      return add({as<BoolExpression>(expression).value ? "true" : "false"});
    case ExpressionKind::kNumber:
      return append_echo_number(out_, as<NumberExpression>(expression).value);
    case ExpressionKind::kString:
      return append_string_literal(out_, as<StringExpression>(expression).text);
    case ExpressionKind::kVariable:
      return add({names_.text(as<VariableExpression>(expression).name)});
    case ExpressionKind::kUnary: {
      const auto& node = as<UnaryExpression>(expression);
      return add({unary_text(node.op), node.operand});
    }
    case ExpressionKind::kBinary: {
      const auto& node = as<BinaryExpression>(expression);
      return add({"(", node.left, kOperatorTexts[static_cast<size_t>(node.op)], node.right, ")"});
    }
    case ExpressionKind::kTernary:
      return expand(as<TernaryExpression>(expression));
    case ExpressionKind::kIndex: {
      const auto& node = as<IndexExpression>(expression);
      return add({node.container, "[", node.index, "]"});
    }
    case ExpressionKind::kMember: {
      const auto& node = as<MemberExpression>(expression);
      return add({node.container, ".", names_.text(node.member)});
    }
    case ExpressionKind::kCall:
      return expand(as<CallExpression>(expression));
    case ExpressionKind::kVector:
      add({"]"});
      add_list(as<VectorExpression>(expression).elements);
      return add({"["});
    case ExpressionKind::kRange:
      return expand(as<RangeExpression>(expression));
    case ExpressionKind::kFunction: {
      const auto& node = as<FunctionExpression>(expression);
      add({") ", node.body});
      add_list(node.parameters);
      return add({"function("});
    }
    case ExpressionKind::kLet:
    case ExpressionKind::kAssert:
    case ExpressionKind::kEcho:
    case ExpressionKind::kFor:
      return expand(as<BodyExpression>(expression));
    case ExpressionKind::kForC:
      return expand(as<ForCExpression>(expression));
    case ExpressionKind::kIf:
      return expand(as<IfExpression>(expression));
    case ExpressionKind::kEach:
      return add({"each (", as<EachExpression>(expression).element, ")"});
  }
}

void ExpressionPrinter::expand(const TernaryExpression& ternary) {
  add({"(", ternary.condition, " ? ", ternary.then_value, " : ", ternary.else_value, ")"});
}

/// A callee that has no name stands in parentheses.
void ExpressionPrinter::expand(const CallExpression& call) {
  add({")"});
  add_list(call.arguments);
  if (call.callee->kind == ExpressionKind::kVariable) {
    add({call.callee, "("});
  } else {
    add({"(", call.callee, ")("});
  }
}

void ExpressionPrinter::expand(const RangeExpression& range) {
  add({" : ", range.end, "]"});
  if (range.step) add({" : ", range.step});
  add({"[", range.begin});
}

/// The bodies of comprehensions stand in parentheses.
void ExpressionPrinter::expand(const BodyExpression& node) {
  if (is_comprehension(&node)) {
    add({") (", node.body, ")"});
  } else if (node.body) {
    add({") ", node.body});
  } else {
    add({")"});
  }
  add_list(node.arguments);
  switch (node.kind) {
    case ExpressionKind::kAssert:
      return add({"assert("});
    case ExpressionKind::kEcho:
      return add({"echo("});
    case ExpressionKind::kFor:
      return add({"for("});
    default:
      return add({"let("});
  }
}

void ExpressionPrinter::expand(const ForCExpression& loop) {
  add({") ", loop.body});
  add_list(loop.increment);
  add({";", loop.condition, ";"});
  add_list(loop.init);
  add({"for("});
}

void ExpressionPrinter::expand(const IfExpression& node) {
  if (node.else_element) add({" else (", node.else_element, ")"});
  add({"if(", node.condition, ") (", node.then_element, ")"});
}

}  // namespace

void append_expression_text(std::string& out, const Expression& expression,
                            const NameTable& names) {
  ExpressionPrinter(out, names).print({&expression});
}

}  // namespace language
