#include "state_texts.hpp"

#include <cstdio>
#include <glm/geometric.hpp>
#include <string>
#include <utility>
#include <variant>

namespace window {
namespace {

std::string in_a_line(const std::vector<std::string>& words) {
  std::string line;
  for (const std::string& word : words) line += (line.empty() ? "" : ", ") + word;
  return line;
}

using Visit = std::function<void(std::string_view)>;

void visit_place(const frontend::LeafPlace& place, const Visit& visit) {
  for (const frontend::TrailStep& step : place.trail) {
    visit(step.what);
    visit(step.place.file);
  }
}

void visit_value(const language::ParameterValue& value, const Visit& visit) {
  if (const auto* text = std::get_if<std::string>(&value)) visit(*text);
}

void visit_parameters(const Customizer& customizer, const Visit& visit) {
  visit(customizer.file());
  visit(customizer.set_name());
  for (const std::string& name : customizer.set_names()) visit(name);
  for (std::size_t i = 0; i < customizer.parameters().size(); ++i) {
    const Customizer::Parameter& parameter = customizer.parameters()[i];
    visit(parameter.name);
    visit(parameter.description);
    visit(parameter.group);
    for (const language::ParameterChoice& choice : parameter.choices) visit(choice.label);
    visit_value(customizer.value(i), visit);
  }
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

void visit_texts(const State& state, const Visit& visit) {
  visit(state.name);
  visit(state.notice);
  visit(state.exporting);
  visit(state.picture_dialogue.path);
  visit(state.model_dialogue.path);
  visit(state.message_filter);
  visit(state.new_set);
  visit(state.parameter_edit.text);
  for (const Message& message : state.messages) {
    visit(message.text);
    for (const MessageLine& trace : message.traces) visit(trace.text);
  }
  for (const MeasuredPoint& point : state.points) visit_place(point.place, visit);
  if (state.hovered) visit_place(state.hovered->place, visit);
  if (state.painting) visit(state.painting->error);
  visit_parameters(state.customizer, visit);
  for (const std::string& path : state.recent_designs) visit(path);
  if (!state.browser) return;
  visit(state.browser->folder());
  visit(state.browser->text());
  for (const FileBrowser::Entry& entry : state.browser->entries()) visit(entry.name);
}

}  // namespace window
