#include "workspace.hpp"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <stdexcept>
#include <utility>

#include "follow/evaluated_design.hpp"
#include "fonts/text_meter.hpp"
#include "frontend/design_file.hpp"
#include "frontend/error.hpp"
#include "frontend/files.hpp"
#include "language/stopped.hpp"
#include "tokens.hpp"

namespace serve {
namespace {

using language::TextOverlay;

/// The most that is kept of what an evaluation says: a loop may say a million things.
constexpr std::size_t kMostSaid = 1000;   // and as many echoes
constexpr std::size_t kMostBytes = 4000;  // of each

/// Returns the text of a design's file; of a mesh or a drawing, that of a design that imports it.
/// Throws frontend::Error.
frontend::FileText text_of_file(const std::string& path) {
  const bool is_imported = frontend::kind_of(path) == frontend::DesignKind::kImported;
  const auto text = is_imported ? frontend::text_in_memory(path) : std::nullopt;
  return text ? *text : frontend::read_regular_file(path);
}

/// Takes a file's text as it is now; the same object if it has not changed.
Document read_again(Document document) {
  try {
    const frontend::FileText text = text_of_file(document.path);
    document.problem.clear();
    if (document.text && document.text->bytes() == text.view()) return document;
    document.text = std::make_shared<const Text>(std::string(text.view()));
  } catch (const frontend::Error& error) {
    document.problem = error.what();
    if (!document.text) document.text = std::make_shared<const Text>("");
  }
  ++document.version;
  return document;
}

/// Turns lines into Said.
class SaidCollector {
 public:
  SaidCollector(const Document& document, std::vector<Said>& said)
      : document_(document), said_(said) {}

  void take(const language::SaidLine& line) {
    using language::MessageGroup;
    const bool is_echo = line.group == MessageGroup::kPlain || line.group == MessageGroup::kEcho;
    if (++(is_echo ? echoes_ : others_) > kMostSaid) return;
    Said said{line.group, std::string(line.what.substr(0, kMostBytes))};
    if (line.place.file != language::kNoFile) {
      const auto& [path, text] = file_of(line);
      said.path = path;
      said.text = text;
      const bool is_behind = line.what.starts_with("Parser error");
      said.span = token_at(*text, line.place.offset, is_behind);
    }
    said_.push_back(std::move(said));
  }

 private:
  using File = std::pair<std::string, TextPointer>;

  const File& file_of(const language::SaidLine& line) {
    const auto [known, is_new] = files_.try_emplace(line.place.file);
    if (!is_new) return known->second;
    const bool is_main = line.place.file == line.files.order().front();
    const language::SourceFile& file = line.files[line.place.file];
    known->second = is_main ? File{document_.path, document_.text}
                            : File{file.path, std::make_shared<const Text>(own_text(file.text))};
    return known->second;
  }

  /// Returns the token at an offset, or before it.
  static Span token_at(const Text& text, uint32_t offset, bool is_behind) {
    offset = std::min(offset, text.size());
    // A token may be long, but what is before it in its line is enough to know where it begins,
    // unless a string or comment has several lines.
    const uint32_t line = text.line_of(offset), start = text.line_start(line);
    const uint32_t end = line + 1 < text.lines() ? text.line_start(line + 1) : text.size();
    Span found{offset, offset};
    for (const Token& token : tokens_of(text.at({start, end}))) {
      const Span span{start + token.span.begin, start + token.span.end};
      if (is_behind ? span.begin < offset : span.begin <= offset && offset < span.end) found = span;
    }
    return found;
  }

