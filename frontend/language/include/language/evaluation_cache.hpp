// The files that the evaluations of a design keep for the next one.
#pragma once

#include <cstddef>
#include <memory>

#include "language/language_version.hpp"

namespace language {

class KeptSources;

/// Lives as long as a design is followed (EvaluationOptions::cache). An evaluation with it yields
/// what one without it does. Its memory is bounded by what the last evaluation has used. One
/// evaluation at a time may use it, in any thread. The main file is parsed anew. What is kept are
/// statements at the top level of included and used files, as long as the file's bytes do not
/// change, if they stand whole in one file and were parsed without a message, but no block {}.
/// `include` and `use` are looked up anew each time. Definitions there are preparsed, but those in
/// which a file is included, or a variable overwritten. A file counts as unchanged if its device,
/// inode, size and times are, and if it had been at rest for three seconds when it was read; else
/// its bytes are compared.
class EvaluationCache {
 public:
  EvaluationCache();
  EvaluationCache(const EvaluationCache&) = delete;
  EvaluationCache& operator=(const EvaluationCache&) = delete;

  /// To be called when an evaluation begins. Forgets all if names and paths that are no longer used
  /// have become many, or if the language is another one.
  void begin(LanguageVersion language);
  const std::shared_ptr<KeptSources>& sources() const { return sources_; }

 private:
  std::shared_ptr<KeptSources> sources_;
  size_t first_size_ = 0;  // of the sources after the first evaluation; 0: there was none
  LanguageVersion language_ = LanguageVersion::k2021;
};

}  // namespace language
