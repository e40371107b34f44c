#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <string>

#include "panels/panels.hpp"
#include "panels/style.hpp"
#include "state_texts.hpp"

namespace window {
namespace {

/// Laying out more messages than these would take longer than a frame; the filter finds the rest.
constexpr std::size_t kMostShown = 500;

/// Fewer messages than these need no filter.
constexpr std::size_t kLeastFiltered = 4;

ImU32 color_of(MessageKind kind) {
  if (kind == MessageKind::kError) return kErrorColor;
  if (kind == MessageKind::kWarning) return kWarningColor;
  return kTextColor;
}

/// Writes a line, wrapped. A click on it, or Enter, opens its place.
void line(ImU32 color, const std::string& text, const MessagePlace& place, const OpenPlace& open) {
  if (text_line(color, text, !place.file.empty())) open(place);
}

void message_line(State& state, const Message& message, const OpenPlace& open) {
  std::string text = message.text;
  if (message.count > 1) text = std::to_string(message.count) + " × " + text;
  const std::size_t calls = message.traces.size();
  ImGui::PushID(&message);
  line(color_of(message.kind), text, message.place, open);
  if (ImGui::IsItemClicked(ImGuiMouseButton_Right)) copy(state, text_of(message));
  if (calls > 0 &&
      ImGui::TreeNode("##traces", calls == 1 ? "1 call led to it" : "%zu calls led to it", calls)) {
    for (const MessageLine& trace : message.traces) {
      ImGui::PushID(&trace);
      line(kTextColor, trace.text, trace.place, open);
      ImGui::PopID();
    }
    ImGui::TreePop();
  }
  ImGui::PopID();
}

void message_lines(State& state, bool echoes, const OpenPlace& open) {
  std::size_t shown = 0, hidden = 0;
  for (const Message& message : state.messages) {
    if ((message.kind == MessageKind::kEcho) != echoes) continue;
    if (!contains(message, state.message_filter)) continue;
    if (shown == kMostShown) {
      ++hidden;
      continue;
    }
    ++shown;
    message_line(state, message, open);
  }
  if (hidden > 0) {
    ImGui::Text("… and %zu more; the filter finds them, scadray -o x.echo writes all", hidden);
  }
}

/// Returns "2 errors, 1 warning".
std::string words_of(const MessageCounts& counts) {
  std::string words;
  const auto add = [&words](std::size_t count, const char* one) {
    if (count == 0) return;
    if (!words.empty()) words += ", ";
    words += std::to_string(count) + " " + one + (count == 1 ? "" : "s");
  };
  add(counts.errors, "error");
  add(counts.warnings, "warning");
  add(counts.others, "message");
  return words;
}

/// Draws a tab with its messages. The name that follows "###" stays while the count changes.
void tab(State& state, const std::string& words, bool echoes, const OpenPlace& open) {
  if (words.empty()) return;
  if (!ImGui::BeginTabItem((words + (echoes ? "###echo" : "###messages")).c_str())) return;
  message_lines(state, echoes, open);
  ImGui::EndTabItem();
}

/// Draws the field for the filter at the right end of the tabs' row, and leaves the cursor where it
/// was; or above the tabs where these leave no room.
void filter_field(State& state, float tabs) {
  const ImVec2 start = ImGui::GetCursorPos();
  const float room = ImGui::GetContentRegionAvail().x, font = ImGui::GetFontSize();
  constexpr float kLeast = 5, kMost = 12;  // in heights of the font
  const bool is_beside = room - tabs >= kLeast * font;
  const float width = is_beside ? std::min(kMost * font, room - tabs) : room;
  ImGui::SetCursorPosX(start.x + room - width);
  ImGui::SetNextItemWidth(width);
  ImGui::InputTextWithHint("##filter", "filter", &state.message_filter);
  if (is_beside) ImGui::SetCursorPos(start);
}

/// Returns the width of a tab with such a name, and of the space behind it.
float tab_width(const std::string& name) {
  const ImGuiStyle& style = ImGui::GetStyle();
  return name.empty() ? 0
                      : text_width(name) + 2 * style.FramePadding.x + style.ItemInnerSpacing.x + 1;
}

void all_messages(State& state, const OpenPlace& open) {
  const MessageCounts counts = count_messages(state.messages);
  const std::string others = words_of(counts);
  const std::string echoes = counts.echoes == 0 ? "" : "Echo " + std::to_string(counts.echoes);
  if (state.messages.size() >= kLeastFiltered) {
    filter_field(state, tab_width(others) + tab_width(echoes));
  } else {
    state.message_filter.clear();
  }
  if (!ImGui::BeginTabBar("##kinds")) return;
  tab(state, others, false, open);
  tab(state, echoes, true, open);
  ImGui::EndTabBar();
}

void errors_alone(State& state, const OpenPlace& open) {
  for (const Message& message : state.messages) {
    if (message.kind == MessageKind::kError) message_line(state, message, open);
  }
}

}  // namespace

float draw_messages(State& state, float bottom, const OpenPlace& open) {
  const bool has_something =
      state.shows_messages ? !state.messages.empty() : has_error(state.messages);
  const std::string no_picture = state.painting ? state.painting->error : "";
  if (!has_something && no_picture.empty()) return bottom;
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  const float width = std::max(display.x - 20, 50.0f);
  ImGui::SetNextWindowPos({10, bottom - 8}, ImGuiCond_Always, {0, 1});
  ImGui::SetNextWindowSizeConstraints({width, 0}, {width, display.y / 3});
  ImGui::SetNextWindowBgAlpha(0.85f);
  if (ImGui::Begin("##messages", nullptr, kOverlay & ~ImGuiWindowFlags_NoScrollbar)) {
    if (!no_picture.empty()) line(kErrorColor, no_picture, {}, open);
    if (!state.shows_messages) {
      errors_alone(state, open);
    } else if (has_something) {
      all_messages(state, open);
    }
  }
  const float top = ImGui::GetWindowPos().y;
  ImGui::End();
  return top;
}

}  // namespace window
