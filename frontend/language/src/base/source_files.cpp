#include "language/source_files.hpp"

#include <algorithm>

namespace language {

FileId SourceFiles::add(SourceFile file) {
  files_.push_back(std::move(file));
  return size() - 1;
}

uint32_t SourceFiles::message_line(Place place) const {
  const std::vector<uint32_t>& starts = files_[place.file].message_line_starts;
  const auto next = std::upper_bound(starts.begin(), starts.end(), place.offset);
  return 1 + static_cast<uint32_t>(next - starts.begin());
}

uint32_t SourceFiles::line(Place place) const {
  const std::string& text = files_[place.file].text;
  const auto end = text.begin() + std::min<size_t>(place.offset, text.size());
  return 1 + static_cast<uint32_t>(std::count(text.begin(), end, '\n'));
}

uint32_t SourceFiles::column(Place place) const {
  if (place.offset == 0) return 1;
  const size_t line_feed = files_[place.file].text.rfind('\n', place.offset - 1);
  return place.offset - static_cast<uint32_t>(line_feed == std::string::npos ? 0 : line_feed + 1) +
         1;
}

}  // namespace language
