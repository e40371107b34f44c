// A stack for walks through nested vectors.
#pragma once

#include <array>
#include <cstddef>
#include <memory_resource>
#include <utility>
#include <vector>

namespace language {

/// A stack that takes memory from the heap only beyond a few levels.
template <typename Level>
class LevelStack {
 public:
  LevelStack() { levels_.reserve(kFewLevels); }
  LevelStack(const LevelStack&) = delete;
  LevelStack& operator=(const LevelStack&) = delete;

  template <typename... Arguments>
  void push(Arguments&&... arguments) {
    levels_.emplace_back(std::forward<Arguments>(arguments)...);
  }
  void pop() { levels_.pop_back(); }
  bool empty() const { return levels_.empty(); }
  Level& top() { return levels_.back(); }
  const std::pmr::vector<Level>& levels() const { return levels_; }

 private:
  static constexpr size_t kFewLevels = 4;

  alignas(Level) std::array<std::byte, kFewLevels * sizeof(Level)> room_;
  std::pmr::monotonic_buffer_resource memory_{room_.data(), room_.size()};
  std::pmr::vector<Level> levels_{&memory_};
};

}  // namespace language
