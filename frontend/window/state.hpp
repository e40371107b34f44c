// What the window shows: all that its user can change, and what is known of the design.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "commands.hpp"
#include "frontend/design_follower.hpp"
#include "frontend/options.hpp"
#include "frontend/overlays.hpp"
#include "navigation.hpp"
#include "painter.hpp"
#include "section_plane.hpp"

namespace window {

/// A point of the surface that was clicked on.
struct MeasuredPoint {
  csgcore::Vec3 position{0.0};  // world space
  csgcore::Vec3 normal{0.0};    // unit, outward
  std::string primitive;        // what it is, and its line in the .csg
};

struct State {
  explicit State(const frontend::Options& options);

  // The user's.
  Navigation navigation;
  frontend::RenderSettings look;
  frontend::Overlays overlays;
  SectionPlane section;
  std::vector<MeasuredPoint> points;  // at most two
  bool shows_messages = true;
  bool shows_status = true;
  bool shows_help = false;
  bool asks_for_path = false;  // where to save the picture
  std::string picture_path;

  // The design's.
  std::string name;                                        // of its file
  std::shared_ptr<const frontend::ImportedDesign> design;  // the last that could be read
  std::optional<frontend::DesignVersion> version;          // the newest
  bool is_reading = false;

  // The picture's.
  std::optional<Painting> painting;  // that is shown, without its image
  double frames_per_second = 0;      // while the camera moved last
  std::string notice;                // of what was done last

  /// Does what needs nothing but this state. Returns whether it was that.
  bool apply(Command command);
  bool is_checked(Command command) const;
  /// Of the design; empty without one.
  csgcore::Box bounds() const;
  /// Turns the section on, across the middle of the design: what is on the eye's side is cut off.
  void set_section_axis(uint8_t axis);
};

/// The status line: what is drawn, how long each stage took, and by what.
std::string status_line(const State& state);
/// Of it what matters most, as much as `fits`: the number of primitives, and that the design is
/// being read, stay in any case.
std::string status_line(const State& state, const std::function<bool(const std::string&)>& fits);

}  // namespace window
