#include "meshes/height_map.hpp"

#include <spng.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>

#include "csgcore/stop_scope.hpp"
#include "meshes/number_text.hpp"

namespace frontend {
namespace {

/// The relative luminance of Rec. 709.
double luminance(double red, double green, double blue) {
  return 0.2126 * red + 0.7152 * green + 0.0722 * blue;
}

constexpr std::string_view kSignature = "\x89PNG\r\n\x1A\n";

/// Returns the picture without its ancillary chunks, which do not change it: a profile or a comment
/// of a kilobyte may unpack to a gigabyte.
std::string critical_chunks(std::string_view bytes) {
  constexpr size_t kLengthBytes = 4, kTypeBytes = 4, kChecksumBytes = 4;
  std::string result(kSignature);
  bytes.remove_prefix(kSignature.size());
  while (bytes.size() >= kLengthBytes + kTypeBytes) {
    uint64_t size = kLengthBytes + kTypeBytes + kChecksumBytes;
    uint64_t length = 0;
    for (size_t i = 0; i < kLengthBytes; ++i) {
      length = length << 8 | static_cast<unsigned char>(bytes[i]);
    }
    size = std::min<uint64_t>(size + length, bytes.size());
    const char first_of_type = bytes[kLengthBytes];
    if (first_of_type >= 'A' && first_of_type <= 'Z') result += bytes.substr(0, size);
    bytes.remove_prefix(size);
  }
  return result;
}

using csgcore::Vec3;

/// The bottom is below all heights, but not above 0.
double base_below(double lowest) { return std::min(0.0, lowest - 1); }

HeightMap read_picture(std::string_view bytes, const std::string& name, bool is_inverted) {
  HeightMap map;
  const std::optional<GrayPicture> picture = read_gray_png(bytes, kMostCells);
  if (!picture) {
    map.problem = "The picture '" + name + "' is damaged, or has too many pixels";
    return map;
  }
  map.columns = picture->columns;
  map.rows = picture->rows;
  map.heights.resize(picture->values.size());
  for (size_t row = 0; row < map.rows; ++row) {
    for (size_t column = 0; column < map.columns; ++column) {
      const double gray = picture->values[(map.rows - 1 - row) * map.columns + column];
      map.heights[row * map.columns + column] = 100.0 / 255 * (is_inverted ? 1 - gray : gray);
    }
  }
  map.base = base_below(*std::ranges::min_element(map.heights));
  return map;
}

/// Takes what stands before the next blank or tab.
std::string_view take_cell(std::string_view& line) {
  const auto is_separator = [](char c) { return c == ' ' || c == '\t'; };
  while (!line.empty() && is_separator(line.front())) line.remove_prefix(1);
  size_t length = 0;
  while (length < line.size() && !is_separator(line[length])) ++length;
  const std::string_view cell = line.substr(0, length);
  line.remove_prefix(length);
  return cell;
}

HeightMap read_numbers(std::string_view text, const std::string& name) {
  HeightMap map;
  std::vector<double> numbers;
  std::vector<size_t> ends;  // by row, where its numbers end
  double lowest = std::numeric_limits<double>::infinity();
  while (!text.empty() && map.problem.empty()) {
    std::string_view line = trimmed(take_line(text));
    if (line.empty() || line.starts_with('#')) continue;
    while (!line.empty()) {
      const std::optional<double> number = number_of(take_cell(line));
      if (!number) {
        map.problem = "Illegal value in '" + name +
                      "': bad lexical cast: source type value could not be interpreted as target";
        break;
      }
      lowest = std::min(lowest, *number);
      numbers.push_back(*number);
    }
    const size_t begin = ends.empty() ? 0 : ends.back();
    // A row that ends before its first number is none.
    if (numbers.size() == begin) break;
    map.columns = std::max(map.columns, numbers.size() - begin);
    ends.push_back(numbers.size());
  }
  map.rows = ends.size();
  if (map.columns > 0 && map.rows > kMostCells / map.columns) {
    map = {};
    map.problem = "The file '" + name + "' has too many heights";
    return map;
  }
  map.heights.assign(map.columns * map.rows, 0);
  for (size_t row = 0; row < map.rows; ++row) {
    const size_t begin = row == 0 ? 0 : ends[row - 1];
    std::copy(numbers.begin() + static_cast<std::ptrdiff_t>(begin),
              numbers.begin() + static_cast<std::ptrdiff_t>(ends[row]),
              map.heights.begin() + static_cast<std::ptrdiff_t>(row * map.columns));
  }
  map.base = base_below(lowest);
  return map;
}

/// Adds the faces of a height map.
class SolidBuilder {
 public:
  SolidBuilder(const HeightMap& map, bool is_centered) : map_(map) {
    if (is_centered) {
      shift_ = {-(static_cast<double>(map.columns) - 1) / 2,
                -(static_cast<double>(map.rows) - 1) / 2, 0};
    }
    faces_.points.reserve(2 * map.heights.size());
    for (size_t row = 0; row < map.rows; ++row) {
      csgcore::stop_point();
      for (size_t column = 0; column < map.columns; ++column) {
        add_point(static_cast<double>(column), static_cast<double>(row), map.at(column, row));
      }
    }
  }

