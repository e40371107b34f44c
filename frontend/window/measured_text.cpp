#include "measured_text.hpp"

#include <cstdio>
#include <glm/geometric.hpp>
#include <utility>

namespace window {
namespace {

std::string in_a_line(const std::vector<std::string>& words) {
  std::string line;
  for (const std::string& word : words) line += (line.empty() ? "" : ", ") + word;
  return line;
}

}  // namespace

std::string distance_text(const std::vector<MeasuredPoint>& points) {
  const csgcore::Vec3 apart = points[1].position - points[0].position;
  char length[32];
  std::snprintf(length, sizeof length, "%.6g", glm::length(apart));
  return std::string(length) + "  " + coordinates(apart);
}

std::vector<std::string> measured_lines(const std::vector<MeasuredPoint>& points) {
  std::vector<std::string> lines;
  if (std::string line = in_a_line(words_of(points.back().surface)); !line.empty()) {
    lines.push_back(std::move(line));
  }
  if (points.size() < 2) return lines;
  if (auto relation = relation_of(points[0].surface, points[1].surface)) {
    lines.push_back(std::move(*relation));
  }
  return lines;
}

std::string text_of(const Message& message) {
  std::string text = message.text;
  for (const MessageLine& trace : message.traces) text += '\n' + trace.text;
  return text;
}

std::string text_to_copy(const State& state) {
  std::string text;
  const auto add = [&text](const std::string& line) { text += (text.empty() ? "" : "\n") + line; };
  for (const MeasuredPoint& point : state.points) {
    add(coordinates(point.position));
    const frontend::TrailStep& leaf = point.place.step();
    add(leaf.what + "  " + frontend::text_of(leaf.place));
    if (const std::string words = in_a_line(words_of(point.surface)); !words.empty()) add(words);
  }
  if (state.points.size() == 2) {
    add(distance_text(state.points));
    const auto relation = relation_of(state.points[0].surface, state.points[1].surface);
    if (relation) add(*relation);
  }
  if (!text.empty()) return text;
  for (const Message& message : state.messages) add(text_of(message));
  return text;
}

}  // namespace window
