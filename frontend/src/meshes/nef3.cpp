// NEF3: a solid with exact numbers, as CGAL writes it.

#include <array>
#include <charconv>
#include <cmath>

#include "meshes/number_text.hpp"
#include "meshes/read_solid_file.hpp"

namespace frontend {

// A .nef3 lists, one in a line, with whole numbers and marks (1: part of the solid):
//
//   vertices     number { … | x y z w } mark               the point (x, y, z)/w
//   half-edges   number { twin, vertex, … | … } mark
//   half-facets  number { twin, rings, loops, volume | plane } mark
//   volumes      number { shells } mark
//   shalfedges   number { twin, …, …, half-edge, sface, previous, next, half-facet | … } mark
//
// and then shalfloops and sfaces. A shalfedge is a corner of a half-facet: it lies at the vertex of
// its half-edge, and `next` is the half-facet's next corner. `rings` has one corner of each ring.

namespace {

using csgcore::Vec3;

/// A whole number as `digits` · 10^exponent, with its first digits.
struct WholeNumber {
  long double digits = 0;
  int exponent = 0;
};

std::optional<WholeNumber> whole_number(std::string_view word) {
  constexpr size_t kMostDigits = 19;  // of those that are exact in 64 bits
  const bool is_negative = word.starts_with('-');
  if (is_negative) word.remove_prefix(1);
  if (word.empty() || word.find_first_not_of("0123456789") != std::string_view::npos) {
    return std::nullopt;
  }
  const std::string_view first = word.substr(0, kMostDigits);
  uint64_t value = 0;
  std::from_chars(first.data(), first.data() + first.size(), value);
  WholeNumber number{static_cast<long double>(value), static_cast<int>(word.size() - first.size())};
  if (is_negative) number.digits = -number.digits;
  return number;
}

double ratio(const WholeNumber& a, const WholeNumber& b) {
  const long double digits = a.digits / b.digits;
  const int exponent = a.exponent - b.exponent;
  return static_cast<double>(exponent == 0 ? digits : digits * powl(10.0L, exponent));
}

/// Between its braces a line has lists of numbers, which commas separate, and others behind a bar.
struct Line {
  std::string_view lists, behind_bar;
  bool mark = false;

  std::string_view list(size_t index) const {
    std::string_view rest = lists;
    for (; index > 0; --index) {
      const size_t comma = rest.find(',');
      if (comma == std::string_view::npos) return {};
      rest.remove_prefix(comma + 1);
    }
    return rest.substr(0, rest.find(','));
  }
  std::optional<uint32_t> index(size_t list_index) const {
    std::string_view words = list(list_index);
    return index_of(take_word(words));
  }
};

struct Facet {
  uint32_t twin, volume;
  std::vector<uint32_t> rings;
};

struct NefCorner {
  uint32_t half_edge, next;
};

class NefText {
 public:
  explicit NefText(std::string_view text) : rest_(text) {}

  std::optional<RingedFaces> read() {
    if (trimmed(take_line(rest_)) != "Selective Nef Complex") return std::nullopt;
    if (trimmed(take_line(rest_)) != "standard") return std::nullopt;
    const bool is_read = read_counts() && read_vertices() && read_half_edges() && read_facets() &&
                         read_volumes() && read_corners() && pass(count_[5]) && pass(count_[6]);
    if (!is_read) return std::nullopt;
    add_faces();
    return std::move(faces_);
  }

 private:
  bool read_counts() {
    static constexpr std::array<std::string_view, 7> kNames{
        "vertices", "halfedges", "facets", "volumes", "shalfedges", "shalfloops", "sfaces"};
    for (size_t i = 0; i < kNames.size(); ++i) {
      std::string_view line = take_line(rest_);
      const bool is_named = take_word(line) == kNames[i];
      const std::optional<uint32_t> count = index_of(take_word(line));
      // A line of each takes more bytes than one.
      if (!is_named || !count || *count > rest_.size()) return false;
      count_[i] = *count;
    }
    return true;
  }

