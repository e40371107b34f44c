// Runs families of cases through renderers, prints the table, and remembers its totals.
#pragma once

#include <cstdio>
#include <functional>
#include <string>
#include <vector>

#include "cases.hpp"
#include "csgcore/solid.hpp"
#include "judge.hpp"

namespace stress {

/// Draws one solid from any view.
using Drawer = std::function<csgcore::Hits(const View&)>;

/// A renderer, or one way of using it.
struct Method {
  std::string name;
  std::function<Drawer(const Scene&, const csgcore::Solid&)> prepare;
};

/// Returns 640×480 if SCADRAY_TEST_FULL=1, and a small size otherwise.
PictureSize picture_size();

/// Returns the cases of a family that this run draws.
std::vector<const Case*> cases_to_run(const Family& family);

struct Line {
  std::string name;  // FAMILY/CASE
  std::string method;
  Tally tally;
};

/// Returns all lines of the family, in the order of its cases and, within a case, of the methods.
/// Its totals by method are only printed, at the end.
std::vector<Line> run_family(const Family& family, const std::vector<Method>& methods,
                             const Tolerance& tolerance);

/// Returns the totals of all lines by method.
std::vector<Line> totals(const std::vector<Line>& lines, const std::string& name);

void print_header();
void print_line(const Line& line);

}  // namespace stress
