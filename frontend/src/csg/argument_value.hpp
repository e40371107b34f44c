// The values of nodes' arguments, as their readers see them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "language/node_tree.hpp"

namespace frontend {

enum class ValueKind : uint8_t { kUndef, kBool, kNumber, kString, kList };

class ValueList;

/// The value of an argument or an element of one, in the tree, which must outlive it: it copies
/// nothing. Ranges and functions, which no node takes, are undef.
class ArgumentValue {
 public:
  ArgumentValue() = default;  // undef
  ArgumentValue(const language::NodeTree& tree, const language::NodeArgument& argument);
  explicit ArgumentValue(const language::Value& value) : value_(&value) {}

  ValueKind kind() const;
  bool is_undef() const { return kind() == ValueKind::kUndef; }
  bool is_number() const { return kind() == ValueKind::kNumber; }
  bool is_string() const { return kind() == ValueKind::kString; }
  bool is_list() const { return kind() == ValueKind::kList; }
  bool is_true() const { return kind() == ValueKind::kBool && boolean(); }

  // Each of the following may be called for values of that kind only.
  bool boolean() const { return value_->boolean(); }
  double number() const { return form_ == Form::kValue ? value_->number() : *numbers_; }
  std::string_view text() const { return value_->text(); }
  ValueList elements() const;

 private:
  friend class ValueList;
  /// Where the value is.
  enum class Form : uint8_t {
    kValue,    // in `value_`; null: undef
    kNumber,   // it is the number at `numbers_`
    kNumbers,  // it is a list of `count_` numbers
    kRows,     // a list of lists of kColumns numbers, `count_` in all
  };
  static constexpr uint32_t kColumns = 4;

  ArgumentValue(Form form, uint32_t count, const double* numbers)
      : form_(form), count_(count), numbers_(numbers) {}

  Form form_ = Form::kValue;
  uint32_t count_ = 0;
  union {
    const language::Value* value_ = nullptr;
    const double* numbers_;
  };
};

/// The elements of a list.
class ValueList {
 public:
  ValueList() = default;
  explicit ValueList(const ArgumentValue& list) : list_(list) {}

  size_t size() const;
  bool empty() const { return size() == 0; }
  ArgumentValue operator[](size_t index) const;

  class Iterator {
   public:
    Iterator(const ValueList& list, size_t index) : list_(list), index_(index) {}
    ArgumentValue operator*() const { return list_[index_]; }
    Iterator& operator++() {
      ++index_;
      return *this;
    }
    bool operator!=(const Iterator& other) const { return index_ != other.index_; }

   private:
    const ValueList& list_;
    size_t index_;
  };
  Iterator begin() const { return {*this, 0}; }
  Iterator end() const { return {*this, size()}; }

 private:
  ArgumentValue list_;  // undef: there are none
};

inline ArgumentValue::ArgumentValue(const language::NodeTree& tree,
                                    const language::NodeArgument& argument)
    : value_(&argument.value) {
  if (argument.number_count == 0) return;
  const bool is_matrix = argument.style == language::ArgumentStyle::kMatrix ||
                         argument.style == language::ArgumentStyle::kGeneralMatrix;
  *this = ArgumentValue(is_matrix ? Form::kRows : Form::kNumbers, argument.number_count,
                        tree.numbers_of(argument).data());
}

inline ValueKind ArgumentValue::kind() const {
  if (form_ == Form::kNumber) return ValueKind::kNumber;
  if (form_ != Form::kValue) return ValueKind::kList;
  if (value_ == nullptr) return ValueKind::kUndef;
  switch (value_->type()) {
    case language::ValueType::kBool:
      return ValueKind::kBool;
    case language::ValueType::kNumber:
      return ValueKind::kNumber;
    case language::ValueType::kString:
      return ValueKind::kString;
    case language::ValueType::kVector:
      return ValueKind::kList;
    default:
      return ValueKind::kUndef;
  }
}

inline ValueList ArgumentValue::elements() const { return ValueList(*this); }

inline size_t ValueList::size() const {
  switch (list_.form_) {
    case ArgumentValue::Form::kRows:
      return list_.count_ / ArgumentValue::kColumns;
    case ArgumentValue::Form::kNumbers:
      return list_.count_;
    default:
      return list_.value_ == nullptr ? 0 : list_.value_->elements().size();
  }
}

inline ArgumentValue ValueList::operator[](size_t index) const {
  using Form = ArgumentValue::Form;
  constexpr size_t kColumns = ArgumentValue::kColumns;
  switch (list_.form_) {
    case Form::kRows:
      return {Form::kNumbers, kColumns, list_.numbers_ + index * kColumns};
    case Form::kNumbers:
      return {Form::kNumber, 1, list_.numbers_ + index};
    default:
      return ArgumentValue(list_.value_->elements()[index]);
  }
}

}  // namespace frontend