  FaceSet build() {
    for (size_t row = 0; row + 1 < map_.rows; ++row) {
      csgcore::stop_point();
      for (size_t column = 0; column + 1 < map_.columns; ++column) add_cell(column, row);
    }
    std::vector<uint32_t> bottom;
    const std::vector<uint32_t> rim = this->rim();
    for (const uint32_t top : rim) {
      const Vec3& point = faces_.points[top];
      bottom.push_back(add(Vec3(point.x, point.y, map_.base)));
    }
    for (size_t i = 0; i < rim.size(); ++i) {
      const size_t next = i + 1 < rim.size() ? i + 1 : 0;
      add_face(std::array{bottom[i], bottom[next], rim[next], rim[i]});
    }
    std::reverse(bottom.begin(), bottom.end());
    faces_.corners.insert(faces_.corners.end(), bottom.begin(), bottom.end());
    faces_.end_face();
    return std::move(faces_);
  }

 private:
  uint32_t add(const Vec3& point) {
    faces_.points.push_back(point);
    return static_cast<uint32_t>(faces_.points.size() - 1);
  }
  uint32_t add_point(double x, double y, double z) { return add(Vec3(x, y, z) + shift_); }
  uint32_t top_at(size_t column, size_t row) const {
    return static_cast<uint32_t>(row * map_.columns + column);
  }
  template <size_t N>
  void add_face(const std::array<uint32_t, N>& corners) {
    faces_.corners.insert(faces_.corners.end(), corners.begin(), corners.end());
    faces_.end_face();
  }

  void add_cell(size_t column, size_t row) {
    const std::array<uint32_t, 4> corners = {top_at(column, row), top_at(column + 1, row),
                                             top_at(column + 1, row + 1), top_at(column, row + 1)};
    double sum = 0;
    for (const uint32_t corner : corners) sum += faces_.points[corner].z;
    const uint32_t middle =
        add_point(static_cast<double>(column) + 0.5, static_cast<double>(row) + 0.5, sum / 4);
    for (size_t i = 0; i < 4; ++i) {
      add_face(std::array{corners[i], corners[(i + 1) % 4], middle});
    }
  }

  /// The points at the border, counterclockwise as seen from above.
  std::vector<uint32_t> rim() const {
    const size_t last_column = map_.columns - 1, last_row = map_.rows - 1;
    std::vector<uint32_t> rim;
    for (size_t i = 0; i < last_column; ++i) rim.push_back(top_at(i, 0));
    for (size_t i = 0; i < last_row; ++i) rim.push_back(top_at(last_column, i));
    for (size_t i = last_column; i > 0; --i) rim.push_back(top_at(i, last_row));
    for (size_t i = last_row; i > 0; --i) rim.push_back(top_at(0, i));
    return rim;
  }

  const HeightMap& map_;
  Vec3 shift_{0.0};
  FaceSet faces_;
};

}  // namespace

bool is_png(std::string_view bytes) { return bytes.starts_with(kSignature); }

std::optional<GrayPicture> read_gray_png(std::string_view bytes, size_t most_pixels) {
  const std::unique_ptr<spng_ctx, void (*)(spng_ctx*)> context(spng_ctx_new(0), spng_ctx_free);
  const std::string chunks = critical_chunks(bytes);
  spng_ihdr header;
  if (!context || spng_set_png_buffer(context.get(), chunks.data(), chunks.size()) != 0 ||
      spng_get_ihdr(context.get(), &header) != 0) {
    return std::nullopt;
  }
  GrayPicture picture{header.width, header.height, {}};
  if (picture.rows > most_pixels / picture.columns) return std::nullopt;
  std::vector<unsigned char> rgb(3 * picture.columns * picture.rows);
  if (spng_decode_image(context.get(), rgb.data(), rgb.size(), SPNG_FMT_RGB8, 0) != 0) {
    return std::nullopt;
  }
  picture.values.reserve(rgb.size() / 3);
  for (size_t i = 0; i < rgb.size(); i += 3) {
    picture.values.push_back(luminance(rgb[i], rgb[i + 1], rgb[i + 2]));
  }
  return picture;
}

HeightMap read_height_map(std::string_view bytes, const std::string& name, bool is_inverted) {
  return is_png(bytes) ? read_picture(bytes, name, is_inverted) : read_numbers(bytes, name);
}

FaceSet solid_below(const HeightMap& map, bool is_centered) {
  if (map.columns * map.rows < 2) return {};
  return SolidBuilder(map, is_centered).build();
}

}  // namespace frontend
