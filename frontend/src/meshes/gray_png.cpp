#include "meshes/gray_png.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <span>
#include <string>
#include <utility>

#include "meshes/inflate.hpp"

namespace frontend {
namespace {

// The format is that of "Portable Network Graphics (PNG) Specification (Second Edition)", W3C 2003.
constexpr std::string_view kSignature = "\x89PNG\r\n\x1A\n";
enum ColorType : uint8_t {
  kGray = 0,
  kTrueColor = 2,
  kPalette = 3,
  kGrayAlpha = 4,
  kTrueAlpha = 6
};

uint32_t big_endian(std::string_view bytes) {
  uint32_t value = 0;
  for (const char c : bytes.substr(0, 4)) value = value << 8 | static_cast<unsigned char>(c);
  return value;
}

uint8_t byte_at(std::string_view bytes, size_t index) {
  return index < bytes.size() ? static_cast<uint8_t>(bytes[index]) : 0;
}

/// The relative luminance of Rec. 709.
double luminance(double red, double green, double blue) {
  return 0.2126 * red + 0.7152 * green + 0.0722 * blue;
}

struct Header {
  uint32_t columns, rows;
  uint8_t depth, color_type;
  bool is_interlaced;

  size_t channels() const {
    constexpr std::array<uint8_t, 7> kChannels = {1, 0, 3, 1, 2, 0, 4};
    return color_type < kChannels.size() ? kChannels[color_type] : 0;
  }
  bool is_valid() const {
    const bool is_whole = depth == 8 || depth == 16;
    const bool is_small = depth == 1 || depth == 2 || depth == 4;
    if (channels() == 0 || columns == 0 || rows == 0) return false;
    if (color_type == kGray) return is_whole || is_small;
    if (color_type == kPalette) return depth == 8 || is_small;
    return is_whole;
  }
  size_t row_bytes(size_t pixels) const { return (pixels * channels() * depth + 7) / 8; }
  /// Between a byte and the same one of the pixel to its left.
  size_t pixel_bytes() const { return std::max<size_t>(1, channels() * depth / 8); }
};

/// Every `x_step`-th pixel of every `y_step`-th row. A picture that is not interlaced has one pass.
struct Pass {
  size_t x, y, x_step, y_step;
  size_t columns(const Header& header) const { return count(header.columns, x, x_step); }
  size_t rows(const Header& header) const { return count(header.rows, y, y_step); }

 private:
  static size_t count(size_t size, size_t first, size_t step) {
    return size > first ? (size - first + step - 1) / step : 0;
  }
};
constexpr std::array<Pass, 1> kWhole{{{0, 0, 1, 1}}};
constexpr std::array<Pass, 7> kAdam7{{{0, 0, 8, 8},
                                      {4, 0, 8, 8},
                                      {0, 4, 4, 8},
                                      {2, 0, 4, 4},
                                      {0, 2, 2, 4},
                                      {1, 0, 2, 2},
                                      {0, 1, 1, 2}}};

/// The predictor of Paeth.
uint8_t nearest_of(int left, int above, int corner) {
  const int guess = left + above - corner;
  const int to_left = std::abs(guess - left), to_above = std::abs(guess - above),
            to_corner = std::abs(guess - corner);
  if (to_left <= to_above && to_left <= to_corner) return static_cast<uint8_t>(left);
  return static_cast<uint8_t>(to_above <= to_corner ? above : corner);
}

/// Undoes the filter of a row. `above` is the row before, zeros for the first one. Returns false if
/// there is no such filter.
bool undo_filter(uint8_t filter, size_t pixel_bytes, std::string_view above, std::string& row) {
  if (filter > 4) return false;
  for (size_t i = 0; i < row.size(); ++i) {
    const int left = i < pixel_bytes ? 0 : byte_at(row, i - pixel_bytes);
    const int corner = i < pixel_bytes ? 0 : byte_at(above, i - pixel_bytes);
    const int up = byte_at(above, i);
    const std::array<int, 5> predictions = {0, left, up, (left + up) / 2,
                                            nearest_of(left, up, corner)};
    row[i] = static_cast<char>(byte_at(row, i) + predictions[filter]);
  }
  return true;
}

/// The pixels of a row as luminance.
class RowReader {
 public:
  RowReader(const Header& header, std::string_view palette) : header_(header), palette_(palette) {}

