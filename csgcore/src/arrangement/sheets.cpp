#include "arrangement/sheets.hpp"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <array>
#include <map>
#include <span>
#include <tuple>

#include "arrangement/disjoint_sets.hpp"
#include "arrangement/drawn_segments.hpp"
#include "arrangement/facet_crossing.hpp"
#include "csgcore/stop_scope.hpp"

namespace csgcore {
namespace {

/// What a facet has of another one, or of a point (`other` is kNoPlace, and start is end).
struct Trace {
  uint32_t plane;  // the first facet of the plane, once all planes are known
  uint32_t facet;
  uint32_t other;
  PointName start;
  PointName end;
  FacetCrossing::Edge edge;  // of the other facet, if the trace runs along one
  auto operator<=>(const Trace&) const = default;
};

/// An edge that two facets of one operand have in common.
struct CommonEdge {
  uint32_t low;  // its ends
  uint32_t high;
  uint32_t facet;
  uint32_t other;
  auto operator<=>(const CommonEdge&) const = default;
};

struct Found {
  std::vector<Trace> traces;
  std::vector<std::pair<uint32_t, uint32_t>> coplanar;
  std::vector<std::pair<uint32_t, uint32_t>> in_corner;  // they meet in a corner of both alone
  std::vector<CommonEdge> common;
};

Trace touch(uint32_t facet, uint32_t corner) {
  return {
      kNoPlace, facet, kNoPlace, corner_name(corner), corner_name(corner), {kNoPlace, kNoPlace}};
}

class SheetMaker {
 public:
  SheetMaker(const Facets& facets, const std::vector<std::pair<uint32_t, uint32_t>>& pairs,
             const Covers& covers)
      : facets_(facets), pairs_(pairs), covers_(covers), planes_(facets.facets.size()) {}

  Sheets run() {
    find_traces();
    const std::vector<std::pair<size_t, size_t>> ranges = ranges_of_planes();
    Sheets result;
    result.sheets.resize(ranges.size());
    result.is_divided.assign(facets_.facets.size(), false);
    for (const Trace& trace : traces_) result.is_divided[trace.facet] = true;
    const std::stop_token* const stop = stop_of_work;
    tbb::parallel_for(size_t{0}, ranges.size(), [&](size_t i) {
      const StopScope scope(stop);
      stop_point();
      result.sheets[i] = sheet(ranges[i].first, ranges[i].second);
    });
    return result;
  }

 private:
  void find_traces() {
    tbb::enumerable_thread_specific<Found> found;
    const std::stop_token* const stop = stop_of_work;
    constexpr size_t kAtOnce = 1024;
    tbb::parallel_for(tbb::blocked_range<size_t>(0, pairs_.size(), kAtOnce),
                      [&](const auto& range) {
                        const StopScope scope(stop);
                        stop_point();
                        PlacedFacet t{};
                        uint32_t last = kNoPlace;
                        for (size_t i = range.begin(); i < range.end(); ++i) {
                          if (i == range.begin() || t.number != pairs_[i].first) {
                            t = placed(facets_, pairs_[i].first);
                          }
                          add_crossing(t, placed(facets_, pairs_[i].second), last, found.local());
                        }
                      });
    for (const Facets::Touch& at : facets_.touches) traces_.push_back(touch(at.facet, at.point));
    for (const Found& part : found) {
      traces_.insert(traces_.end(), part.traces.begin(), part.traces.end());
      for (const auto& [a, b] : part.coplanar) planes_.join(a, b);
    }
    std::vector<bool> is_met(facets_.facets.size(), false);
    const auto meet = [&](uint32_t facet) {
      if (is_met[facet]) return;
      is_met[facet] = true;
      // A trace that only says that the facet is part of a sheet.
      traces_.push_back(touch(facet, facets_.facets[facet].corners[0]));
    };
    for (const Found& part : found) {
      for (const auto* pairs : {&part.coplanar, &part.in_corner}) {
        for (const auto& [a, b] : *pairs) {
          meet(a);
          meet(b);
        }
      }
    }
    add_common_edges(found);
    for (Trace& trace : traces_) {
      trace.plane = plane_of(trace.facet);
      trace.start = with_planes(trace.start);
      trace.end = with_planes(trace.end);
    }
    tbb::parallel_sort(traces_.begin(), traces_.end());
  }

