#include <optional>
#include <string>

#include "base/evaluation_thread.hpp"
#include "base/number_text.hpp"
#include "base/utf8.hpp"
#include "functions/builtin_functions.hpp"
#include "language/make.hpp"
#include "values/operators.hpp"
#include "values/value_text.hpp"

namespace language::functions {
namespace {

constexpr size_t kWorkOfText = 16;  // that is made of a number, to compare its first character

uint32_t unsigned_or(const FunctionCall& call, size_t index, uint32_t otherwise) {
  if (index >= call.arguments.size()) return otherwise;
  const Value& argument = call.arguments[index];
  if (!argument.is_number()) return 0;
  return call.environment.dialect.unsigned_integer(argument.number());
}

// What search() looks in, and for how many matches.
class Search {
 public:
  explicit Search(const FunctionCall& call)
      : call_(call),
        table_(call.arguments[1]),
        most_matches_(unsigned_or(call, 2, 1)),
        column_(unsigned_or(call, 3, 0)) {}

  // Returns the indices of the table's entries that are equal to `wanted`, or whose column is.
  Value indices_of(const Value& wanted) const {
    Value indices = make_vector();
    const auto entries = entries_of(table_);
    for (size_t i = 0; i < entries.size() && !has_enough(indices); ++i) {
      count_work();
      if (matches(entries[i], wanted)) append_element(indices, static_cast<double>(i));
    }
    return indices;
  }

  // Returns a list with an element for each of `wanted`.
  Value indices_of_each(std::span<const Value> wanted) const {
    Value result = make_vector(wanted.size());
    for (const Value& element : wanted) {
      Value indices = indices_of(element);
      const bool is_single = most_matches_ == 1 && !indices.elements().empty();
      append_element(result, is_single ? indices.elements()[0] : std::move(indices));
    }
    return result;
  }

  // Returns a list with an element for each code point.
  Value indices_of_characters(std::string_view wanted) const {
    Value result = make_vector();
    for (; const size_t length = code_point_length(wanted); wanted.remove_prefix(length)) {
      const std::string_view character = wanted.substr(0, length);
      const auto indices =
          table_.is_string() ? indices_in_string(character) : indices_in_entries(character);
      if (!indices) return make_vector();
      append_character_result(result, *indices);
    }
    return result;
  }

 private:
  static std::span<const Value> entries_of(const Value& value) {
    return value.is_vector() ? value.elements() : std::span<const Value>();
  }

  bool has_enough(const Value& indices) const {
    return most_matches_ != 0 && indices.elements().size() >= most_matches_;
  }

  bool matches(const Value& entry, const Value& wanted) const {
    if (column_ == 0 && equal(wanted, entry)) return true;
    const auto parts = entries_of(entry);
    return column_ < parts.size() && equal(wanted, parts[column_]);
  }

  void append_character_result(Value& result, const Value& indices) const {
    if (most_matches_ != 1)
      append_element(result, indices);
    else
      append_elements(result, indices.elements());
  }

  Value indices_in_string(std::string_view character) const {
    Value indices = make_vector();
    const uint32_t code_point = first_code_point(character);
    std::string_view rest = table_.text();
    for (double i = 0; !has_enough(indices); ++i) {
      count_work();
      const size_t length = code_point_length(rest);
      if (length == 0) break;
      if (first_code_point(rest) == code_point) append_element(indices, i);
      rest.remove_prefix(length);
    }
    return indices;
  }

  // Returns nothing where an entry has no such column, which ends the whole search.
  std::optional<Value> indices_in_entries(std::string_view character) const {
    Value indices = make_vector();
    const auto entries = entries_of(table_);
    for (size_t i = 0; i < entries.size() && !has_enough(indices); ++i) {
      count_work(kWorkOfText);
      const auto parts = entries_of(entries[i]);
      if (column_ >= parts.size()) {
        warn_of_entry(i, entries[i]);
        return std::nullopt;
      }
      if (begins_with(parts[column_], character)) append_element(indices, static_cast<double>(i));
    }
    if (indices.elements().empty() && call_.environment.dialect.has_old_search)
      call_.warn("search term not found: \"" + std::string(character) + "\"");
    return indices;
  }

  // Returns whether a value's text begins with a character. OpenSCAD 2021.01 looks at the text when
  // it has freed it already, and so finds nothing where the text lies in a block of its own.
  bool begins_with(const Value& value, std::string_view character) const {
    if (!call_.environment.dialect.has_old_search)
      return value.is_string() && !value.text().empty() &&
             first_code_point(value.text()) == first_code_point(character);
    constexpr size_t kLeastBlock = 16;  // bytes from which the text has a block
    std::string text;
    append_str_text(text, value);
    return !text.empty() && text.size() < kLeastBlock &&
           first_code_point(text) == first_code_point(character);
  }

  void warn_of_entry(size_t index, const Value& entry) const {
    call_.warn("Invalid entry in search vector at index " + std::to_string(index) +
               ", required number of values in the entry: " +
               std::to_string(column_ + uint32_t{1}) + ". Invalid entry: " + echo_text(entry));
  }

  const FunctionCall& call_;
  const Value& table_;
  uint32_t most_matches_;  // 0: all
  uint32_t column_;
};

}  // namespace

Value search(const FunctionCall& call) {
  const Search search(call);
  const Value& wanted = call.arguments[0];
  if (wanted.is_number()) return search.indices_of(wanted);
  if (wanted.is_string()) return search.indices_of_characters(wanted.text());
  if (wanted.is_vector()) return search.indices_of_each(wanted.elements());
  return Value::undef();
}

}  // namespace language::functions
