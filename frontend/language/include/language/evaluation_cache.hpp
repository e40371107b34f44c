// What the evaluations of a design keep for the next one.
#pragma once

#include <cstddef>
#include <memory>

namespace language {

/// Lives as long as a design is followed (EvaluationOptions::cache). An evaluation with it yields
/// what one without it does. It keeps the statements of included and used files whose texts do not
/// change, the top levels of used files, and calls of modules with the nodes that they have made
/// (LANGUAGE.md, "What is kept between evaluations"). Its memory is bounded by what the last
/// evaluation has used. One evaluation at a time may use it, in any thread.
class EvaluationCache {
 public:
  EvaluationCache();
  EvaluationCache(const EvaluationCache&) = delete;
  EvaluationCache& operator=(const EvaluationCache&) = delete;
  ~EvaluationCache();

  struct Parts;  // evaluation/cache_parts.hpp
  Parts& parts() { return *parts_; }

 private:
  std::unique_ptr<Parts> parts_;
};

}  // namespace language
