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

/// 640×480 where SCADRAY_TEST_FULL=1, else small.
PictureSize picture_size();

/// The cases of a family that this run draws.
std::vector<const Case*> cases_to_run(const Family& family);

struct Line {
  std::string name;  // FAMILY/CASE
  std::string method;
  Tally tally;
};

/// All lines of the family, in the order of its cases and, within a case, of the methods; its
/// totals by method at the end are printed only.
std::vector<Line> run_family(const Family& family, const std::vector<Method>& methods,
                             const Tolerance& tolerance);

/// Totals by method of all lines.
std::vector<Line> totals(const std::vector<Line>& lines, const std::string& name);

void print_header();
void print_line(const Line& line);

}  // namespace stress
