// The command by which the user's editor shows a place.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace window {

struct EditorPlace {
  std::string path;     // absolute
  uint32_t line = 1;    // from 1
  uint32_t column = 1;  // in characters, from 1
};

struct EditorCommand {
  std::vector<std::string> words;  // the program and its arguments; empty: there is a problem
  std::string problem;             // and what to do
};

/// Returns the editor that is to be used: `option`, or the first of $SCADRAY_EDITOR, $VISUAL and
/// $EDITOR that is set; empty if none is.
std::string chosen_editor(const std::string& option);

/// Returns the words that `editor` is started with. It is a command line, in which quotes and
/// backslashes mean what they mean to a shell, and nothing else does. {file}, {line} and {column}
/// stand for the place; where the line has none of them, an editor that is known by its name gets
/// the place in its own form, and any other the file alone. Editors for terminals are a problem: a
/// window has none for them.
EditorCommand editor_command(const std::string& editor, const EditorPlace& place);

}  // namespace window
