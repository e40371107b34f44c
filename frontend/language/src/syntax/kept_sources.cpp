#include "syntax/kept_sources.hpp"

#include <algorithm>

#include "base/read_file.hpp"
#include "syntax/token.hpp"

namespace language {

const KeptStatement* KeptFile::find(uint32_t offset) {
  const auto stands_at = [&](size_t number) {
    return number < statements_.size() &&
           (statements_[number].blank == offset || statements_[number].begin == offset);
  };
  if (statements_.empty() || statements_.back().begin < offset) return nullptr;
  if (!stands_at(next_)) {
    const auto found = std::lower_bound(
        statements_.begin(), statements_.end(), offset,
        [](const KeptStatement& statement, uint32_t wanted) { return statement.begin < wanted; });
    next_ = static_cast<size_t>(found - statements_.begin());
    if (!stands_at(next_)) return nullptr;
  }
  return &statements_[next_++];
}

KeptSources::KeptSources() : files_(1) { add_first_names(names); }

void KeptSources::begin(const std::string& main_path, const std::vector<std::string>& definitions,
                        const TextOverlay* overlay) {
  overlay_ = overlay;
  const bool is_same = main_path == main_path_ && definitions == definitions_;
  main_path_ = main_path;
  definitions_ = definitions;
  for (Entry& entry : files_) {
    entry.is_open = false;
    if (!is_same || (entry.file && !entry.file->is_complete)) entry.file = nullptr;
  }
}

std::shared_ptr<KeptFile> KeptSources::open(
    Role role, const std::string& path, const std::function<std::string(std::string)>& text_of) {
  const auto [known, is_new] =
      numbers_.try_emplace({role, path}, static_cast<FileId>(files_.size()));
  if (is_new) files_.emplace_back();
  Entry& entry = files_[known->second];
  const TextOverlay::Text unsaved = overlay_ ? overlay_->find(path) : nullptr;
  const FileSignature signature = unsaved ? FileSignature() : FileSignature(path);
  const bool is_same = entry.file && signature.has_bytes_of(entry.signature);
  if (!is_same) {
    auto bytes = unsaved ? std::optional(*unsaved) : read_regular_file(path);
    if (!bytes) return nullptr;
    std::string text = text_of(std::move(*bytes));
    if (!entry.file || entry.file->source()->text != text) {
      entry.file = std::make_shared<KeptFile>(known->second, path, std::move(text));
    }
    entry.signature = signature;
  }
  entry.is_open = true;
  return entry.file;
}

void KeptSources::end() {
  for (Entry& entry : files_) {
    if (!entry.file) continue;
    entry.file->is_complete = entry.file->is_read;
    if (!entry.is_open || !entry.file->is_read) entry.file = nullptr;
  }
  overlay_ = nullptr;
}

}  // namespace language
