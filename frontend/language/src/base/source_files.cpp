#include "language/source_files.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace language {

namespace {

void find_lines(SourceFile& file) {
  if (!file.line_starts.empty()) return;
  file.line_starts.push_back(0);
  const std::string& text = file.text;
  for (size_t at = text.find('\n'); at != std::string::npos; at = text.find('\n', at + 1)) {
    file.line_starts.push_back(static_cast<uint32_t>(at + 1));
  }
}

}  // namespace

FileId SourceFiles::add(SourceFile file) {
  const FileId number = size();
  add(number, std::make_shared<SourceFile>(std::move(file)));
  return number;
}

void SourceFiles::add(FileId number, std::shared_ptr<SourceFile> file) {
  find_lines(*file);
  if (number >= files_.size()) files_.resize(number + 1);
  files_[number] = std::move(file);
  order_.push_back(number);
}

uint32_t SourceFiles::message_line(Place place) const {
  const std::vector<uint32_t>& starts = files_[place.file]->message_line_starts;
  const auto next = std::upper_bound(starts.begin(), starts.end(), place.offset);
  return 1 + static_cast<uint32_t>(next - starts.begin());
}

SourceFiles::LineStart SourceFiles::line_start(Place place) const {
  const std::vector<uint32_t>& starts = files_[place.file]->line_starts;
  const auto after = std::upper_bound(starts.begin(), starts.end(), place.offset);
  return {*std::prev(after), static_cast<uint32_t>(after - starts.begin() - 1)};
}

uint32_t SourceFiles::line(Place place) const { return line_start(place).number + 1; }

uint32_t SourceFiles::column(Place place) const {
  return place.offset - line_start(place).offset + 1;
}

}  // namespace language
