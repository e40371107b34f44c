#include "base/name_table.hpp"

namespace language {

Name NameTable::intern(std::string_view text) {
  if (const auto found = numbers_.find(text); found != numbers_.end()) return found->second;
  const auto number = static_cast<Name>(texts_.size());
  numbers_.emplace(texts_.emplace_back(text), number);
  return number;
}

Name NameTable::find(std::string_view text) const {
  const auto found = numbers_.find(text);
  return found == numbers_.end() ? kNoName : found->second;
}

}  // namespace language
