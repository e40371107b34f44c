#include "mutation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <iterator>
#include <numbers>
#include <utility>

namespace slow_search {
namespace {

using Range = std::pair<std::size_t, std::size_t>;

std::string number_text(double number) {
  std::array<char, 32> text;
  std::snprintf(text.data(), text.size(), "%g", number);
  return text.data();
}

std::size_t bytes_of(const Design& design) {
  std::size_t bytes = 0;
  for (const Token& token : design) bytes += token.head.size() + 2;
  return bytes;
}

class Mutator {
 public:
  Mutator(const Design& design, const Design& other, Random& random)
      : design_(design), other_(other), random_(random) {}

  Design run() {
    const int changes = random_.from_to(1, 4);
    for (int i = 0; i < changes; ++i) {
      const Design before = design_;
      change();
      if (bytes_of(design_) > kMostBytes) design_ = before;
    }
    return std::move(design_);
  }

 private:
  void change() {
    if (design_.empty()) {
      design_ = other_;
      return;
    }
    switch (random_.below(12)) {
      case 0:
        return repeat(2);
      case 1:
      case 2:
        return repeat(std::size_t{2} << random_.below(7));
      case 3:
        return remove();
      case 4:
        return unwrap();
      case 5:
      case 6:
        return wrap();
      case 7:
        return move();
      case 8:
        return transplant();
      case 9:
        return exchange_operation();
      default:
        return change_numbers();
    }
  }

  /// Returns the place of a token that begins a subtree; size() if there is none.
  std::size_t any_begin(const Design& design) {
    std::vector<std::size_t> begins;
    for (std::size_t i = 0; i < design.size(); ++i) {
      if (design[i].kind != Kind::kClose) begins.push_back(i);
    }
    return begins.empty() ? design.size() : begins[random_.below(begins.size())];
  }

  /// Small subtrees are the most frequent, so that one in three is replaced by the subtree around
  /// it.
  Range any_subtree(const Design& design) {
    std::size_t begin = any_begin(design);
    while (begin > 0 && design[begin - 1].kind == Kind::kOpen && random_.one_in(3)) --begin;
    return {begin, begin < design.size() ? subtree_end(design, begin) : begin};
  }

  static Design part_of(const Design& design, Range range) {
    const auto begin = design.begin();
    return {begin + static_cast<std::ptrdiff_t>(range.first),
            begin + static_cast<std::ptrdiff_t>(range.second)};
  }

  void insert(std::size_t at, const Design& part) {
    design_.insert(design_.begin() + static_cast<std::ptrdiff_t>(at), part.begin(), part.end());
  }

  void erase(Range range) {
    design_.erase(design_.begin() + static_cast<std::ptrdiff_t>(range.first),
                  design_.begin() + static_cast<std::ptrdiff_t>(range.second));
  }

  /// Repeats a subtree `times` times in all, each copy shifted by the same step, which is often 0.
  void repeat(std::size_t times) {
    const Range range = any_subtree(design_);
    const Design part = part_of(design_, range);
    times = std::min(times, 1 + kMostBytes / (bytes_of(part) + 1));
    const bool is_shifted = !random_.one_in(3);
    std::array<double, 3> step{};
    for (double& s : step) {
      if (random_.one_in(2)) s = random_.between(-1, 1) * std::pow(10, random_.from_to(-4, 1));
    }
    Design copies;
    for (std::size_t i = 1; i < times; ++i) {
      if (is_shifted) {
        std::string head = "multmatrix([";
        for (std::size_t row = 0; row < 3; ++row) {
          for (std::size_t column = 0; column < 3; ++column) {
            head += (column == 0 ? "[" : ",") + std::string(row == column ? "1" : "0");
          }
          head += "," + number_text(step[row] * static_cast<double>(i)) + "],";
        }
        copies.push_back({Kind::kOpen, head + "[0,0,0,1]])"});
      }
      copies.insert(copies.end(), part.begin(), part.end());
      if (is_shifted) copies.push_back({Kind::kClose, {}});
    }
    insert(range.second, copies);
  }

  void remove() { erase(any_subtree(design_)); }

  /// Replaces a node by its children, if it has any.
  void unwrap() {
    const Range range = any_subtree(design_);
    if (range.first == range.second || design_[range.first].kind != Kind::kOpen) return;
    erase({range.second - 1, range.second});
    erase({range.first, range.first + 1});
  }

