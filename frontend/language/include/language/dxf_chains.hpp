// The strokes of a DXF file, joined end to end.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

#include "language/dxf.hpp"

namespace language {

/// Joins strokes as OpenSCAD 2021.01 does. Their ends lie on a grid of 1/1024, where a point takes
/// the place of one that lies in a neighbouring cell already. Where strokes branch, the first of
/// the file goes on. First come the chains with an open end. Those that are left are taken for
/// closed, so that one which ends elsewhere than it began loses one of its two ends.
class DxfChains {
 public:
  /// A point of a chain, and the link that leads to it.
  struct Step {
    uint32_t point;
    uint32_t link;
  };
  using Chain = std::vector<Step>;

  /// Adds a link, whose ends may be one point. Returns its number, counted from 0.
  uint32_t add(DxfPoint start, DxfPoint end);
  /// Adds a line, or the chords of a curve.
  void add_chords(const DxfStroke& stroke);

  /// Returns the chains, each with its first point twice where it is closed. To be called once.
  std::vector<Chain> join();

  DxfPoint place(uint32_t point) const { return points_[point].place; }
  /// Returns the points of a link, as it was added.
  const std::array<uint32_t, 2>& ends(uint32_t link) const { return links_[link].ends; }

 private:
  using Cell = std::pair<int64_t, int64_t>;
  struct CellHash {
    size_t operator()(const Cell& cell) const {
      return static_cast<size_t>(cell.first) * 0x9E3779B97F4A7C15u ^
             static_cast<size_t>(cell.second) * 0xC2B2AE3D27D4EB4Fu;
    }
  };
  struct Link {
    std::array<uint32_t, 2> ends;  // points
    bool is_used = false;
  };
  /// A place on the grid, and the links that end there, in their order.
  struct Point {
    DxfPoint place;
    std::vector<uint32_t> links{};
    uint32_t first_free = 0;  // those before it are used
    uint32_t free = 0;        // links that are not used
  };

  uint32_t point_at(DxfPoint place);
  void add_at(uint32_t point, uint32_t link);
  void use(uint32_t link);
  void leave(uint32_t point);
  std::optional<uint32_t> next_link(uint32_t point);
  Chain walk(uint32_t link, uint32_t from);
  std::optional<uint32_t> open_link();
  bool turns_counterclockwise(const Chain& chain) const;

  std::unordered_map<Cell, uint32_t, CellHash> cells_;
  std::vector<Point> points_;
  std::vector<Link> links_;
  std::vector<uint32_t> maybe_open_;  // a heap of links, the first of the file on top
};

}  // namespace language
