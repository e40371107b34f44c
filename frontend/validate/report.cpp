#include <algorithm>
#include <cstdio>
#include <map>
#include <set>
#include <vector>

#include "validation.hpp"

namespace validation {
namespace {

/// 1234567 → "1,234,567"
std::string grouped(uint64_t number) {
  std::string text = std::to_string(number);
  for (std::size_t at = text.size(); at > 3;) text.insert(at -= 3, ",");
  return text;
}

std::string row(const std::string& name, const std::string (&cells)[5]) {
  char text[160];
  std::snprintf(text, sizeof text, "  %-22s %10s %10s %10s %10s  %s\n", name.c_str(),
                cells[0].c_str(), cells[1].c_str(), cells[2].c_str(), cells[3].c_str(),
                cells[4].c_str());
  return text;
}

std::string row_of(const CheckResult& check) {
  char error[16];
  std::snprintf(error, sizeof error, "%.1e", check.worst_error);
  return row(check.name, {grouped(check.compared), grouped(check.agreed), grouped(check.undecided),
                          grouped(check.disagreed), check.worst_error > 0 ? error : "0"});
}

/// Writes "primitives that disagreements name: 5 (123 times), 0 (4 times)", the most frequent
/// first.
std::string named_primitives(const Result& result) {
  constexpr std::size_t kMostNamed = 5;
  std::map<uint32_t, uint64_t> times;
  for (const CheckResult& check : result.checks) {
    for (const Json& disagreement : check.disagreements) {
      std::set<uint32_t> named;
      for (const char* what : kWithPrimitive) {
        if (!disagreement.contains(what) || !disagreement[what].contains("primitive")) continue;
        named.insert(disagreement[what]["primitive"].get<uint32_t>());
      }
      for (const uint32_t primitive : named) ++times[primitive];
    }
  }
  std::vector<std::pair<uint32_t, uint64_t>> sorted(times.begin(), times.end());
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const auto& a, const auto& b) { return a.second > b.second; });
  std::string text = "primitives that disagreements name:";
  for (std::size_t i = 0; i < std::min(kMostNamed, sorted.size()); ++i) {
    text += (i > 0 ? ", " : " ") + std::to_string(sorted[i].first) + " (" +
            grouped(sorted[i].second) + " times)";
  }
  return sorted.empty() ? "" : text + '\n';
}

Json json_of_check(const CheckResult& check) {
  return {{"group", check.group},
          {"name", check.name},
          {"planned", check.planned},
          {"compared", check.compared},
          {"agreed", check.agreed},
          {"undecided", check.undecided},
          {"disagreed", check.disagreed},
          {"worst_error", check.worst_error},
          {"disagreements", check.disagreements}};
}

}  // namespace

std::string table_of(const Result& result) {
  std::string text;
  if (!result.checks.empty()) {
    text += row("", {"compared", "agreed", "undecided", "disagreed", "worst error"});
  }
  bool is_cut_short = false;
  std::string group;
  for (const CheckResult& check : result.checks) {
    if (check.group != group) text += check.group + '\n';
    group = check.group;
    text += row_of(check);
    is_cut_short = is_cut_short || check.compared < check.planned;
  }
  for (const std::string& note : result.notes) text += note + '\n';
  if (result.cgal_s > 0) {
    char time[64];
    std::snprintf(time, sizeof time, "CGAL took %.1f s for its solid\n", result.cgal_s);
    text += time;
  }
  if (is_cut_short) text += "not all was compared: time ran out (raise --time-limit)\n";
  for (const CheckResult& check : result.checks) {
    if (check.disagreements.empty()) continue;
    text += "first disagreement, " + check.name + " (" + check.group +
            "): " + check.disagreements.front().dump() + '\n';
  }
  text += named_primitives(result);
  return text + (result.agrees() ? "agrees\n" : "DISAGREES\n");
}

std::string report_of(const Result& result, const std::string& file, const Settings& settings,
                      int exponent) {
  Json checks = Json::array();
  for (const CheckResult& check : result.checks) checks.push_back(json_of_check(check));
  const Json report = {
      {"file", file},          {"agrees", result.agrees()},  {"fn", settings.fragments},
      {"seed", settings.seed}, {"scale_exponent", exponent}, {"notes", result.notes},
      {"checks", checks}};
  // The name of a file need not be UTF-8.
  return report.dump(1, ' ', false, Json::error_handler_t::replace) + '\n';
}

}  // namespace validation
