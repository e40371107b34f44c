#include <cmath>
#include <optional>

#include "functions/builtin_functions.hpp"
#include "values/value_text.hpp"

namespace language::functions {
namespace {

struct Entry {
  double key, value;
};

// Returns an entry of lookup()'s table, or nothing if it is no pair of numbers.
std::optional<Entry> entry_of(const Value& value) {
  if (!value.is_vector()) return std::nullopt;
  const auto elements = value.elements();
  if (elements.size() != 2 || !elements[0].is_number() || !elements[1].is_number())
    return std::nullopt;
  return Entry{elements[0].number(), elements[1].number()};
}

// The entries next to a key: the greatest below and the least above, as far as there are any.
struct Neighbours {
  double key;
  Entry low, high;

  void see(const Entry& entry) {
    if (entry.key <= key && (entry.key > low.key || low.key > key)) low = entry;
    if (entry.key >= key && (entry.key < high.key || high.key < key)) high = entry;
  }
  double value() const {
    if (key <= low.key) return high.value;
    if (key >= high.key) return low.value;
    const double part = (key - low.key) / (high.key - low.key);
    return high.value * part + low.value * (1 - part);
  }
};

}  // namespace

Value lookup(const FunctionCall& call) {
  const Value &key = call.arguments[0], &table = call.arguments[1];
  if (call.environment.dialect.tells_wrong_arguments) {
    if (!key.is_number()) return not_converted(call, 0, "number");
    if (!table.is_vector()) return no_vector(call, 1);
  }
  if (!key.is_number() || !std::isfinite(key.number())) {
    call.warn("lookup(" + echo_text(key) + ", ...) first argument is not a number");
    return Value::undef();
  }
  if (!table.is_vector()) return no_vector(call, 1);
  if (table.elements().empty()) return Value::undef();
  const auto first = entry_of(table.elements()[0]);
  if (!first) return Value::undef();
  Neighbours neighbours{key.number(), *first, *first};
  for (const Value& element : table.elements().subspan(1))
    if (const auto entry = entry_of(element)) neighbours.see(*entry);
  return neighbours.value();
}

}  // namespace language::functions
