// The lines and curves of a DXF file, joined end to end.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "drawings/curve_path.hpp"
#include "language/dxf_chains.hpp"

namespace frontend {

inline Vec2 vec2(const language::DxfPoint& point) { return {point.x, point.y}; }
inline language::DxfPoint dxf_point(const Vec2& point) { return {point.x, point.y}; }
inline EllipseArc ellipse_arc(const language::DxfArc& arc) {
  return {vec2(arc.center), vec2(arc.u), vec2(arc.v), arc.start, arc.sweep};
}

/// A line, or an arc, between two points.
struct DxfStroke {
  Vec2 start{0.0};
  Vec2 end{0.0};
  std::optional<EllipseArc> arc{};
};

/// Joins strokes as language::DxfChains does.
class DxfPaths {
 public:
  /// An arc between two equal points becomes a line. Others are moved so that they end on the grid.
  /// All coordinates must be at most kFarthest.
  void add(const DxfStroke& stroke);

  /// Returns the chains, each a path to be closed by a line. Their arcs are what they were.
  std::vector<CurvePath> join();

 private:
  using Step = language::DxfChains::Step;

  Vec2 place(uint32_t point) const { return vec2(chains_.place(point)); }
  void add_step(const Step& from, const Step& to, CurvePath& path) const;

  language::DxfChains chains_;
  std::vector<std::optional<EllipseArc>> arcs_;  // by link
};

}  // namespace frontend
