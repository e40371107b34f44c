#include "state_texts.hpp"

#include <string>
#include <variant>

namespace window {
namespace {

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

void visit_texts(const State& state, const Visit& visit) {
  visit(state.name);
  visit(state.notice);
  visit(state.picture_path);
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
