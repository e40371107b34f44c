// Draws everything that lies over the picture; most panels have a file of their own.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "csgcore/view.hpp"
#include "customizer.hpp"
#include "language/customizer_parameter.hpp"
#include "message_list.hpp"
#include "panels/layout.hpp"
#include "state.hpp"

namespace window {

using OpenDesign = std::function<void(const std::string& path)>;

/// Asks for the design to open. `open` is called with the path that is chosen.
void draw_open_dialogue(State& state, const OpenDesign& open);

using SaveFile = std::function<void(const std::string& path)>;

/// Asks for the path of a picture. `save` is called with the path that is entered.
void draw_save_dialogue(State& state, const SaveFile& save);

/// The same for the design's solid or plane figure.
void draw_export_dialogue(State& state, const SaveFile& save);

using RunCommand = std::function<void(Command)>;

/// Draws the menu bar, made from the table of commands. `run` is called with the command that is
/// chosen, `open` with the path of a recent design.
void draw_menu_bar(State& state, const RunCommand& run, const OpenDesign& open);

/// The lower left corner of the section plane's panel, in ImGui's units.
struct SectionCorner {
  float left = 0;
  float bottom = 0;
};

/// Draws the directions of the world's axes above `bottom` in the lower left corner, and the
/// distance of the ground grid's lines, if these are shown.
void draw_orientation(const State& state, const csgcore::View& view, float bottom);

/// Draws the section plane's axis, side and position in the upper right corner if it is on. Without
/// it the corner is beyond the window's.
SectionCorner draw_section(State& state);

/// Returns the right end of the room that the design's parameters and their sets take at the left
/// side; 0 if they are switched off, or there are none.
float customizer_right(const State& state, const SectionCorner& section);

/// Draws them there, above `bottom`, and below the section's panel where there is no room beside
/// it.
void draw_customizer(State& state, float bottom, const SectionCorner& section);

/// Draws what sets the value of one parameter (a slider, a list, a box), as wide as there is room.
/// Returns a new value when the user gives one: while something is dragged, all the time; what is
/// typed, when it is entered.
std::optional<language::ParameterValue> draw_parameter_control(
    const language::CustomizerParameter& parameter, const language::ParameterValue& value,
    ParameterEdit& edit);

/// The part of the window that other panels leave to that of the place, in ImGui's units.
struct FreeRoom {
  float left = 0;
  float bottom = 0;
  SectionCorner section{};
};

/// Returns the height that the panel of the place takes at the room's lower end, if there is little
/// room for it beside the parameters; else 0.
float height_below_parameters(const State& state, const FreeRoom& room);

/// Draws the place of the last measured point in the design's text, and what is round or flat
/// there. `view` is that of the picture, in ImGui's units. `run` is called with the command that
/// opens the editor. Returns the panel's place; it is empty if there is none.
LabelBox draw_place(State& state, const csgcore::View& view, const FreeRoom& room,
                    const RunCommand& run);

/// What labels keep clear of, besides the menu bar; in ImGui's units.
struct LabelRoom {
  float bottom = 0;  // where other panels begin
  LabelBox place{};  // the panel of the place
};

/// Draws the measured points and their distance over the picture. `view` is that of the picture, in
/// ImGui's units.
void draw_points(const State& state, const csgcore::View& view, const LabelRoom& room);

/// Names the leaf under the resting mouse. `pixels_per_unit` are the picture's pixels in ImGui's
/// unit.
void draw_hover_tip(const State& state, float pixels_per_unit);

using OpenPlace = std::function<void(const MessagePlace& place)>;

/// Draws what is wrong with the design, and what its evaluation has said. `bottom` is the lower end
/// of the room for it, in ImGui's units. `open` is called with the place
/// of a message that is clicked. Errors are shown even if the panel is closed.
/// Returns the panel's upper end, or `bottom` if there is none.
float draw_messages(State& state, float bottom, const OpenPlace& open);

/// Draws the design's time (play, pause, and a slider) above `bottom`, if it is switched on.
/// Returns its upper end.
float draw_animation(State& state, float bottom);

/// Draws the status line at the lower end of the window. Returns its upper end, in ImGui's units.
float draw_status_line(const State& state);

/// Draws what the user waits for, how long already, and how to end it; nothing while nothing takes
/// long. `run` is called with Command::kStop.
void draw_progress(const State& state, const RunCommand& run);

/// Draws the sheet of the mouse's gestures and of all keys above `bottom` if it is switched on.
void draw_help(State& state, float bottom);

/// Copies a text to the clipboard, and says so.
void copy(State& state, const std::string& text);

/// Does so with all that is measured, or else all messages.
void copy_measured_or_said(State& state);

/// What the panels ask of the application.
struct PanelActions {
  RunCommand run;  // for commands that State::apply() does not do
  SaveFile save;
  OpenPlace open;
  OpenDesign open_design{};
  SaveFile export_model{};
};

/// Draws all panels. To be called within a frame of ImGui. `view` is that of the picture shown, in
/// ImGui's units, each of which is `pixels_per_unit` of the picture's pixels.
void draw_panels(State& state, const csgcore::View& view, float pixels_per_unit,
                 const PanelActions& actions);

}  // namespace window
