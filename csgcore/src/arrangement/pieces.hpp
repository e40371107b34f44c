// The arrangement of all facets: pieces, which no surface crosses, and the patches that they form.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "arrangement/cell_tree.hpp"
#include "arrangement/facet_grid.hpp"
#include "arrangement/needed_facets.hpp"
#include "arrangement/sheets.hpp"

namespace csgcore {

/// A facet that nothing divides, or a triangle of a sheet.
struct Piece {
  std::array<uint32_t, 3> points;  // places in Pieces::points
  uint32_t sheet;                  // kNoPlace: it is a facet by itself
  uint32_t cover;                  // of the sheet; or the facet
  uint8_t met_edges;               // as in a Sheet
};

class Pieces {
 public:
  /// Keeps references to all arguments.
  Pieces(const Facets& facets, const NeededFacets& needed, const CellTree& cells,
         const Sheets& sheets);

  const Facets& all_facets() const { return facets_; }
  /// Facets first, then the triangles of sheets.
  const std::vector<Piece>& all() const { return pieces_; }
  /// Returns the facet's place among them; kNoPlace: it is part of a sheet, or matters nowhere.
  uint32_t piece_of(uint32_t facet) const { return piece_of_[facet]; }
  /// Returns the facets that lie there.
  std::span<const uint32_t> facets(const Piece& piece) const {
    return piece.sheet == kNoPlace ? std::span(&piece.cover, 1)
                                   : sheets_.sheets[piece.sheet].covers[piece.cover];
  }
  /// Returns whether the piece is where more than its own operand matters.
  bool is_compared(uint32_t piece) const { return is_compared_[piece]; }
  /// By piece: the first piece of its patch. The pieces of a patch have the same solids before and
  /// behind them, and facets of the same operands, turned the same way.
  const std::vector<uint32_t>& patches() const { return patches_; }
  /// Returns a point: a corner of facets, or one of a sheet.
  ArrangedPoint point(uint32_t number) const;
  bool is_in_sheet(uint32_t point) const { return is_in_sheet_[point]; }
  size_t point_count() const { return corner_count_ + named_.size(); }
  size_t corner_count() const { return corner_count_; }
  /// Returns whether the pieces lie in one plane, on whichever side of it they face.
  bool are_in_one_plane(const Piece& a, const Piece& b) const;
  /// The axis along which the piece's plane is drawn.
  int axis(const Piece& piece) const;

 private:
  void number_points();
  void add_pieces(const CellTree& cells);
  void find_patches(const CellTree& cells);

  /// Returns whether the piece is a facet that another one stands for.
  bool is_represented(const Piece& piece) const {
    return piece.sheet == kNoPlace && needed_.first_of[piece.cover] != piece.cover;
  }

  const Facets& facets_;
  const NeededFacets& needed_;
  const Sheets& sheets_;
  size_t corner_count_;
  std::vector<const ArrangedPoint*> named_;     // points that are no corners
  std::vector<std::vector<uint32_t>> numbers_;  // by sheet and its point
  std::vector<bool> is_in_sheet_;               // by point
  std::vector<Piece> pieces_;                   // facets first
  std::vector<uint32_t> patches_;
  std::vector<uint32_t> piece_of_;  // by facet
  std::vector<bool> is_compared_;   // by piece
};

}  // namespace csgcore