  /// Where three facets of one operand and more have an edge in common, a surface meets another
  /// one, and nobody can tell which two are neighbours: each meets the others. (Two of one plane
  /// do not: with a third plane they would name a point on each of their common edges.)
  template <typename Founds>
  void add_common_edges(const Founds& found) {
    std::vector<CommonEdge> all;
    for (const Found& part : found) all.insert(all.end(), part.common.begin(), part.common.end());
    std::ranges::sort(all);
    const auto ends = [](const CommonEdge& at) { return std::pair(at.low, at.high); };
    for (size_t i = 0; i < all.size(); ++i) {
      const bool is_alone = (i == 0 || ends(all[i - 1]) != ends(all[i])) &&
                            (i + 1 == all.size() || ends(all[i + 1]) != ends(all[i]));
      if (is_alone || facets_.are_in_one_plane(all[i].facet, all[i].other)) continue;
      const auto& [low, high, facet, other] = all[i];
      const PointName start = corner_name(low);
      const PointName end = corner_name(high);
      traces_.push_back({kNoPlace, facet, other, start, end, {low, high}});
      traces_.push_back({kNoPlace, other, facet, start, end, {low, high}});
    }
  }

  uint32_t plane_of(uint32_t facet) const { return planes_.find_only(facet); }

  /// Facets of one plane are named by the first of them, so that a point has few names.
  PointName with_planes(PointName name) const {
    if (name.kind() == PointName::kEdgeAndFacet) name.numbers[3] = plane_of(name.numbers[3]);
    return name;
  }

  /// `last` is the operand that hid the last crossing, or kNoPlace.
  void add_crossing(const PlacedFacet& t, const PlacedFacet& s, uint32_t& last,
                    Found& found) const {
    const uint32_t operand_of_t = facets_.facets[t.number].operand;
    const uint32_t operand_of_s = facets_.facets[s.number].operand;
    const bool is_one_operand = operand_of_t == operand_of_s;
    std::array<uint32_t, 3> common{};
    size_t commons = 0;
    for (const uint32_t name : t.names) {
      if (std::ranges::find(s.names, name) != s.names.end()) common[commons++] = name;
    }
    const FacetCrossing crossing = crossing_of(t, s);
    if (crossing.kind == FacetCrossing::Kind::kOverlap) {
      found.coplanar.emplace_back(t.number, s.number);
      return;
    }
    // Neighbours of one surface meet in what they have in common.
    if (is_one_operand && commons >= 2) {
      const auto [low, high] = std::minmax(common[0], common[1]);
      found.common.push_back({low, high, t.number, s.number});
      return;
    }
    for (const Facets::Touch& at : crossing.touches) {
      found.traces.push_back(touch(at.facet, at.point));
    }
    if (crossing.kind == FacetCrossing::Kind::kNone) return;
    const bool is_in_corner = commons == 1 && crossing.start == crossing.end;
    if (is_one_operand && is_in_corner) return;
    const auto& [kind, start, end, edge_of_t, edge_of_s, touches] = crossing;
    const std::array ends{arranged(start).position, arranged(end).position};
    if (covers_.hide(ends, operand_of_t, operand_of_s, last)) return;
    if (is_in_corner) {
      found.in_corner.emplace_back(t.number, s.number);
      return;
    }
    found.traces.push_back({kNoPlace, t.number, s.number, start, end, edge_of_s});
    found.traces.push_back({kNoPlace, s.number, t.number, start, end, edge_of_t});
  }

  std::vector<std::pair<size_t, size_t>> ranges_of_planes() const {
    std::vector<std::pair<size_t, size_t>> result;
    for (size_t begin = 0; begin < traces_.size();) {
      size_t end = begin + 1;
      while (end < traces_.size() && traces_[end].plane == traces_[begin].plane) ++end;
      result.emplace_back(begin, end);
      begin = end;
    }
    return result;
  }

  /// A line in the drawing of a sheet: an edge of one of its facets, or where another plane meets
  /// it, which may be along an edge of a facet of that plane.
  struct Line {
    uint32_t facet;            // the first of the other plane, or kNoPlace
    FacetCrossing::Edge edge;  // or kNoPlace
    uint32_t met;              // the facet of that plane which is met; kNoPlace: none, or several

