#include "arguments/node_problems.hpp"

#include <algorithm>
#include <utility>

namespace frontend {

void NodeProblems::add(const Node& node, Description description, uint64_t count) {
  const auto [entry, is_new] =
      problems_.try_emplace({node.kind, std::move(description.what), std::move(description.todo)});
  Problem& problem = entry->second;
  if (is_new) problem = {node.place, 0, problems_.size(), description.is_note};
  problem.count += count;
}

std::vector<Warning> NodeProblems::warnings(const DesignTree& tree) const {
  using Entry = decltype(problems_)::value_type;
  std::vector<const Entry*> sorted;
  for (const Entry& entry : problems_) sorted.push_back(&entry);
  std::ranges::sort(sorted, {}, [&](const Entry* entry) {
    const auto& [first, count, order, is_note] = entry->second;
    const bool has_place = tree.files->has(first.file);
    return has_place ? std::tuple(first.file + 1, first.offset, order) : std::tuple(0u, 0u, order);
  });
  std::vector<Warning> result;
  for (const Entry* entry : sorted) {
    const auto& [kind, text, todo] = entry->first;
    const Problem& problem = entry->second;
    std::string what = std::string(name_of(kind)) + text;
    if (problem.count > 1) what += "; the first of " + std::to_string(problem.count);
    const auto make = problem.is_note ? make_note : make_warning;
    result.push_back(
        make(tree.file_of(problem.first), tree.location_of(problem.first), what, todo));
  }
  return result;
}

}  // namespace frontend
