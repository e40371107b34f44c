// Draws everything that lies over the picture: menu, status line, messages, section, measured
// points, help.
#pragma once

#include <functional>

#include "csgcore/view.hpp"
#include "state.hpp"

namespace window {

class Panels {
 public:
  using Run = std::function<void(Command)>;
  /// `run` is called for commands that State::apply() does not do; `save` with the path of a
  /// picture.
  Panels(Run run, std::function<void(const std::string& path)> save)
      : run_(std::move(run)), save_(std::move(save)) {}

  /// To be called within a frame of ImGui. `view` is that of the picture shown, in ImGui's units.
  void draw(State& state, const csgcore::View& view);

 private:
  void draw_menu_bar(State& state);
  void draw_schemes(State& state);
  void draw_messages(const State& state, float bottom) const;
  float draw_status(const State& state) const;
  void draw_section(State& state) const;
  void draw_points(const State& state, const csgcore::View& view) const;
  void draw_help(State& state) const;
  void draw_save_dialogue(State& state);

  const Run run_;
  const std::function<void(const std::string&)> save_;
};

}  // namespace window
