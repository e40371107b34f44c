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
#include <string_view>
#include <thread>
#include <vector>

#include "followed_files.hpp"
#include "frontend/activity.hpp"
#include "frontend/design_file_options.hpp"
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

/// Returns a source file's text without what the evaluator has appended.
std::string own_text(std::string_view text);

/// Returns whether a file is the one of that key.
bool has_key(const std::string& path, const std::string& key);

/// What the evaluation of a version of a document has found.
struct Evaluated {
  TextPointer text;     // of the document
  int64_t version = 0;  // of that text
  std::vector<Said> said;
  bool was_followed = false;  // by anybody who needs the following
  /// Null where nobody did, or where the evaluation has failed for other reasons than the design.
  std::shared_ptr<const language::Evaluation> evaluation;
  /// language::Evaluation's.
  std::map<std::string, std::string, std::less<>> values;
  std::vector<std::string> files_read, lookups;

  /// Returns whether a file was read, or looked for. `key` is a TextOverlay's.
  bool depends_on(const std::string& key) const;
};

/// One version of an open document. It does not change: each edit makes another one.
struct Document {
  std::string key;      // TextOverlay::key_of its path; of one without a file, a name of its own
  std::string path;     // absolute; "-": it has no file
  int64_t version = 0;  // the editor's; of a file that is not open, counted from 1
  TextPointer text{};
  bool is_open = true;  // in the editor; else the text is the file's
  uint32_t followers = 0;
  std::string problem{};                               // why the file cannot be read; empty: it can
  std::shared_ptr<language::EvaluationCache> cache{};  // that all its versions share
  std::shared_ptr<const Evaluated> evaluated{};        // the last; null: there was none
};
using DocumentPointer = std::shared_ptr<const Document>;

/// Evaluates a document among texts that are not saved. `cache` is used by nobody else meanwhile.
/// Throws language::Stopped.
Evaluated evaluate(const Document& document, const language::TextOverlay& overlay,
                   language::LanguageVersion version, const frontend::DesignInputs& inputs,
                   language::EvaluationCache& cache, const std::stop_token& stop);

/// All may be called by any thread.
class Workspace {
 public:
  /// Called by another thread when a document's `evaluated` has changed, or is about to because a
  /// file has.
  using Listener = std::function<void(const std::string& key)>;

  Workspace(language::LanguageVersion version, Listener listener);
  ~Workspace();

  /// Opens a document, or replaces one of that key.
  void open(const std::string& key, const std::string& path, int64_t version, TextPointer text);
  void change(const std::string& key, int64_t version, TextPointer text);
  void close(const std::string& key);
  /// Has the documents evaluated again that a file is, or that depend on it.
  void notice_change(const std::string& key);
  /// Keeps what the document's evaluations make (Evaluated::evaluation), and has it evaluated again
  /// when a file that it has read changes. One that is not open is read from its file, and goes on
  /// so when it is closed. Each call needs an unfollow(). Throws std::runtime_error if the file
  /// cannot be read.
  void follow(const std::string& key, const std::string& path);
  void unfollow(const std::string& key);
  /// Ends a document's evaluation, until something changes.
  void stop(const std::string& key);
  /// Returns what is done for a document, or about to be; nothing if nothing is.
  std::optional<frontend::Activity> activity(const std::string& key) const;

  DocumentPointer find(const std::string& key) const;
  std::vector<DocumentPointer> documents() const;
  std::shared_ptr<const language::TextOverlay> overlay() const;
  language::LanguageVersion language_version() const { return version_; }
  /// Waits until all that is open has been evaluated.
  void wait_until_evaluated() const;

 private:
  void run(const std::stop_token& stop);
  void put(Document document);
  void forget(std::map<std::string, DocumentPointer>::iterator document);
  void set_overlay(const std::string& path, const TextPointer& text);
  void evaluate_later(const std::string& key, bool is_first);
  void evaluate_dependents(const std::string& key);
  void notice_files();
  void watch_files();
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
  frontend::ActivityMeter running_activity_;
  std::jthread thread_;                 // it uses the others, but the next one
  std::optional<FollowedFiles> files_;  // of the followed documents; none before there is one
};

}  // namespace serve
