// STL: facets as bytes or as text.
#include <array>
#include <bit>
#include <cstring>

#include "csg/lexer.hpp"
#include "csgcore/stop_scope.hpp"
#include "meshes/number_text.hpp"
#include "meshes/read_solid_file.hpp"

namespace frontend {
namespace {

using csgcore::Vec3;

static_assert(std::endian::native == std::endian::little, "binary STL is read as it is");

constexpr size_t kHeaderBytes = 80, kCountBytes = 4, kFacetBytes = 50;
constexpr size_t kNormalBytes = 12;

/// Returns the facets that a binary file counts. It has a header and a count.
uint64_t count_of(std::string_view bytes) {
  uint32_t count;
  std::memcpy(&count, bytes.data() + kHeaderBytes, sizeof count);
  return count;
}

bool is_binary(std::string_view bytes) {
  return bytes.size() >= kHeaderBytes + kCountBytes &&
         bytes.size() == kHeaderBytes + kCountBytes + count_of(bytes) * kFacetBytes;
}

/// Says why a file has no facets, of which OpenSCAD says nothing. `name` is quoted.
std::string why_empty(std::string_view bytes, const std::string& name) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF", kSolid = "solid";
  if (bytes.empty()) return name + " is empty";
  if (bytes.starts_with(kByteOrderMark))
    return name + " begins with a byte order mark: nothing is read";
  const bool has_solid = bytes.starts_with(kSolid);
  if (!has_solid && trimmed(bytes.substr(0, kHeaderBytes)).starts_with(kSolid)) {
    return name + " begins with blanks before \"solid\": nothing is read";
  }
  // A text has no byte 0, which a binary file has at least in its count.
  constexpr size_t kBegin = kHeaderBytes + kCountBytes;
  const bool is_text = bytes.substr(0, kBegin).find('\0') == std::string_view::npos;
  if (is_text) {
    return name + (has_solid ? " has no facets" : " is no STL: nothing is read");
  }
  if (bytes.size() < kBegin) return name + " is cut off: nothing is read";
  const uint64_t count = count_of(bytes), size = bytes.size() - kBegin;
  if (count == 0 && size == 0) return name + " has no facets";
  const std::string counted = " counts " + std::to_string(count) + " facets, and ";
  if (size < count * kFacetBytes) {
    return name + " is cut off, or miscounted: it" + counted + "has " +
           std::to_string(size / kFacetBytes) + ": nothing is read";
  }
  return name + " is miscounted: it" + counted + "has " +
         std::to_string(size - count * kFacetBytes) + " bytes behind them: nothing is read";
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
    csgcore::stop_point();
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
  bool is_ended = true;   // a line ends the facet of the loop at hand
  const auto fail = [&](size_t line, std::string_view what, std::string_view found) {
    file = {};
    file.problem = "STL line " + std::to_string(line) + ", " + std::string(what) + " vertex line " +
                   quoted(found) + " importing file '" + name + "'";
  };
  for (size_t number = 1; !text.empty(); ++number) {
    const std::string_view line = trimmed(take_line(text));
    is_ended = is_ended || line.starts_with("endfacet");
    if (line.find("outer loop") != std::string_view::npos) {
      if (!is_whole) points.resize(loop);
      loop = points.size();
      is_whole = is_ended = false;
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
  if (!is_ended) file.problem = "'" + name + "' is cut off: no endfacet ends the last facet";
  return file;
}

}  // namespace

SolidFile read_stl(std::string_view bytes, const std::string& name) {
  SolidFile file;
  if (is_binary(bytes)) {
    file = read_binary(bytes);
  } else if (bytes.starts_with("solid")) {
    file = read_text(bytes, name);
  }
  if (file.problem.empty() && file.faces.points.empty()) {
    file.problem = why_empty(bytes, "'" + name + "'");
  }
  return file;
}

}  // namespace frontend
