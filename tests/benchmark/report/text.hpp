// Numbers and tables as the report shows them.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <string>
#include <vector>

namespace report {

/// Three digits that count, with commas between thousands: "0.0412", "8.13", "345", "4,320,000";
/// all of a whole number; very small ones, below 0.0001, as "2.1e-13".
std::string number(double value);
/// All digits of a whole number, with commas.
std::string whole_number(double value);
/// "640 MB", "1.72 GB": powers of 1,000.
std::string bytes(double value);
/// "0.31%".
std::string percent(double share);
/// "a", "a and b", "a, b and c".
std::string listed(const std::vector<std::string>& words);
/// With a capital letter first.
std::string capitalised(std::string text);

/// A table in Markdown.
class Table {
 public:
  explicit Table(std::vector<std::string> head) : head_(std::move(head)) {}
  /// As many cells as the head has.
  void add(std::vector<std::string> cells);
  bool empty() const { return rows_.empty(); }
  std::string markdown() const;

 private:
  std::vector<std::string> head_;
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace report