    bool is_edge() const { return edge[0] != kNoPlace; }
  };

  ArrangedPoint arranged(const PointName& name) const { return arranged_point(facets_, name); }

  /// The names of the point in which lines cross. What is an edge in one sheet may be the inside of
  /// a facet in another.
  static std::vector<PointName> names_of(const Line& p, const Line& q, uint32_t plane) {
    std::vector<PointName> result;
    if (!p.is_edge() && !q.is_edge()) {
      result.push_back(name_of_planes(plane, p.facet, q.facet));
    }
    if (p.is_edge() && q.is_edge()) {
      result.push_back(name_of_edges(p.edge[0], p.edge[1], q.edge[0], q.edge[1]));
    }
    for (const auto& [edge, other] : {std::pair(&p, &q), std::pair(&q, &p)}) {
      if (!edge->is_edge() || other->facet == kNoPlace) continue;
      result.push_back(name_of(edge->edge[0], edge->edge[1], other->facet));
    }
    return result;
  }

  /// Returns whether the point is a corner of the facet that the line comes from.
  bool ends_in(const Line& line, const ArrangedPoint& point) const {
    if (point.name.kind() != PointName::kCorner) return false;
    const uint32_t corner = point.name.numbers[1];
    if (line.met == kNoPlace) return std::ranges::find(line.edge, corner) != line.edge.end();
    const auto& corners = facets_.facets[line.met].corners;
    return std::ranges::find(corners, corner) != corners.end();
  }

  /// A line through a point.
  struct Passing {
    uint32_t point;
    uint32_t line;
    uint32_t next;  // a point on the line
    auto operator<=>(const Passing&) const = default;
  };

  /// Returns one of the lines through a point for each direction, plane and edge that they have,
  /// by direction.
  std::vector<std::vector<uint32_t>> by_direction(const PlanarSubdivision& drawing,
                                                  const std::vector<Line>& lines,
                                                  std::span<const Passing> here) const {
    const auto& points = drawing.points();
    std::vector<std::pair<uint32_t, size_t>> known;  // next points, and in which direction they lie
    std::vector<std::vector<uint32_t>> result;
    std::vector<uint32_t> first;  // by direction: a next point
    for (const Passing& at : here) {
      const auto is_along = [&](uint32_t next) {
        return turn(facets_, points[at.point], points[next], points[at.next], drawing.axis()) == 0;
      };
      auto place = std::ranges::find(known, at.next, &std::pair<uint32_t, size_t>::first);
      if (place == known.end()) {
        const auto direction =
            static_cast<size_t>(std::ranges::find_if(first, is_along) - first.begin());
        if (direction == first.size()) {
          first.push_back(at.next);
          result.emplace_back();
        }
        place = known.insert(known.end(), {at.next, direction});
      }
      result[place->second].push_back(at.line);
    }
    const auto is_less = [&](uint32_t p, uint32_t q) {
      return std::tie(lines[p].facet, lines[p].edge) < std::tie(lines[q].facet, lines[q].edge);
    };
    const auto is_same = [&](uint32_t p, uint32_t q) { return !is_less(p, q) && !is_less(q, p); };
    for (std::vector<uint32_t>& along : result) {
      std::ranges::sort(along, is_less);
      along.erase(std::unique(along.begin(), along.end(), is_same), along.end());
    }
    return result;
  }

