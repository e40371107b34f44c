#include <imgui.h>

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

#include "commands.hpp"
#include "panels/panels.hpp"
#include "panels/style.hpp"

namespace window {
namespace {

/// The gestures of OpenSCAD (frontend/OPENSCAD.md, "Window"), our own, and the keys that are no
/// commands.
constexpr const char* kMouse[][2] = {
    {"Left drag", "turn; with shift: about y"},
    {"Right drag", "pan"},
    {"Middle drag", "forward and back; also shift + right drag"},
    {"Wheel", "zoom at the cursor"},
    {"Click", "measure: the point, its leaf, and the place of that in the design"},
    {"Alt + click", "measure just there: not the vertex, edge or centre next to it"},
    {"Second click", "the distance between the two"},
    {"Right click", "copy what is measured or said; on a message: that"},
    {"Rest", "name the leaf under the mouse"},
    {"Double click", "centre on the point"},
    {"Ctrl + left drag", "drag the section plane; with shift: turn it"},
    {"Arrows", "turn; with shift: pan"},
    {"+, -", "zoom"},
    {"Page up, page down", "move the section plane"},
    {"Enter", "measure the point in the middle"},
    {"Alt, F10", "open the menu"},
    {"Tab", "enter the next panel; Esc leaves it"},
};

struct HelpRow {
  const char* what;
  const char* does;
};

std::vector<HelpRow> help_rows() {
  std::vector<HelpRow> rows;
  for (const auto& [what, does] : kMouse) rows.push_back({what, does});
  for (const CommandRow& command : command_rows()) {
    if (*command.shortcut != '\0') rows.push_back({command.shortcut, command.label});
  }
  return rows;
}

/// Rows that stand below each other, and the widths of their two columns.
struct Block {
  std::span<const HelpRow> rows;
  float what = 0, does = 0;
};

/// Returns the space between blocks.
float gap() { return 2 * ImGui::GetFontSize(); }

float width_of(const std::vector<Block>& blocks) {
  const ImGuiStyle& style = ImGui::GetStyle();
  float width = 2 * style.WindowPadding.x + style.ScrollbarSize +
                static_cast<float>(blocks.size() - 1) * gap();
  for (const Block& block : blocks) width += block.what + block.does + 4 * style.CellPadding.x;
  return width;
}

/// Divides the rows into blocks of that many.
std::vector<Block> blocks_of(std::span<const HelpRow> rows, std::size_t most) {
  std::vector<Block> blocks;
  while (!rows.empty()) {
    Block& block = blocks.emplace_back();
    block.rows = rows.first(std::min(most, rows.size()));
    rows = rows.subspan(block.rows.size());
    for (const HelpRow& row : block.rows) {
      block.what = std::max(block.what, text_width(row.what));
      block.does = std::max(block.does, text_width(row.does));
    }
  }
  return blocks;
}

/// Returns blocks that lie beside each other, as many as are needed to fit into the height, or as
/// the width allows. Where even one is too wide, its second column is made narrower.
std::vector<Block> fitted_blocks(std::span<const HelpRow> rows, float width, float height) {
  const float row = ImGui::GetTextLineHeight() + 2 * ImGui::GetStyle().CellPadding.y;
  const auto most = static_cast<std::size_t>(std::max(height / row, 1.0f));
  std::vector<Block> blocks = blocks_of(rows, rows.size());
  for (std::size_t count = 2; blocks.front().rows.size() > most && count <= rows.size(); ++count) {
    std::vector<Block> more = blocks_of(rows, (rows.size() + count - 1) / count);
    if (width_of(more) > width) break;
    blocks = std::move(more);
  }
  const float excess = std::max(width_of(blocks) - width, 0.0f);
  blocks.front().does = std::max(blocks.front().does - excess, 1.0f);
  return blocks;
}

void draw_block(const Block& block) {
  if (!ImGui::BeginTable("##keys", 2, ImGuiTableFlags_None,
                         {block.what + block.does + 4 * ImGui::GetStyle().CellPadding.x, 0})) {
    return;
  }
  ImGui::TableSetupColumn("what", ImGuiTableColumnFlags_WidthFixed, block.what);
  ImGui::TableSetupColumn("does", ImGuiTableColumnFlags_WidthFixed, block.does);
  for (const HelpRow& row : block.rows) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(row.what);
    ImGui::TableNextColumn();
    ImGui::TextWrapped("%s", row.does);
  }
  ImGui::EndTable();
}

}  // namespace

void draw_help(State& state, float bottom) {
  if (!state.shows_help) return;
  const ImGuiStyle& style = ImGui::GetStyle();
  const float display = ImGui::GetIO().DisplaySize.x, top = ImGui::GetFrameHeight();
  const std::vector<HelpRow> rows = help_rows();
  const float frame = ImGui::GetFrameHeight() + 2 * style.WindowPadding.y;
  const std::vector<Block> blocks = fitted_blocks(rows, display, bottom - top - frame);
  ImGui::SetNextWindowPos({display / 2, (top + bottom) / 2}, ImGuiCond_Always, {0.5f, 0.5f});
  ImGui::SetNextWindowSizeConstraints({0, 0}, {display, bottom - top});
  if (ImGui::Begin("Mouse and keys", &state.shows_help,
                   ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings |
                       ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoMove)) {
    for (std::size_t i = 0; i < blocks.size(); ++i) {
      if (i > 0) ImGui::SameLine(0, gap());
      ImGui::PushID(static_cast<int>(i));
      draw_block(blocks[i]);
      ImGui::PopID();
    }
  }
  ImGui::End();
}

}  // namespace window
