#include "lower/node_problems.hpp"

#include <algorithm>
#include <tuple>

namespace frontend {

std::vector<Warning> NodeProblems::warnings(const SyntaxTree& tree) const {
  std::vector<const Problem*> sorted;
  for (const Problem& problem : problems_) sorted.push_back(&problem);
  std::stable_sort(sorted.begin(), sorted.end(), [](const Problem* a, const Problem* b) {
    return std::tie(a->first.file, a->first.line, a->first.column) <
           std::tie(b->first.file, b->first.line, b->first.column);
  });
  std::vector<Warning> result;
  for (const Problem* problem : sorted) {
    std::string what = std::string(name_of(problem->kind)) + problem->description.what;
    if (problem->count > 1) what += "; the first of " + std::to_string(problem->count);
    const auto make = problem->description.is_note ? make_note : make_warning;
    result.push_back(
        make(tree.file_of(problem->first), problem->first, what, problem->description.todo));
  }
  return result;
}

}  // namespace frontend