  double value(std::string_view row, size_t pixel) const {
    const size_t first = pixel * header_.channels();
    if (header_.color_type == kPalette) {
      const size_t color = 3 * size_t{sample(row, first)};
      return luminance(byte_at(palette_, color), byte_at(palette_, color + 1),
                       byte_at(palette_, color + 2));
    }
    if (header_.channels() >= 3) {
      return luminance(sample(row, first), sample(row, first + 1), sample(row, first + 2));
    }
    const uint8_t gray = sample(row, first);
    if (header_.depth >= 8) return gray;
    return gray * 255 / ((1 << header_.depth) - 1);
  }

 private:
  /// Of 16 bits the upper half counts.
  uint8_t sample(std::string_view row, size_t index) const {
    if (header_.depth >= 8) return byte_at(row, index * header_.depth / 8);
    const size_t bit = index * header_.depth;
    const int shift = 8 - header_.depth - static_cast<int>(bit % 8);
    return static_cast<uint8_t>(byte_at(row, bit / 8) >> shift & ((1 << header_.depth) - 1));
  }

  const Header& header_;
  std::string_view palette_;
};

/// Returns false if the data end too early, or name a filter that does not exist.
bool read_pass(const Header& header, const Pass& pass, const RowReader& reader,
               std::string_view& data, GrayPicture& picture) {
  const size_t columns = pass.columns(header), bytes = header.row_bytes(columns);
  if (columns == 0) return true;
  std::string above(bytes, '\0');
  for (size_t i = 0; i < pass.rows(header); ++i) {
    if (data.size() < bytes + 1) return false;
    std::string row(data.substr(1, bytes));
    if (!undo_filter(byte_at(data, 0), header.pixel_bytes(), above, row)) return false;
    data.remove_prefix(bytes + 1);
    const size_t first = (pass.y + i * pass.y_step) * picture.columns + pass.x;
    for (size_t k = 0; k < columns; ++k) {
      picture.values[first + k * pass.x_step] = reader.value(row, k);
    }
    above = std::move(row);
  }
  return true;
}

struct Chunks {
  std::string_view header, palette;
  std::string data;
};

Chunks read_chunks(std::string_view bytes) {
  constexpr size_t kLengthAndType = 8, kChecksum = 4;
  Chunks chunks;
  bytes.remove_prefix(kSignature.size());
  while (bytes.size() >= kLengthAndType) {
    const size_t length = big_endian(bytes);
    const std::string_view type = bytes.substr(4, 4);
    bytes.remove_prefix(kLengthAndType);
    const std::string_view content = bytes.substr(0, length);
    if (type == "IHDR") chunks.header = content;
    if (type == "PLTE") chunks.palette = content;
    if (type == "IDAT") chunks.data += content;
    if (type == "IEND" || content.size() < length) break;
    bytes.remove_prefix(std::min(bytes.size(), length + kChecksum));
  }
  return chunks;
}

}  // namespace

bool is_png(std::string_view bytes) { return bytes.starts_with(kSignature); }

std::optional<GrayPicture> read_gray_png(std::string_view bytes, size_t most_pixels) {
  constexpr size_t kHeaderBytes = 13;
  const Chunks chunks = read_chunks(bytes);
  if (chunks.header.size() != kHeaderBytes) return std::nullopt;
  const Header header{big_endian(chunks.header), big_endian(chunks.header.substr(4)),
                      byte_at(chunks.header, 8), byte_at(chunks.header, 9),
                      byte_at(chunks.header, 12) == 1};
  if (!header.is_valid() || header.columns > most_pixels / header.rows) return std::nullopt;
  const std::span<const Pass> passes =
      header.is_interlaced ? std::span<const Pass>(kAdam7) : std::span<const Pass>(kWhole);
  size_t size = 0;
  for (const Pass& pass : passes) {
    const size_t columns = pass.columns(header);
    if (columns > 0) size += pass.rows(header) * (header.row_bytes(columns) + 1);
  }
  const std::optional<std::string> rows = inflate(chunks.data, Wrapping::kZlib, size + 1);
  if (!rows) return std::nullopt;
  GrayPicture picture{header.columns, header.rows, {}};
  picture.values.resize(picture.columns * picture.rows);
  std::string_view data = *rows;
  const RowReader reader(header, chunks.palette);
  for (const Pass& pass : passes) {
    if (!read_pass(header, pass, reader, data, picture)) return std::nullopt;
  }
  return picture;
}

}  // namespace frontend