  const Document& document_;
  std::vector<Said>& said_;
  std::size_t echoes_ = 0, others_ = 0;
  std::map<language::FileId, File> files_;
};

}  // namespace

std::string own_text(std::string_view text) {
  constexpr std::string_view kAppended = "\n\x03\n";
  if (text.ends_with(kAppended)) text.remove_suffix(kAppended.size());
  return std::string(text);
}

bool has_key(const std::string& path, const std::string& key) {
  // To find a file's key takes longer than to compare names.
  return path.ends_with(std::filesystem::path(key).filename().native()) &&
         TextOverlay::key_of(path) == key;
}

bool Evaluated::depends_on(const std::string& key) const {
  const auto is_file = [&](const std::string& path) { return has_key(path, key); };
  return std::ranges::any_of(files_read, is_file) || std::ranges::any_of(lookups, is_file);
}

Evaluated evaluate(const Document& document, const TextOverlay& overlay,
                   language::LanguageVersion version, const frontend::DesignInputs& inputs,
                   language::EvaluationCache& cache, const std::stop_token& stop) {
  Evaluated result;
  result.text = document.text;
  result.version = document.version;
  result.was_followed = document.followers > 0;
  if (!document.problem.empty()) {
    result.said.push_back({language::MessageGroup::kError, document.problem});
    result.lookups = {document.path};
    return result;
  }
  language::EvaluationOptions options;
  options.language = version;
  options.camera = language::CameraChoice::kWindow;
  options.stop = stop;
  options.parameters = inputs.parameters;
  options.time = inputs.time.value_or(0);
  options.cache = &cache;
  options.overlay = &overlay;
  options.text_meter = frontend::make_text_meter();
  options.wants_values = true;
  options.has_all_digits = frontend::kind_of(document.path) != frontend::DesignKind::kCsg;
  SaidCollector collector(document, result.said);
  language::Evaluation evaluation = language::evaluate(
      document.path, options, [&](const language::SaidLine& line) { collector.take(line); },
      document.text->bytes());
  result.values = std::move(evaluation.values);
  result.files_read = evaluation.files_read;
  result.lookups = evaluation.lookups;
  if (result.was_followed) {
    result.evaluation = std::make_shared<const language::Evaluation>(std::move(evaluation));
  }
  return result;
}

Workspace::Workspace(language::LanguageVersion version, Listener listener)
    : version_(version),
      listener_(std::move(listener)),
      overlay_(std::make_shared<const TextOverlay>()),
      thread_([this](const std::stop_token& stop) { run(stop); }) {}

Workspace::~Workspace() {
  {
    const std::lock_guard lock(mutex_);
    waiting_.clear();
    running_stop_.request_stop();
  }
  thread_.request_stop();
  thread_.join();
}

void Workspace::open(const std::string& key, const std::string& path, int64_t version,
                     TextPointer text) {
  const std::lock_guard lock(mutex_);
  Document document{.key = key, .path = path, .version = version, .text = std::move(text)};
  document.cache = std::make_shared<language::EvaluationCache>();
  const auto before = documents_.find(key);
  if (before != documents_.end()) document.followers = before->second->followers;
  put(std::move(document));
}

void Workspace::change(const std::string& key, int64_t version, TextPointer text) {
  const std::lock_guard lock(mutex_);
  const auto found = documents_.find(key);
  if (found == documents_.end() || !found->second->is_open) return;
  Document document = *found->second;
  document.version = version;
  document.text = std::move(text);
  put(std::move(document));
}

void Workspace::put(Document document) {
  if (document.is_open) set_overlay(document.path, document.text);
  const std::string key = document.key;
  documents_[key] = std::make_shared<const Document>(std::move(document));
  evaluate_later(key, true);
  evaluate_dependents(key);
}

void Workspace::close(const std::string& key) {
  const std::lock_guard lock(mutex_);
  const auto found = documents_.find(key);
  if (found == documents_.end() || !found->second->is_open) return;
  set_overlay(found->second->path, nullptr);
  if (found->second->followers > 0) {
    Document document = *found->second;
    document.is_open = false;
    document.version = 1;
    put(read_again(std::move(document)));
    return;
  }
  forget(found);
  evaluate_dependents(key);
}

void Workspace::forget(std::map<std::string, DocumentPointer>::iterator document) {
  const std::string key = document->first;
  documents_.erase(document);
  std::erase(waiting_, key);
  if (running_ == key) running_stop_.request_stop();
  changed_.notify_all();
}

void Workspace::follow(const std::string& key, const std::string& path) {
  const std::lock_guard lock(mutex_);
  if (!files_) files_.emplace([this] { notice_files(); });
  const auto found = documents_.find(key);
  if (found != documents_.end()) {
    Document document = *found->second;
    ++document.followers;
    found->second = std::make_shared<const Document>(std::move(document));
    if (!found->second->evaluated || !found->second->evaluated->was_followed)
      evaluate_later(key, true);
    return;
  }
  Document document{.key = key, .path = path, .is_open = false, .followers = 1};
  document.cache = std::make_shared<language::EvaluationCache>();
  document = read_again(std::move(document));
  if (!document.problem.empty()) throw std::runtime_error(document.problem);
  put(std::move(document));
}

void Workspace::unfollow(const std::string& key) {
  const std::lock_guard lock(mutex_);
  const auto found = documents_.find(key);
  if (found == documents_.end()) return;
  Document document = *found->second;
  if (--document.followers == 0) {
    if (!document.is_open) return forget(found);
    if (document.evaluated) {  // what it holds of the design is not needed any more
      Evaluated evaluated = *document.evaluated;
      evaluated.evaluation.reset();
      evaluated.was_followed = false;
      document.evaluated = std::make_shared<const Evaluated>(std::move(evaluated));
    }
  }
  found->second = std::make_shared<const Document>(std::move(document));
}

/// Has the followed documents evaluated again. A file that they read has changed.
void Workspace::notice_files() {
  std::vector<std::string> keys;
  {
    const std::lock_guard lock(mutex_);
    for (auto& [key, document] : documents_) {
      if (document->followers == 0) continue;
      keys.push_back(key);
      if (!document->is_open)
        document = std::make_shared<const Document>(read_again(Document(*document)));
      evaluate_later(key, true);
    }
  }
  for (const std::string& key : keys) listener_(key);
}

/// Watches what the followed documents have read from files.
void Workspace::watch_files() {
  if (!files_) return;
  std::vector<std::string> read, missing;
  for (const auto& [key, document] : documents_) {
    if (document->followers == 0 || !document->evaluated) continue;
    const auto is_file = [this](const std::string& path) { return !overlay_->find(path); };
    std::ranges::copy_if(document->evaluated->files_read, std::back_inserter(read), is_file);
    std::ranges::copy_if(document->evaluated->lookups, std::back_inserter(missing), is_file);
  }
  files_->set(read, missing);
}

void Workspace::stop(const std::string& key) {
  const std::lock_guard lock(mutex_);
  std::erase(waiting_, key);
  if (running_ == key) running_stop_.request_stop();
  changed_.notify_all();
}

std::optional<frontend::Activity> Workspace::activity(const std::string& key) const {
  const std::lock_guard lock(mutex_);
  if (running_ == key) {
    if (auto current = running_activity_.current()) return current;
  } else if (std::ranges::find(waiting_, key) == waiting_.end()) {
    return std::nullopt;
  }
  return frontend::Activity{"waiting", -1, std::chrono::steady_clock::now()};
}

void Workspace::notice_change(const std::string& key) {
  const std::lock_guard lock(mutex_);
  if (documents_.contains(key)) evaluate_later(key, true);
  evaluate_dependents(key);
}

void Workspace::set_overlay(const std::string& path, const TextPointer& text) {
  if (path == "-") return;
  auto overlay = std::make_shared<TextOverlay>(*overlay_);
  if (text)
    overlay->set(path, {text, &text->bytes()});
  else
    overlay->erase(path);
  overlay_ = std::move(overlay);
}

void Workspace::evaluate_later(const std::string& key, bool is_first) {
  if (running_ == key) running_stop_.request_stop();
  std::erase(waiting_, key);
  if (is_first)
    waiting_.push_front(key);
  else
    waiting_.push_back(key);
  changed_.notify_all();
}

void Workspace::evaluate_dependents(const std::string& key) {
  for (const auto& [other, document] : documents_)
    if (other != key && document->evaluated && document->evaluated->depends_on(key))
      evaluate_later(other, false);
}

/// Returns whether an evaluation of a document has read what is open now.
bool Workspace::is_up_to_date(const Document& document, const Evaluated& evaluated,
                              const TextOverlay& overlay) const {
  const auto found = documents_.find(document.key);
  if (found == documents_.end() || found->second->text != document.text) return false;
  const auto is_same = [&](const std::string& path) {
    return overlay.find(path) == overlay_->find(path);
  };
  return overlay_.get() == &overlay || (std::ranges::all_of(evaluated.files_read, is_same) &&
                                        std::ranges::all_of(evaluated.lookups, is_same));
}

void Workspace::run(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  for (;;) {
    changed_.wait(lock, stop, [this] { return !waiting_.empty(); });
    if (stop.stop_requested()) return;
    running_ = std::move(waiting_.front());
    waiting_.pop_front();
    const DocumentPointer document = documents_.at(running_);
    const auto overlay = overlay_;
    running_stop_ = {};
    const std::stop_token running_stop = running_stop_.get_token();
    running_activity_.begin("evaluating");
    if (files_) files_->note_reading();
    lock.unlock();
    std::optional<Evaluated> evaluated;
    try {
      evaluated = evaluate(*document, *overlay, version_, {}, *document->cache, running_stop);
    } catch (const language::Stopped&) {
    } catch (const std::exception& error) {  // there is no memory
      evaluated.emplace().text = document->text;
      evaluated->version = document->version;
      evaluated->was_followed = document->followers > 0;
      evaluated->said.push_back({language::MessageGroup::kError, error.what()});
    }
    lock.lock();
    const std::string key = document->key;
    const auto current = documents_.find(key);
    const bool is_waiting = std::ranges::find(waiting_, key) != waiting_.end();
    if (evaluated && current != documents_.end() && !is_waiting) {
      if (is_up_to_date(*document, *evaluated, *overlay)) {
        Document next = *current->second;
        next.evaluated = std::make_shared<const Evaluated>(std::move(*evaluated));
        current->second = std::make_shared<const Document>(std::move(next));
        watch_files();
        running_activity_.end();
        lock.unlock();
        listener_(key);
        lock.lock();
      } else {
        waiting_.push_front(key);
      }
    }
    running_.clear();
    running_activity_.end();
    changed_.notify_all();
  }
}

DocumentPointer Workspace::find(const std::string& key) const {
  const std::lock_guard lock(mutex_);
  const auto found = documents_.find(key);
  return found == documents_.end() ? nullptr : found->second;
}

std::vector<DocumentPointer> Workspace::documents() const {
  const std::lock_guard lock(mutex_);
  std::vector<DocumentPointer> result;
  for (const auto& [key, document] : documents_) result.push_back(document);
  return result;
}

std::shared_ptr<const TextOverlay> Workspace::overlay() const {
  const std::lock_guard lock(mutex_);
  return overlay_;
}

void Workspace::wait_until_evaluated() const {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return waiting_.empty() && running_.empty(); });
}

}  // namespace serve
