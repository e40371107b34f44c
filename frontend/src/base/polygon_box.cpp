#include "base/polygon_box.hpp"

#include <cmath>

#include "base/angles.hpp"

namespace frontend {
namespace {

using csgcore::Box;
using csgcore::Vec3;

double cos_of_turn(double part) { return std::cos(kTurn * part); }

/// Only the vertices nearest to the four half-axes matter.
Box box_of_polygon(int fragments) {
  const double n = fragments;
  // Returns the largest coordinate along the axis that lies `turn` of a full turn away from vertex
  // 0.
  const auto reach = [&](double turn) { return cos_of_turn(std::round(turn * n) / n - turn); };
  Box box;
  box.min = Vec3(-reach(0.5), -reach(0.75), 0);
  box.max = Vec3(1, reach(0.25), 0);
  return box;
}

}  // namespace

const Box& unit_polygon_box(int fragments) {
  // A file has few numbers of fragments, mostly in a row.
  struct Last {
    int fragments = 0;
    Box box;
  };
  thread_local Last last;
  if (last.fragments != fragments) last = {fragments, box_of_polygon(fragments)};
  return last.box;
}

}  // namespace frontend
