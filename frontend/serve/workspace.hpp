// Open documents, and the thread that evaluates them.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "language/evaluation.hpp"
#include "language/evaluation_cache.hpp"
#include "language/text_overlay.hpp"
#include "text.hpp"

namespace serve {

/// Something that an evaluation has said.
struct Said {
  language::MessageGroup group;
  std::string what;    // without the group and the place
  std::string path{};  // of the file where its cause stands; empty: none is known
  TextPointer text{};  // of that file, as it was evaluated
  Span span{};         // of the token at the cause
};

/// What the evaluation of a version of a document has found.
struct Evaluated {
  TextPointer text;  // of the document
  std::vector<Said> said;
  /// language::Evaluation's.
  std::map<std::string, std::string, std::less<>> values;
  std::vector<std::string> files_read, lookups;

  /// Returns whether a file was read, or looked for. `key` is a TextOverlay's.
  bool depends_on(const std::string& key) const;
};

/// One version of an open document. It does not change: each edit makes another one.
struct Document {
  std::string key;   // TextOverlay::key_of its path; of one without a file, a name of its own
  std::string path;  // absolute; "-": it has no file
  int64_t version = 0;
  TextPointer text;
  std::shared_ptr<language::EvaluationCache> cache;  // that all its versions share
  std::shared_ptr<const Evaluated> evaluated;        // the last; null: there was none
};
using DocumentPointer = std::shared_ptr<const Document>;

/// Evaluates a document among texts that are not saved. Throws language::Stopped.
Evaluated evaluate(const Document& document, const language::TextOverlay& overlay,
                   language::LanguageVersion version, const std::stop_token& stop);

/// All may be called by any thread.
class Workspace {
 public:
  /// Called by the evaluation's thread when a document's `evaluated` has changed.
  using Listener = std::function<void(const std::string& key)>;

  Workspace(language::LanguageVersion version, Listener listener);
  ~Workspace();

  /// Opens a document, or replaces one of that key.
  void open(const std::string& key, const std::string& path, int64_t version, TextPointer text);
  void change(const std::string& key, int64_t version, TextPointer text);
  void close(const std::string& key);
  /// Has the documents evaluated again that a file is, or that depend on it.
  void notice_change(const std::string& key);

  DocumentPointer find(const std::string& key) const;
  std::vector<DocumentPointer> documents() const;
  std::shared_ptr<const language::TextOverlay> overlay() const;
  language::LanguageVersion language_version() const { return version_; }
  /// Waits until all that is open has been evaluated.
  void wait_until_evaluated() const;

 private:
  void run(const std::stop_token& stop);
  void put(Document document);
  void set_overlay(const std::string& path, const TextPointer& text);
  void evaluate_later(const std::string& key, bool is_first);
  void evaluate_dependents(const std::string& key);
  bool is_up_to_date(const Document& document, const Evaluated& evaluated,
                     const language::TextOverlay& overlay) const;

  const language::LanguageVersion version_;
  const Listener listener_;
  mutable std::mutex mutex_;
  mutable std::condition_variable_any changed_;
  std::map<std::string, DocumentPointer> documents_;
  std::shared_ptr<const language::TextOverlay> overlay_;
  std::deque<std::string> waiting_;  // keys, each once
  std::string running_;              // the key that is being evaluated; empty: none
  std::stop_source running_stop_;    // of that
  std::jthread thread_;              // the last member: it uses the others
};

}  // namespace serve