  /// Takes the next line, which must have this number.
  std::optional<Line> line(uint32_t number) {
    std::string_view text = take_line(rest_);
    if (text.find_first_not_of("0123456789-{},| \t\r") != std::string_view::npos) {
      return std::nullopt;
    }
    const size_t open = text.find('{'), close = text.find('}');
    if (open == std::string_view::npos || close == std::string_view::npos || close < open) {
      return std::nullopt;
    }
    if (index_of(trimmed(text.substr(0, open))) != number) return std::nullopt;
    const std::string_view inside = text.substr(open + 1, close - open - 1);
    const size_t bar = inside.find('|');
    Line result;
    result.lists = inside.substr(0, bar);
    if (bar != std::string_view::npos) result.behind_bar = inside.substr(bar + 1);
    result.mark = trimmed(text.substr(close + 1)) == "1";
    return result;
  }

  bool pass(uint32_t count) {
    for (uint32_t i = 0; i < count; ++i) {
      if (!line(i)) return false;
    }
    return true;
  }

  bool read_vertices() {
    for (uint32_t i = 0; i < count_[0]; ++i) {
      std::optional<Line> vertex = line(i);
      if (!vertex) return false;
      std::array<WholeNumber, 4> numbers;
      for (WholeNumber& number : numbers) {
        const std::optional<WholeNumber> read = whole_number(take_word(vertex->behind_bar));
        if (!read) return false;
        number = *read;
      }
      if (numbers[3].digits == 0) return false;
      faces_.points.emplace_back(ratio(numbers[0], numbers[3]), ratio(numbers[1], numbers[3]),
                                 ratio(numbers[2], numbers[3]));
    }
    return true;
  }

  bool read_half_edges() {
    for (uint32_t i = 0; i < count_[1]; ++i) {
      const std::optional<Line> half_edge = line(i);
      const std::optional<uint32_t> vertex = half_edge ? half_edge->index(1) : std::nullopt;
      if (!vertex || *vertex >= count_[0]) return false;
      vertex_of_half_edge_.push_back(*vertex);
    }
    return true;
  }

  bool read_facets() {
    for (uint32_t i = 0; i < count_[2]; ++i) {
      const std::optional<Line> facet = line(i);
      if (!facet) return false;
      const std::optional<uint32_t> twin = facet->index(0), volume = facet->index(3);
      if (!twin || !volume || *twin >= count_[2] || *volume >= count_[3]) return false;
      Facet& read = facets_.emplace_back(Facet{*twin, *volume, {}});
      std::string_view rings = facet->list(1);
      for (std::string_view word; !(word = take_word(rings)).empty();) {
        const std::optional<uint32_t> corner = index_of(word);
        if (!corner || *corner >= count_[4]) return false;
        read.rings.push_back(*corner);
      }
    }
    return true;
  }

  bool read_volumes() {
    for (uint32_t i = 0; i < count_[3]; ++i) {
      const std::optional<Line> volume = line(i);
      if (!volume) return false;
      is_solid_.push_back(volume->mark);
    }
    return true;
  }

  bool read_corners() {
    for (uint32_t i = 0; i < count_[4]; ++i) {
      const std::optional<Line> corner = line(i);
      if (!corner) return false;
      const std::optional<uint32_t> half_edge = corner->index(3), next = corner->index(6);
      if (!half_edge || !next || *half_edge >= count_[1] || *next >= count_[4]) return false;
      corners_.push_back({*half_edge, *next});
    }
    return true;
  }

  void add_faces() {
    std::vector<bool> is_taken(corners_.size());
    for (const Facet& facet : facets_) {
      // A half-facet bounds the volume that its normal points into.
      if (is_solid_[facet.volume] || !is_solid_[facets_[facet.twin].volume]) continue;
      for (uint32_t corner : facet.rings) {
        for (; !is_taken[corner]; corner = corners_[corner].next) {
          is_taken[corner] = true;
          faces_.corners.push_back(vertex_of_half_edge_[corners_[corner].half_edge]);
        }
        faces_.end_ring();
      }
      faces_.end_face();
    }
  }

  std::string_view rest_;
  std::array<uint32_t, 7> count_{};
  RingedFaces faces_;
  std::vector<uint32_t> vertex_of_half_edge_;
  std::vector<Facet> facets_;
  std::vector<bool> is_solid_;  // by volume
  std::vector<NefCorner> corners_;
};

}  // namespace

SolidFile read_nef3(std::string_view bytes, const std::string& name) {
  SolidFile file;
  if (std::optional<RingedFaces> faces = NefText(bytes).read()) {
    file.faces = face_set_of(std::move(*faces));
  } else {
    file.problem = "Failure trying to import '" + name + "'";
  }
  return file;
}

}  // namespace frontend
