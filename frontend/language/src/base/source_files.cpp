#include "language/source_files.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace language {

FileId SourceFiles::add(SourceFile file) {
  std::vector<uint32_t>& starts = line_starts_.emplace_back(1, 0);
  const std::string& text = file.text;
  for (size_t at = text.find('\n'); at != std::string::npos; at = text.find('\n', at + 1)) {
    starts.push_back(static_cast<uint32_t>(at + 1));
  }
  files_.push_back(std::move(file));
  return size() - 1;
}

uint32_t SourceFiles::message_line(Place place) const {
  const std::vector<uint32_t>& starts = files_[place.file].message_line_starts;
  const auto next = std::upper_bound(starts.begin(), starts.end(), place.offset);
  return 1 + static_cast<uint32_t>(next - starts.begin());
}

SourceFiles::LineStart SourceFiles::line_start(Place place) const {
  const std::vector<uint32_t>& starts = line_starts_[place.file];
  const auto after = std::upper_bound(starts.begin(), starts.end(), place.offset);
  return {*std::prev(after), static_cast<uint32_t>(after - starts.begin() - 1)};
}

uint32_t SourceFiles::line(Place place) const { return line_start(place).number + 1; }

uint32_t SourceFiles::column(Place place) const {
  return place.offset - line_start(place).offset + 1;
}

}  // namespace language
