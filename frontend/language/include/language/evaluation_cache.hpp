// What the evaluations of a design keep for the next one.
#pragma once

#include <cstddef>
#include <memory>

namespace language {

/// Lives as long as a design is followed (EvaluationOptions::cache). An evaluation with it yields
/// what one without it does. Its memory is bounded by what the last evaluation has used. One
/// evaluation at a time may use it, in any thread. The main file is parsed anew. What is kept:
/// - Statements at the top level of included and used files, as long as the file's bytes do not
///   change, if they stand whole in one file and were parsed without a message, but no block {}.
///   `include` and `use` are looked up anew each time. Definitions there are preparsed, but those
///   in which a file is included, or a variable overwritten. A file counts as unchanged if its
///   device, inode, size and times are, and if it had been at rest for three seconds when it was
///   read; else its bytes are compared.
/// - Top levels of used files, under the conditions that hold within an evaluation (LANGUAGE.md,
///   "Scopes and calls"), if they hold no function values and if the texts of the file and of all
///   that it includes and uses are the same. Values are copied in and out.
class EvaluationCache {
 public:
  EvaluationCache();
  EvaluationCache(const EvaluationCache&) = delete;
  EvaluationCache& operator=(const EvaluationCache&) = delete;
  ~EvaluationCache();

  struct Parts;  // evaluation/evaluation_cache.hpp
  Parts& parts() { return *parts_; }

 private:
  std::unique_ptr<Parts> parts_;
};

}  // namespace language
