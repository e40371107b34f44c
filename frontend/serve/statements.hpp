// Where the statements of a text begin and end, also of one that is broken.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "text.hpp"

namespace serve {

class Statements {
 public:
  explicit Statements(std::string_view text);

  /// Returns the innermost statement that touches an offset: an assignment, a definition, or a call
  /// with its children. Nothing: there is none.
  std::optional<Span> around(std::size_t offset) const;
  /// Returns the part of a statement from an offset in it to its end.
  Span from(uint32_t offset) const;

 private:
  std::vector<Span> spans_;  // by their begins: those within others are behind these
};

}  // namespace serve
