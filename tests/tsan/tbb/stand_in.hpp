// A stand-in for the parts of oneTBB that scadray uses, for ThreadSanitizer: the sanitizer cannot
// see how Debian's libtbb, which it has not compiled, hands work from thread to thread, and takes
// that for races. The same work may run in parallel as in oneTBB, but it is dealt out much more
// simply.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

namespace tbb {
namespace stand_in {

constexpr int kThreads = 4;  // unless an arena asks for another number

/// The most threads that may run at once in the arena of this thread.
inline thread_local int concurrency = kThreads;
inline std::atomic<int> helpers_running{0};

/// A thread beside the caller's, if one more may run.
class Helper {
 public:
  template <class Work>
  explicit Helper(Work&& work) {
    const int most = concurrency - 1;
    int running = helpers_running.load();
    do {
      if (running >= most) return;
    } while (!helpers_running.compare_exchange_weak(running, running + 1));
    thread_ = std::thread([this, work, inherited = concurrency] {
      concurrency = inherited;
      try {
        work();
      } catch (...) {
        failure_ = std::current_exception();
      }
    });
  }
  Helper(const Helper&) = delete;
  ~Helper() { join(); }

  bool runs() const { return thread_.joinable(); }
  void join() {
    if (!thread_.joinable()) return;
    thread_.join();
    --helpers_running;
  }
  void join_and_rethrow() {
    join();
    if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
  }

 private:
  std::thread thread_;
  std::exception_ptr failure_;
};

/// Calls call(0) to call(count − 1), by as many threads as may run.
template <class Call>
void call_all(size_t count, const Call& call) {
  std::atomic<size_t> next{0};
  const auto work = [&] {
    for (size_t i = next++; i < count; i = next++) call(i);
  };
  std::vector<std::unique_ptr<Helper>> helpers;
  while (helpers.size() + 1 < std::min<size_t>(count, static_cast<size_t>(concurrency))) {
    helpers.push_back(std::make_unique<Helper>(work));
    if (!helpers.back()->runs()) break;
  }
  work();
  for (const std::unique_ptr<Helper>& helper : helpers) helper->join_and_rethrow();
}

}  // namespace stand_in

template <class Value>
class blocked_range {
 public:
  blocked_range(Value begin, Value end, size_t grain = 1)
      : begin_(begin), end_(end), grain_(grain) {}
  Value begin() const { return begin_; }
  Value end() const { return end_; }
  size_t grainsize() const { return grain_; }

 private:
  Value begin_, end_;
  size_t grain_;
};

template <class Index, class Work>
void parallel_for(Index first, Index last, const Work& work) {
  if (!(first < last)) return;
  stand_in::call_all(static_cast<size_t>(last - first),
                     [&](size_t i) { work(static_cast<Index>(first + static_cast<Index>(i))); });
}

template <class Value, class Work>
void parallel_for(const blocked_range<Value>& range, const Work& work) {
  if (!(range.begin() < range.end())) return;
  const auto count = static_cast<size_t>(range.end() - range.begin());
  constexpr size_t kMostParts = 64;
  const size_t size = std::max({range.grainsize(), count / kMostParts, size_t{1}});
  stand_in::call_all((count + size - 1) / size, [&](size_t part) {
    const size_t begin = part * size;
    const size_t end = std::min(begin + size, count);
    work(blocked_range<Value>(range.begin() + static_cast<Value>(begin),
                              range.begin() + static_cast<Value>(end)));
  });
}

template <class First, class Second>
void parallel_invoke(const First& first, const Second& second) {
  stand_in::Helper helper(first);
  if (!helper.runs()) first();
  second();
  helper.join_and_rethrow();
}

template <class Value>
class enumerable_thread_specific {
 public:
  enumerable_thread_specific() : make_([] { return std::make_unique<Value>(); }) {}
  template <class Make>
  explicit enumerable_thread_specific(Make make)
      : make_([make] { return std::unique_ptr<Value>(new Value(make())); }) {}

  Value& local() {
    const std::lock_guard lock(mutex_);
    std::unique_ptr<Value>& value = values_[std::this_thread::get_id()];
    if (!value) {
      value = make_();
      order_.push_back(value.get());
    }
    return *value;
  }

  class iterator {
   public:
    explicit iterator(Value* const* at) : at_(at) {}
    Value& operator*() const { return **at_; }
    iterator& operator++() { return ++at_, *this; }
    bool operator!=(const iterator& other) const { return at_ != other.at_; }

   private:
    Value* const* at_;
  };
  iterator begin() const { return iterator(order_.data()); }
  iterator end() const { return iterator(order_.data() + order_.size()); }

 private:
  std::function<std::unique_ptr<Value>()> make_;
  std::mutex mutex_;
  std::map<std::thread::id, std::unique_ptr<Value>> values_;
  std::vector<Value*> order_;
};

/// Sorts by one thread.
template <class Iterator, class Less>
void parallel_sort(Iterator begin, Iterator end, const Less& less) {
  std::sort(begin, end, less);
}
template <class Iterator>
void parallel_sort(Iterator begin, Iterator end) {
  std::sort(begin, end);
}

class global_control {
 public:
  enum parameter { max_allowed_parallelism };
  global_control(parameter, size_t) {}
  ~global_control() {
  }  // oneTBB's is no trivial one either: an object that only lives is no unused variable
};

class task_arena {
 public:
  task_arena() = default;
  explicit task_arena(int threads) : threads_(threads) {}

  template <class Work>
  void execute(Work&& work) {
    const int outside = std::exchange(stand_in::concurrency, threads_);
    try {
      work();
    } catch (...) {
      stand_in::concurrency = outside;
      throw;
    }
    stand_in::concurrency = outside;
  }
  template <class Work>
  void enqueue(Work&& work) {
    execute(work);
  }

 private:
  int threads_ = stand_in::kThreads;
};

namespace this_task_arena {
inline int max_concurrency() { return stand_in::concurrency; }
/// A thread takes no other task while it waits here: nothing is to be kept away from it.
template <class Work>
auto isolate(const Work& work) {
  return work();
}
}  // namespace this_task_arena

}  // namespace tbb