  /// Where three lines and more pass a point, or two pass a corner of other facets,
  /// other sheets may know it by any two of them.
  void add_names(const PlanarSubdivision& drawing, const std::vector<Line>& lines, uint32_t plane,
                 std::vector<PlanarSubdivision::Alias>& aliases) const {
    std::vector<Passing> passing;
    for (const auto& triangle : drawing.triangles()) {
      for (size_t edge = 0; edge < 3; ++edge) {
        const uint32_t a = triangle.points[edge];
        const uint32_t b = triangle.points[(edge + 1) % 3];
        for (uint32_t link = triangle.lines[edge]; link != kNoPlace;
             link = drawing.links()[link].next) {
          const uint32_t line = drawing.links()[link].line;
          if (!ends_in(lines[line], drawing.points()[a])) passing.push_back({a, line, b});
          if (!ends_in(lines[line], drawing.points()[b])) passing.push_back({b, line, a});
        }
      }
    }
    std::ranges::sort(passing);
    const auto is_same = [](const Passing& p, const Passing& q) {
      return p.point == q.point && p.line == q.line;
    };
    passing.erase(std::unique(passing.begin(), passing.end(), is_same), passing.end());
    for (auto begin = passing.begin(); begin != passing.end();) {
      const uint32_t number = begin->point;
      const auto end =
          std::find_if(begin, passing.end(), [&](const Passing& at) { return at.point != number; });
      const PointName& known = drawing.points()[number].name;
      const auto add = [&](const PointName& name) {
        if (name != known) aliases.push_back({number, name});
      };
      if (end - begin > (known.kind() == PointName::kCorner ? 1 : 2)) {
        const auto directions = by_direction(drawing, lines, {begin, end});
        for (size_t i = 0; i < directions.size(); ++i) {
          for (size_t j = i + 1; j < directions.size(); ++j) {
            for (const uint32_t p : directions[i]) {
              for (const uint32_t q : directions[j]) {
                std::ranges::for_each(names_of(lines[p], lines[q], plane), add);
              }
            }
          }
        }
      }
      begin = end;
    }
  }

  Sheet sheet(size_t begin, size_t end) const {
    std::vector<uint32_t> members;
    for (size_t i = begin; i < end; ++i) {
      if (members.empty() || members.back() != traces_[i].facet) {
        members.push_back(traces_[i].facet);
      }
    }
    const uint32_t plane = plane_of(members.front());
    const int axis = facets_.plane(plane).axis();
    std::vector<Line> lines;
    PlanarSubdivision drawing(facets_, axis,
                              [&](uint32_t p, uint32_t q, std::vector<PointName>& aliases) {
                                aliases = names_of(lines[p], lines[q], plane);
                                return arranged(aliases.front());
                              });
    start(drawing, members);
    // The edges of the facets are their first lines.
    for (const uint32_t member : members) {
      const auto& corners = facets_.facets[member].corners;
      for (size_t i = 0; i < 3; ++i)
        lines.push_back({kNoPlace, {corners[i], corners[(i + 1) % 3]}, kNoPlace});
    }
    std::vector<std::pair<uint32_t, uint32_t>> ends;  // by trace
    for (size_t i = begin; i < end; ++i) {
      const uint32_t from = drawing.insert(arranged(traces_[i].start));
      const bool is_point = traces_[i].start == traces_[i].end;
      ends.emplace_back(from, is_point ? from : drawing.insert(arranged(traces_[i].end)));
    }
    if (members.size() > 1) {
      for (size_t i = 0; i < lines.size(); ++i) {
        const auto [a, b] = lines[i].edge;
        const uint32_t from = drawing.insert(arranged(corner_name(a)));
        const uint32_t to = drawing.insert(arranged(corner_name(b)));
        drawing.draw(from, to, static_cast<uint32_t>(i));
      }
    }
    std::map<std::pair<uint32_t, FacetCrossing::Edge>, uint32_t> number_of;  // by plane and edge
    std::vector<Line> crossing;                                              // by number
    std::vector<DrawnSegment> segments;
    for (size_t i = begin; i < end; ++i) {
      const auto [from, to] = ends[i - begin];
      if (from == to) continue;
      const uint32_t other = traces_[i].other;
      const Line line{plane_of(other), traces_[i].edge, kNoPlace};
      const auto [known, is_new] =
          number_of.try_emplace({line.facet, line.edge}, static_cast<uint32_t>(crossing.size()));
      if (is_new) crossing.push_back(line);
      segments.push_back({known->second, other, from, to});
    }
    join_overlaps(drawing.points(), segments);
    for (const auto& [number, met, from, to] : segments) {
      lines.push_back({crossing[number].facet, crossing[number].edge, met});
      drawing.draw(from, to, static_cast<uint32_t>(lines.size() - 1));
    }
    Sheet result = finished(drawing, members);
    add_names(drawing, lines, plane, result.aliases);
    return result;
  }

