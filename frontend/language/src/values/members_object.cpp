#include "values/members_object.hpp"

#include <functional>
#include <utility>

#include "language/make.hpp"

namespace language {

bool Value::is_object_true() const {
  switch (type_) {
    case ValueType::kString:
      return !text().empty();
    case ValueType::kVector:
      return !elements().empty();
    case ValueType::kObject:
      return members().size() > 0;
    case ValueType::kRange:
    case ValueType::kFunction:
      return true;
    default:
      return false;
  }
}

size_t MemberTable::find(std::span<const Value> members, std::string_view key) const {
  const auto is_it = [&](size_t position) {
    return members[position + 1].is_set() && members[position].text() == key;
  };
  if (slots_.empty()) {
    for (size_t position = 0; position < members.size(); position += 2)
      if (is_it(position)) return position;
    return kNone;
  }
  const size_t mask = slots_.size() - 1;
  for (size_t slot = std::hash<std::string_view>()(key) & mask; slots_[slot] != 0;
       slot = (slot + 1) & mask)
    if (is_it(slots_[slot] - 1)) return slots_[slot] - 1;
  return kNone;
}

void MemberTable::insert(std::string_view key, uint32_t position) {
  const size_t mask = slots_.size() - 1;
  size_t slot = std::hash<std::string_view>()(key) & mask;
  while (slots_[slot] != 0) slot = (slot + 1) & mask;
  slots_[slot] = position + 1;
}

void MemberTable::add(std::span<const Value> members) {
  if (members.size() <= kFew) return;
  const auto last = static_cast<uint32_t>(members.size() - 2);
  if (members.size() <= slots_.size()) return insert(members[last].text(), last);
  slots_.assign(slots_.empty() ? 4 * kFew : 2 * slots_.size(), 0);  // at most half of them in use
  for (uint32_t position = 0; position <= last; position += 2)
    insert(members[position].text(), position);
}

const Value* MembersObject::find(std::string_view key) const {
  const size_t position = table.find(keys_and_values(), key);
  return position == MemberTable::kNone ? nullptr : &keys_and_values()[position + 1];
}

ObjectWriter::ObjectWriter() : members_(make_vector()) {}

Value* ObjectWriter::find(std::string_view key) {
  const size_t position = table_.find(members_.elements(), key);
  if (position == MemberTable::kNone) return nullptr;
  return static_cast<VectorObject&>(*members_.object()).elements() + position + 1;
}

void ObjectWriter::set(const Value& key, Value value) {
  count_work();
  if (Value* const known = find(key.text())) {
    *known = std::move(value);
    return;
  }
  append_element(members_, key);
  append_element(members_, std::move(value));
  table_.add(members_.elements());
}

void ObjectWriter::set(std::string_view key, Value value) {
  set(make_string(key), std::move(value));
}

void ObjectWriter::remove(std::string_view key) {
  Value* const known = find(key);
  if (!known) return;
  *known = Value::unset();
  ++removed_;
}

Value ObjectWriter::take() {
  if (removed_ > 0) {
    ObjectWriter rest;
    const auto members = members_.elements();
    for (size_t position = 0; position < members.size(); position += 2)
      if (members[position + 1].is_set()) rest.set(members[position], members[position + 1]);
    return rest.take();
  }
  return Value::adopt(new MembersObject(std::move(members_), std::move(table_)));
}

}  // namespace language
