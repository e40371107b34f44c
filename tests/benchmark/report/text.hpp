// Formats numbers and tables for the report.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <string>
#include <vector>

namespace report {

/// Writes three significant digits, with commas between thousands: "0.0412", "8.13", "345",
/// "4,320,000"; all digits of an integer; numbers below 0.0001 as "2.1e-13".
std::string number(double value);
/// Writes all digits of an integer, with commas.
std::string whole_number(double value);
/// Writes "640 MB", "1.72 GB", in powers of 1,000.
std::string bytes(double value);
/// Writes "0.31%".
std::string percent(double share);
/// Writes "a", "a and b", "a, b and c".
std::string listed(const std::vector<std::string>& words);
/// Makes the first letter a capital.
std::string capitalised(std::string text);

/// A table in Markdown.
class Table {
 public:
  explicit Table(std::vector<std::string> head) : head_(std::move(head)) {}
  /// Adds a row, with as many cells as the head has.
  void add(std::vector<std::string> cells);
  bool empty() const { return rows_.empty(); }
  std::string markdown() const;

 private:
  std::vector<std::string> head_;
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace report
