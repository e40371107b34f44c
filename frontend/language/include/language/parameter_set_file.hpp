// A file of parameter sets, as OpenSCAD's customizer writes it (customizer.hpp).
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "language/parameter_value.hpp"

namespace language {

/// Holds all that stands in the file, in its order, also what it knows nothing of.
class ParameterSetFile {
 public:
  /// Where a text is no JSON.
  struct ParseError {
    size_t line;  // from 1
  };

  /// A file without sets.
  ParameterSetFile();
  /// Throws ParseError.
  explicit ParameterSetFile(std::string_view text);
  ~ParameterSetFile();
  ParameterSetFile(ParameterSetFile&&) noexcept;
  ParameterSetFile& operator=(ParameterSetFile&&) noexcept;

  /// Returns the sets' names, in the file's order.
  std::vector<std::string> names() const;
  /// Returns a set; nothing if there is none of this name. Numbers and words count as the texts
  /// that stand in the file.
  std::optional<ParameterSet> find(const std::string& name) const;
  /// Puts the values into the set of this name. What else stands in it stays. Returns false if the
  /// text is no object, and cannot hold sets.
  [[nodiscard]] bool put(const std::string& name, const ParameterSet& set);
  void erase(const std::string& name);
  /// Returns the file's text. Bytes that are no UTF-8 are replaced.
  std::string text() const;

 private:
  struct Content;
  std::unique_ptr<Content> content_;
};

}  // namespace language
