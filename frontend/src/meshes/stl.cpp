// STL: facets as bytes or as text.
#include <array>
#include <bit>
#include <cstring>

#include "csg/lexer.hpp"
#include "meshes/number_text.hpp"
#include "meshes/read_solid_file.hpp"

namespace frontend {
namespace {

using csgcore::Vec3;

static_assert(std::endian::native == std::endian::little, "binary STL is read as it is");

constexpr size_t kHeaderBytes = 80, kCountBytes = 4, kFacetBytes = 50;
constexpr size_t kNormalBytes = 12;

bool is_binary(std::string_view bytes) {
  if (bytes.size() < kHeaderBytes + kCountBytes) return false;
  uint32_t count;
  std::memcpy(&count, bytes.data() + kHeaderBytes, sizeof count);
  return bytes.size() == kHeaderBytes + kCountBytes + uint64_t{count} * kFacetBytes;
}

/// The corners are the points in their order.
void number_corners(FaceSet& faces) {
  faces.corners.resize(faces.points.size());
  for (uint32_t i = 0; i < faces.corners.size(); ++i) faces.corners[i] = i;
}

SolidFile read_binary(std::string_view bytes) {
  SolidFile file;
  bytes.remove_prefix(kHeaderBytes + kCountBytes);
  file.faces.points.reserve(bytes.size() / kFacetBytes * 3);
  for (; !bytes.empty(); bytes.remove_prefix(kFacetBytes)) {
    std::array<float, 9> numbers;
    std::memcpy(numbers.data(), bytes.data() + kNormalBytes, sizeof numbers);
    for (size_t i = 0; i < 9; i += 3) {
      file.faces.points.emplace_back(numbers[i], numbers[i + 1], numbers[i + 2]);
    }
  }
  number_corners(file.faces);
  return file;
}

SolidFile read_text(std::string_view text, const std::string& name) {
  SolidFile file;
  std::vector<Vec3>& points = file.faces.points;
  size_t loop = 0;        // where the points of the loop at hand begin
  bool is_whole = false;  // it has three points
  const auto fail = [&](size_t line, std::string_view what, std::string_view found) {
    file = {};
    file.problem = "STL line " + std::to_string(line) + ", " + std::string(what) + " vertex line " +
                   quoted(found) + " importing file '" + name + "'";
  };
  for (size_t number = 1; !text.empty(); ++number) {
    const std::string_view line = trimmed(take_line(text));
    if (line.find("outer loop") != std::string_view::npos) {
      if (!is_whole) points.resize(loop);
      loop = points.size();
      is_whole = false;
      continue;
    }
    const size_t vertex = line.find("vertex");
    if (vertex == std::string_view::npos) continue;
    std::string_view rest = line.substr(vertex + std::string_view("vertex").size());
    if (rest.empty() || !is_blank(rest.front())) continue;
    std::array<std::string_view, 3> words;
    for (std::string_view& word : words) word = take_word(rest);
    if (words[2].empty()) continue;
    if (is_whole) {
      fail(number, "extra", line);
      return file;
    }
    Vec3 point;
    for (int axis = 0; axis < 3; ++axis) {
      const std::optional<double> coordinate = number_of(words[static_cast<size_t>(axis)]);
      if (!coordinate) {
        fail(number, "can't parse", line);
        return file;
      }
      point[axis] = *coordinate;
    }
    points.push_back(point);
    is_whole = points.size() == loop + 3;
  }
  if (!is_whole) points.resize(loop);
  number_corners(file.faces);
  return file;
}

}  // namespace

SolidFile read_stl(std::string_view bytes, const std::string& name) {
  if (is_binary(bytes)) return read_binary(bytes);
  if (bytes.starts_with("solid")) return read_text(bytes, name);
  return {};
}

}  // namespace frontend
