// Tells which part has the keys: the picture, or a panel, a menu or a dialogue of Dear ImGui's.
#pragma once

namespace window {

/// Returns whether a menu, a list or a dialogue is open.
bool is_popup_open();

/// Returns whether that is so, or a text is being typed.
bool dialogue_has_keys();

/// Returns whether the keys that walk along ImGui's items are ImGui's: dialogue_has_keys(), or a
/// key has entered a panel. A panel that the mouse has clicked leaves them to the picture.
bool panels_have_keys();

/// Enters the next panel, from the upper left to the lower right, or the one before if `direction`
/// is below 0. After the last of them the picture has the keys.
void enter_panel(int direction);

/// Chooses the first item of a panel that has been entered. To be called at the start of a frame,
/// where ImGui forgets what was asked for before.
void choose_first_item();

/// Gives the keys to the picture.
void leave_panels();

/// Closes all menus and lists. Returns whether anything was open.
bool close_menus();

/// Marks the panel that a key has entered, and leaves one that is gone. To be called once all
/// panels are drawn.
void mark_entered_panel();

/// Has the keys walk along the menu bar, from its first menu on. To be called within the bar,
/// before its menus.
void enter_menu_bar();

/// Returns whether the keys walk along the menu bar, which has no open menu then.
bool keys_walk_menu_bar();

/// Returns whether they have come to the menu that was drawn last, and go no further.
bool is_come_to_menu();

/// Returns whether ImGui goes on to move the focus, or to open a panel, in the next frame.
bool is_focus_moving();

}  // namespace window