  void wrap() {
    const Range range = any_subtree(design_);
    std::string head;
    switch (random_.below(6)) {
      case 0:
        head = any_matrix();
        break;
      case 1:
        if (range.first < range.second) head = design_[range.first].head;
        if (range.first == range.second || head.starts_with('#') || head.starts_with('%')) return;
        design_[range.first].head = (random_.one_in(2) ? "#" : "%") + head;
        return;
      default:
        head = std::string(any_operation()) + "()";
    }
    insert(range.second, {{Kind::kClose, {}}});
    insert(range.first, {{Kind::kOpen, head}});
  }

  void move() {
    const Range range = any_subtree(design_);
    const Design part = part_of(design_, range);
    erase(range);
    insert(any_begin(design_), part);
  }

  void transplant() {
    const Design part = part_of(other_, any_subtree(other_));
    const Range range = any_subtree(design_);
    if (random_.one_in(2)) erase(range);
    insert(range.first, part);
  }

  const char* any_operation() {
    constexpr const char* kOperations[] = {"union", "difference", "intersection"};
    return kOperations[random_.below(std::size(kOperations))];
  }

  void exchange_operation() {
    std::vector<std::size_t> operations;
    for (std::size_t i = 0; i < design_.size(); ++i) {
      const std::string& head = design_[i].head;
      if (head == "union()" || head == "difference()" || head == "intersection()" ||
          head == "group()") {
        operations.push_back(i);
      }
    }
    if (operations.empty()) return wrap();
    design_[operations[random_.below(operations.size())]].head =
        std::string(any_operation()) + "()";
  }

  std::string any_matrix() {
    const double angle_deg =
        random_.one_in(2) ? random_.from_to(1, 7) * 45 : random_.between(0, 360);
    const double c = std::cos(angle_deg * std::numbers::pi / 180);
    const double s = std::sin(angle_deg * std::numbers::pi / 180);
    const double stretch = random_.one_in(4) ? std::pow(10, random_.between(-3, 1)) : 1;
    const std::array<std::string, 3> values = {number_text(c), number_text(-s), number_text(s)};
    const std::string z = number_text(stretch);
    switch (random_.below(3)) {
      case 0:
        return "multmatrix([[" + values[0] + "," + values[1] + ",0,0],[" + values[2] + "," +
               values[0] + ",0,0],[0,0," + z + ",0],[0,0,0,1]])";
      case 1:
        return "multmatrix([[" + z + ",0,0,0],[0," + values[0] + "," + values[1] + ",0],[0," +
               values[2] + "," + values[0] + ",0],[0,0,0,1]])";
      default:
        return "multmatrix([[1,0,0," + number_text(random_.between(-20, 20)) + "],[0,1,0," +
               number_text(random_.between(-20, 20)) + "],[0,0,1," +
               number_text(random_.between(-20, 20)) + "],[0,0,0,1]])";
    }
  }

  /// Changes one number of one node, or of all nodes of the same name, so that sizes change
  /// together, or one by one.
  void change_numbers() {
    const std::size_t at = any_begin(design_);
    if (at == design_.size()) return;
    const std::string name = design_[at].head.substr(0, design_[at].head.find('('));
    const bool changes_all = random_.one_in(3);
    const std::size_t way = random_.below(6);
    const double factor = std::pow(10, random_.between(-1, 1));
    for (std::size_t i = changes_all ? 0 : at; i < design_.size(); ++i) {
      std::string& head = design_[i].head;
      if (head.substr(0, head.find('(')) == name) change_numbers(head, way, factor);
      if (!changes_all) break;
    }
  }

  void change_numbers(std::string& head, std::size_t way, double factor) {
    const std::vector<NumberPlace> places = numbers_of(head);
    if (places.empty()) return;
    const NumberPlace place = places[random_.below(places.size())];
    const double number = std::strtod(head.substr(place.begin, place.length).c_str(), nullptr);
    const NumberPlace& source = places[random_.below(places.size())];
    double result = 0;
    switch (way) {
      case 0:
        break;
      case 1:
        result = number * factor;
        break;
      case 2:
        result = number * (1 + 1e-3 * random_.between(-1, 1));
        break;
      case 3:
        result = number + random_.between(-10, 10);
        break;
      case 4:
        result = std::round(number);
        break;
      default:
        result = std::strtod(head.substr(source.begin, source.length).c_str(), nullptr);
    }
    head.replace(place.begin, place.length, number_text(result));
  }

  Design design_;
  const Design& other_;
  Random& random_;
};

}  // namespace

Design mutated(const Design& design, const Design& other, Random& random) {
  return Mutator(design, other, random).run();
}

}  // namespace slow_search
