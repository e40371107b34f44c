// What the parts of an evaluation have depended on, each part with those within it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace language {

/// Parts nest like calls. Each notes a set of numbers; when one ends, the part around it notes what
/// still concerns it. Noting costs the same whatever the depth. The sets are sparse (Briggs and
/// Torczon 1993, "An efficient representation for sparse sets").
class DependencyLog {
 public:
  /// Numbers to be noted are less than `numbers`.
  explicit DependencyLog(size_t numbers) : last_(numbers, 0) {}

  void begin() { starts_.push_back(static_cast<uint32_t>(entries_.size())); }
  /// Returns whether the innermost part has noted a number.
  bool has(uint32_t number) const { return is_in(number, starts_.back(), last_[number]); }
  /// Notes a number in the innermost part.
  void note(uint32_t number) {
    if (has(number)) return;
    entries_.push_back({number, last_[number]});
    last_[number] = static_cast<uint32_t>(entries_.size() - 1);
  }
  /// Calls `visit` with each number of the innermost part.
  template <typename Visit>
  void for_each(Visit visit) const {
    for (size_t i = starts_.back(); i < entries_.size(); ++i) visit(entries_[i].number);
  }
  /// Ends the innermost part. The one around it notes the numbers for which `concerns` holds.
  template <typename Predicate>
  void end(Predicate concerns) {
    const uint32_t start = starts_.back();
    starts_.pop_back();
    uint32_t kept = start;
    for (uint32_t i = start; i < entries_.size(); ++i) {
      const Entry entry = entries_[i];
      const bool is_known = starts_.empty() || (entry.before < start &&
                                                is_in(entry.number, starts_.back(), entry.before));
      if (is_known || !concerns(entry.number)) {
        last_[entry.number] = entry.before;
        continue;
      }
      entries_[kept] = entry;
      last_[entry.number] = kept++;
    }
    entries_.resize(kept);
  }

 private:
  struct Entry {
    uint32_t number;
    uint32_t before;  // last_ of the number when it was noted
  };
  /// Returns whether a number stands at a position, which is in the part from `start` on.
  bool is_in(uint32_t number, uint32_t start, uint32_t position) const {
    return position >= start && position < entries_.size() && entries_[position].number == number;
  }

  std::vector<uint32_t> starts_;
  std::vector<Entry> entries_;
  std::vector<uint32_t> last_;  // by number: the position where it may stand
};

}  // namespace language
