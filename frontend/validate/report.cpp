#include "report.hpp"

#include <cstdio>

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

Json json_of(const CheckResult& check) {
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
  if (is_cut_short) text += "not all was compared: time ran out (raise --time-limit)\n";
  for (const CheckResult& check : result.checks) {
    if (check.disagreements.empty()) continue;
    text += "first disagreement, " + check.name + " (" + check.group +
            "): " + check.disagreements.front().dump() + '\n';
  }
  return text + (result.agrees() ? "agrees\n" : "DISAGREES\n");
}

std::string report_of(const Result& result, const std::string& file, const Settings& settings,
                      int exponent) {
  Json checks = Json::array();
  for (const CheckResult& check : result.checks) checks.push_back(json_of(check));
  const Json report = {
      {"file", file},          {"agrees", result.agrees()},  {"fn", settings.fragments},
      {"seed", settings.seed}, {"scale_exponent", exponent}, {"notes", result.notes},
      {"checks", checks}};
  // A file's name need not be UTF-8.
  return report.dump(1, ' ', false, Json::error_handler_t::replace) + '\n';
}

}  // namespace validation
