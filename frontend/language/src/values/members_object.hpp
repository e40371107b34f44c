// Objects of the language: names with values, { a = 1; b = [2]; }.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "language/value.hpp"
#include "values/compound_object.hpp"

namespace language {

/// Where the members of a list of keys and values are: a hash table by linear probing (Knuth, The
/// Art of Computer Programming 3, 6.4), where there are more than a few.
class MemberTable {
 public:
  static constexpr size_t kNone = ~size_t{0};

  /// Returns the position of a key, or kNone. Each key is followed by its value; where that is not
  /// set, the member has been removed.
  size_t find(std::span<const Value> members, std::string_view key) const;
  /// Notes the key that stands last but one.
  void add(std::span<const Value> members);

 private:
  static constexpr size_t kFew = 16;  // keys and values that are looked through
  void insert(std::string_view key, uint32_t position);

  std::vector<uint32_t> slots_;  // positions plus 1; 0: free. Empty: there are few members
};

struct MembersObject final : CompoundObject {
  MembersObject(Value list, MemberTable of_list)
      : members(std::move(list)), table(std::move(of_list)) {
    type = ValueType::kObject;
  }
  /// Each key, a string, is followed by its value, in the order in which they were added.
  std::span<const Value> keys_and_values() const { return members.elements(); }
  size_t size() const { return members.elements().size() / 2; }
  /// Returns the value of a key; null: there is none.
  const Value* find(std::string_view key) const;

  const Value members;  // a vector
  const MemberTable table;
};

inline const MembersObject& Value::members() const {
  return static_cast<const MembersObject&>(*payload_.object);
}

/// Fills a new object.
class ObjectWriter {
 public:
  ObjectWriter();
  /// Gives the member of a key, a string, a value: the one that has that key, or a new last one.
  void set(const Value& key, Value value);
  void set(std::string_view key, Value value);
  /// Does nothing if there is no such member.
  void remove(std::string_view key);
  Value take();

 private:
  Value* find(std::string_view key);

  Value members_;
  MemberTable table_;
  size_t removed_ = 0;
};

}  // namespace language
