// The lines and curves of a DXF file, joined end to end.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

#include "drawings/curve_path.hpp"

namespace frontend {

/// A line, or an arc, between two points.
struct DxfStroke {
  Vec2 start{0.0};
  Vec2 end{0.0};
  std::optional<EllipseArc> arc{};
};

/// Joins strokes as OpenSCAD 2021.01 does. Their ends lie on a grid of 1/1024, where a point takes
/// the place of one that lies in a neighbouring cell already. Where strokes branch, the first of
/// the file goes on. First come the chains with an open end. Those that are left are taken for
/// closed, so that one which ends elsewhere than it began loses one of its two ends.
class DxfChains {
 public:
  /// A stroke between two equal points is left out. An arc is moved so that it ends on the grid.
  /// All coordinates must be at most kFarthest.
  void add(const DxfStroke& stroke);

  /// Returns the chains, each a path to be closed by a line. Their arcs are what they were.
  std::vector<CurvePath> join();

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
    uint32_t arc;                  // or kNoArc
    bool is_used = false;
  };
  /// A place on the grid, and the strokes that end there, in their order.
  struct Point {
    Vec2 place{0.0};
    std::vector<uint32_t> links{};
    uint32_t first_free = 0;  // those before it are used
    uint32_t free = 0;        // strokes that are not used
  };
  /// A point of a chain, and the stroke that leads to it.
  struct Step {
    uint32_t point;
    uint32_t link;
  };
  using Chain = std::vector<Step>;

  uint32_t point_at(const Vec2& place);
  void use(uint32_t link);
  std::optional<uint32_t> next_link(uint32_t point);
  Chain walk(uint32_t link, uint32_t from);
  std::optional<uint32_t> open_link();
  bool turns_counterclockwise(const Chain& chain) const;
  CurvePath path_of(const Chain& chain) const;
  void add_step(const Step& from, const Step& to, uint32_t link, CurvePath& path) const;

  static constexpr uint32_t kNoArc = 0xFFFFFFFFu;
  std::unordered_map<Cell, uint32_t, CellHash> cells_;
  std::vector<Point> points_;
  std::vector<Link> links_;
  std::vector<EllipseArc> arcs_;
  std::vector<uint32_t> maybe_open_;  // a heap of strokes, the first of the file on top
};

}  // namespace frontend
