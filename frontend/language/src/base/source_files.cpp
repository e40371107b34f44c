#include "language/source_files.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "base/read_file.hpp"

namespace language {

std::string SourceFile::canonical_path() const {
  return path.starts_with('/') ? resolved_file(path).string() : path;
}

const std::vector<uint32_t>& SourceFile::line_starts() const {
  std::call_once(has_line_starts_, [this] {
    line_starts_.push_back(0);
    for (size_t at = text.find('\n'); at != text.npos; at = text.find('\n', at + 1)) {
      line_starts_.push_back(static_cast<uint32_t>(at + 1));
    }
  });
  return line_starts_;
}

uint32_t SourceFile::message_line(uint32_t offset) const {
  const auto count_before = [](const std::vector<uint32_t>& offsets, uint32_t end) {
    return std::lower_bound(offsets.begin(), offsets.end(), end) - offsets.begin();
  };
  const auto line = count_before(line_starts(), offset + 1) +
                    count_before(counted_returns_, offset) - count_before(uncounted_feeds_, offset);
  return static_cast<uint32_t>(line);
}

FileId SourceFiles::add(std::string path, std::string text) {
  const FileId number = size();
  add(number, std::make_shared<SourceFile>(std::move(path), std::move(text)));
  return number;
}

void SourceFiles::add(FileId number, std::shared_ptr<SourceFile> file) {
  if (number >= files_.size()) files_.resize(number + 1);
  files_[number] = std::move(file);
  order_.push_back(number);
}

SourceFiles::LineStart SourceFiles::line_start(Place place) const {
  const std::vector<uint32_t>& starts = files_[place.file]->line_starts();
  const auto after = std::upper_bound(starts.begin(), starts.end(), place.offset);
  return {*std::prev(after), static_cast<uint32_t>(after - starts.begin() - 1)};
}

uint32_t SourceFiles::line(Place place) const { return line_start(place).number + 1; }

uint32_t SourceFiles::column(Place place) const {
  return place.offset - line_start(place).offset + 1;
}

}  // namespace language
