#include "arrangement/pieces.hpp"

#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <algorithm>

#include "arrangement/disjoint_sets.hpp"
#include "arrangement/sorted_by_key.hpp"

namespace csgcore {
namespace {

struct SideOfPiece {
  uint32_t a;  // of its edge's points the lesser, and the greater
  uint32_t b;
  uint32_t piece;
  auto operator<=>(const SideOfPiece&) const = default;
};

}  // namespace

Pieces::Pieces(const Facets& facets, const NeededFacets& needed, const CellTree& cells,
               const Sheets& sheets)
    : facets_(facets), needed_(needed), sheets_(sheets), corner_count_(facets.points.size()) {
  number_points();
  add_pieces(cells);
  find_patches(cells);
}

/// Points with a name in common are one, and corners are named by their numbers.
void Pieces::number_points() {
  struct Named {
    PointName name;
    uint32_t sheet;
    uint32_t point;
    bool is_alias;
    auto operator<=>(const Named&) const = default;
  };
  std::vector<Named> named;
  numbers_.resize(sheets_.sheets.size());
  for (uint32_t i = 0; i < sheets_.sheets.size(); ++i) {
    const Sheet& sheet = sheets_.sheets[i];
    numbers_[i].resize(sheet.points.size());
    for (uint32_t j = 0; j < sheet.points.size(); ++j) {
      const PointName& name = sheet.points[j].name;
      if (name.kind() == PointName::kCorner) {
        numbers_[i][j] = name.numbers[1];
      } else {
        named.push_back({name, i, j, false});
      }
    }
    for (const auto& alias : sheet.aliases) {
      if (alias.name.kind() != PointName::kCorner) {
        named.push_back({alias.name, i, alias.point, true});
      }
    }
  }
  tbb::parallel_sort(named.begin(), named.end());
  // The sheets may have rounded a point differently: the first of them counts.
  std::vector<const ArrangedPoint*> points;
  std::vector<uint32_t> number_of(named.size());
  for (size_t i = 0; i < named.size(); ++i) {
    const auto& [name, sheet, point, is_alias] = named[i];
    if (i == 0 || named[i - 1].name != name) {
      points.push_back(&sheets_.sheets[sheet].points[point]);
    }
    number_of[i] = static_cast<uint32_t>(corner_count_ + points.size() - 1);
    if (!is_alias) numbers_[sheet][point] = number_of[i];
  }
  DisjointSets same(corner_count_ + points.size());
  for (size_t i = 0; i < named.size(); ++i) {
    const auto& [name, sheet, point, is_alias] = named[i];
    if (is_alias) same.join(numbers_[sheet][point], number_of[i]);
  }
  for (size_t i = 0; i < numbers_.size(); ++i) {
    for (const auto& alias : sheets_.sheets[i].aliases) {
      if (alias.name.kind() != PointName::kCorner) continue;
      same.join(numbers_[i][alias.point], alias.name.numbers[1]);
    }
  }
  for (std::vector<uint32_t>& numbers : numbers_) {
    for (uint32_t& number : numbers) {
      if (number != kNoPlace) number = same.find(number);
    }
  }
  named_ = std::move(points);
  is_in_sheet_.assign(point_count(), false);
  for (const std::vector<uint32_t>& numbers : numbers_) {
    for (const uint32_t number : numbers) {
      if (number != kNoPlace) is_in_sheet_[number] = true;
    }
  }
}

void Pieces::add_pieces(const CellTree& cells) {
  constexpr uint32_t kMatters = 0;  // until the pieces are numbered
  piece_of_.assign(facets_.facets.size(), kNoPlace);
  for (const CellTree::Alone& cell : cells.alone()) {
    for (const uint32_t facet : cell.facets) piece_of_[facet] = kMatters;
  }
  for (const uint32_t facet : cells.others()) piece_of_[facet] = kMatters;
  for (uint32_t i = 0; i < piece_of_.size(); ++i) {
    // The first facet of a patch tells whether it matters.
    const uint32_t first = needed_.first_of[i];
    if (first != kNoPlace) piece_of_[i] = piece_of_[first];
    if (sheets_.is_divided[i]) piece_of_[i] = kNoPlace;
    if (piece_of_[i] == kNoPlace) continue;
    piece_of_[i] = static_cast<uint32_t>(pieces_.size());
    pieces_.push_back({facets_.facets[i].corners, kNoPlace, i, 0});
  }
  for (uint32_t i = 0; i < sheets_.sheets.size(); ++i) {
    const Sheet& sheet = sheets_.sheets[i];
    for (size_t j = 0; j < sheet.triangles.size(); ++j) {
      const auto& [a, b, c] = sheet.triangles[j];
      pieces_.push_back({{numbers_[i][a], numbers_[i][b], numbers_[i][c]},
                         i,
                         sheet.cover_of[j],
                         sheet.met_edges[j]});
    }
  }
}

void Pieces::find_patches(const CellTree& cells) {
  DisjointSets patches(pieces_.size());
  // Facets that are alone in a cell have the same solids around them. Others are compared with
  // their neighbours.
  is_compared_.assign(pieces_.size(), true);
  for (const CellTree::Alone& cell : cells.alone()) {
    uint32_t first = kNoPlace;
    for (const uint32_t facet : cell.facets) {
      const uint32_t piece = piece_of_[facet];
      if (piece == kNoPlace) continue;
      is_compared_[piece] = false;
      if (first == kNoPlace) first = piece;
      patches.join(first, piece);
    }
  }
  for (const uint32_t facet : cells.others()) {
    if (piece_of_[facet] != kNoPlace) is_compared_[piece_of_[facet]] = true;
  }
  std::vector<SideOfPiece> sides;
  for (uint32_t i = 0; i < pieces_.size(); ++i) {
    if (is_represented(pieces_[i])) {
      patches.join(piece_of_[needed_.first_of[pieces_[i].cover]], i);
      continue;
    }
    if (!is_compared_[i]) continue;
    const auto& points = pieces_[i].points;
    for (size_t j = 0; j < 3; ++j) {
      // A line that was drawn may have more points in the other surface's sheet.
      if ((pieces_[i].met_edges >> j & 1) != 0) continue;
      const auto [a, b] = std::minmax(points[j], points[(j + 1) % 3]);
      sides.push_back({a, b, i});
    }
  }
  sort_by_key(sides, point_count(), [](const SideOfPiece& side) { return side.a; });
  const auto have_same_operands = [&](const Piece& p, const Piece& q) {
    const auto of_p = facets(p);
    const auto of_q = facets(q);
    if (of_p.size() == 1 && of_q.size() == 1) {
      return facets_.facets[of_p[0]].operand == facets_.facets[of_q[0]].operand;
    }
    // Which of several turn the other way is not compared: within a sheet it is the same facets.
    return p.sheet == q.sheet && p.cover == q.cover;
  };
  for (size_t begin = 0; begin < sides.size();) {
    size_t end = begin + 1;
    while (end < sides.size() && sides[end].a == sides[begin].a && sides[end].b == sides[begin].b) {
      ++end;
    }
    if (end - begin == 2 &&
        have_same_operands(pieces_[sides[begin].piece], pieces_[sides[begin + 1].piece])) {
      patches.join(sides[begin].piece, sides[begin + 1].piece);
    }
    begin = end;
  }
  patches_.resize(pieces_.size());
  for (uint32_t i = 0; i < patches_.size(); ++i) patches_[i] = patches.find(i);
}

ArrangedPoint Pieces::point(uint32_t number) const {
  if (number < corner_count_) return grid_point(corner_name(number), facets_.points[number]);
  return *named_[number - corner_count_];
}

bool Pieces::are_in_one_plane(const Piece& a, const Piece& b) const {
  return facets_.are_in_one_plane(facets(a).front(), facets(b).front());
}

int Pieces::axis(const Piece& piece) const {
  return piece.sheet == kNoPlace ? facets_.plane(piece.cover).axis()
                                 : sheets_.sheets[piece.sheet].axis;
}

}  // namespace csgcore
