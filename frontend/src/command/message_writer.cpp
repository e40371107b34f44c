#include "command/message_writer.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string_view>
#include <system_error>
#include <utility>

#include "frontend/terminal.hpp"

namespace frontend {
namespace {

constexpr std::string_view kTrace = "TRACE";

/// Returns the word before ": " that OpenSCAD begins a line with; empty: there is none.
std::string_view group_of(std::string_view text) {
  constexpr std::array<std::string_view, 5> kGroups = {"ERROR", "WARNING", "DEPRECATED", "ECHO",
                                                       kTrace};
  const auto found = std::ranges::find(kGroups, text.substr(0, text.find(": ")));
  return found == kGroups.end() ? std::string_view() : *found;
}

/// Returns where " in file ‹path›, line ‹number›" begins at the end of a text; its size: nowhere.
std::size_t place_suffix(std::string_view text) {
  constexpr std::string_view kFile = " in file ", kLine = ", line ";
  const std::size_t line = text.rfind(kLine), file = text.rfind(kFile);
  const bool is_place = line != text.npos && file != text.npos && file < line;
  const std::string_view number = is_place ? text.substr(line + kLine.size()) : "";
  const bool is_number =
      !number.empty() && std::ranges::all_of(number, [](char c) { return '0' <= c && c <= '9'; });
  return is_number ? file : text.size();
}

/// Returns the absolute path of a file that is there; else the name as it is.
std::string path_if_there(const std::string& path) {
  std::error_code failed;
  if (path.empty() || !std::filesystem::exists(path, failed)) return path;
  return std::filesystem::absolute(path, failed).lexically_normal().string();
}

void put_place(nlohmann::ordered_json& json, const std::string& file, uint32_t line,
               uint32_t column) {
  if (!file.empty()) json["file"] = file;
  if (line > 0) json["line"] = line;
  if (column > 0) json["column"] = column;
}

nlohmann::ordered_json json_of(const DesignMessage& message) {
  std::string_view text = message.text;
  const std::string_view group = group_of(text);
  if (!group.empty()) text.remove_prefix(group.size() + 2);
  nlohmann::ordered_json json;
  json["group"] = group.empty() ? "NOTE" : group;
  const bool may_name_place = !group.empty() && group != "ECHO";
  json["text"] = may_name_place ? text.substr(0, place_suffix(text)) : text;
  const SourcePlace& place = message.place;
  put_place(json, place.path.empty() ? place.file : place.path, place.line, place.column);
  return json;
}

nlohmann::ordered_json json_of(const Problem& problem, std::string_view group) {
  nlohmann::ordered_json json;
  json["group"] = group;
  json["text"] = problem.what + (problem.todo.empty() ? "" : " (" + problem.todo + ')');
  put_place(json, problem.path.empty() ? path_if_there(problem.file) : problem.path,
            problem.location.line, problem.column > 0 ? problem.column : problem.location.column);
  return json;
}

}  // namespace

struct MessageWriter::Json {
  nlohmann::ordered_json value;
};

MessageFormat message_format(const std::vector<std::string>& words) {
  bool is_json = false;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (words[i].starts_with("--messages=")) is_json = words[i] == "--messages=json";
    if (words[i] == "--messages" && i + 1 < words.size()) is_json = words[i + 1] == "json";
  }
  return is_json ? MessageFormat::kJson : MessageFormat::kText;
}

MessageWriter::MessageWriter(MessageFormat format) : format_(format) {}

MessageWriter::~MessageWriter() { flush(); }

void MessageWriter::write(const std::string& line) {
  if (progress_) progress_->clear();
  print_text(stderr, line + "\n");
}

void MessageWriter::hold(Json message) {
  flush();
  held_ = std::make_unique<Json>(std::move(message));
}

void MessageWriter::flush() {
  if (!held_) return;
  using Handler = nlohmann::ordered_json::error_handler_t;
  write(std::exchange(held_, nullptr)->value.dump(-1, ' ', false, Handler::replace));
}

void MessageWriter::say(const DesignMessage& message) {
  if (!is_json()) return write(message.text);
  Json said{json_of(message)};
  if (said.value["group"] != kTrace) return hold(std::move(said));
  said.value.erase("group");
  std::unique_ptr<Json>& owner = message.follows_error ? error_trace_ : held_;
  if (!owner) owner = std::make_unique<Json>();
  owner->value["trace"].push_back(std::move(said.value));
}

void MessageWriter::say(const Warning& warning) {
  if (!is_json()) return write(warning.text);
  hold({json_of(warning.problem, warning.is_note ? "NOTE" : "WARNING")});
}

void MessageWriter::say(const Error& error) {
  if (!is_json()) return write(error.what());
  hold({json_of(error.problem(), "ERROR")});
  if (error_trace_) held_->value.update(error_trace_->value);
  error_trace_.reset();
  flush();
}

void MessageWriter::say(const std::string& group, const std::string& text) {
  if (!is_json()) return write(group.empty() ? text : group + ": " + text);
  hold({json_of(Problem{{}, {}, text, {}}, group == "warning" ? "WARNING" : "NOTE")});
}

}  // namespace frontend