  /// Starts the drawing with the facet, or with a rectangle around all of them.
  void start(PlanarSubdivision& drawing, const std::vector<uint32_t>& members) const {
    const auto corner = [&](uint32_t point) {
      return grid_point(corner_name(point), facets_.points[point]);
    };
    if (members.size() == 1) {
      const auto& [a, b, c] = facets_.facets[members.front()].corners;
      drawing.start(corner(a), corner(b), corner(c));
      return;
    }
    GridPoint least = facets_.points[facets_.facets[members.front()].corners[0]];
    GridPoint most = least;
    for (const uint32_t member : members) {
      for (const GridPoint& point : facets_.corners(member)) {
        for (size_t i = 0; i < 3; ++i) {
          least[i] = std::min(least[i], point[i] - 1);
          most[i] = std::max(most[i], point[i] + 1);
        }
      }
    }
    drawing.start_around(least, most);
  }

  static Sheet finished(const PlanarSubdivision& drawing, const std::vector<uint32_t>& members) {
    Sheet result{drawing.axis(), drawing.points(), drawing.aliases(), {}, {}, {}, {}};
    const auto add = [&](const PlanarSubdivision::Triangle& triangle, uint32_t cover) {
      result.triangles.push_back(triangle.points);
      result.cover_of.push_back(cover);
      uint8_t met = 0;
      for (size_t edge = 0; edge < 3; ++edge) {
        for (uint32_t link = triangle.lines[edge]; link != kNoPlace;
             link = drawing.links()[link].next) {
          if (drawing.links()[link].line >= 3 * members.size()) met |= uint8_t(1 << edge);
        }
      }
      result.met_edges.push_back(met);
    };
    if (members.size() == 1) {
      for (const auto& triangle : drawing.triangles()) add(triangle, 0);
      result.covers.push_back(members);
      return result;
    }
    std::vector<std::vector<uint32_t>> covers{{}};
    const std::vector<uint32_t> cover_of = covers_of(drawing, members, covers);
    std::vector<uint32_t> number_of(covers.size(), kNoPlace);
    for (size_t i = 0; i < cover_of.size(); ++i) {
      const uint32_t cover = cover_of[i];
      if (covers[cover].empty()) continue;
      if (number_of[cover] == kNoPlace) {
        number_of[cover] = static_cast<uint32_t>(result.covers.size());
        result.covers.push_back(covers[cover]);
      }
      add(drawing.triangles()[i], number_of[cover]);
    }
    return result;
  }

  /// Returns by triangle which of `covers` it has, which is extended: facets begin and end at their
  /// edges, and the first triangle, at the border, has none.
  static std::vector<uint32_t> covers_of(const PlanarSubdivision& drawing,
                                         const std::vector<uint32_t>& members,
                                         std::vector<std::vector<uint32_t>>& covers) {
    const auto& triangles = drawing.triangles();
    std::map<std::vector<uint32_t>, uint32_t> numbers{{{}, 0}};
    std::vector<uint32_t> result(triangles.size(), kNoPlace);
    std::vector<uint32_t> open{drawing.border_triangle()};
    result[open.front()] = 0;
    while (!open.empty()) {
      const uint32_t at = open.back();
      open.pop_back();
      for (size_t edge = 0; edge < 3; ++edge) {
        const uint32_t next = triangles[at].beyond[edge];
        if (next == kNoPlace || result[next] != kNoPlace) continue;
        std::vector<uint32_t> cover = covers[result[at]];
        for (uint32_t link = triangles[at].lines[edge]; link != kNoPlace;
             link = drawing.links()[link].next) {
          const uint32_t line = drawing.links()[link].line;
          if (line >= 3 * members.size()) continue;
          const uint32_t member = members[line / 3];
          const auto place = std::ranges::lower_bound(cover, member);
          if (place != cover.end() && *place == member) {
            cover.erase(place);
          } else {
            cover.insert(place, member);
          }
        }
        const auto [known, is_new] = numbers.emplace(cover, static_cast<uint32_t>(covers.size()));
        if (is_new) covers.push_back(std::move(cover));
        result[next] = known->second;
        open.push_back(next);
      }
    }
    return result;
  }

  const Facets& facets_;
  const std::vector<std::pair<uint32_t, uint32_t>>& pairs_;
  const Covers& covers_;
  DisjointSets planes_;  // facets of one plane that overlap
  std::vector<Trace> traces_;
};

}  // namespace

Sheets sheets_of(const Facets& facets, const std::vector<std::pair<uint32_t, uint32_t>>& pairs,
                 const Covers& covers) {
  return SheetMaker(facets, pairs, covers).run();
}

}  // namespace csgcore
