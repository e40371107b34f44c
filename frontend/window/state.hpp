// The window's state: what its user can change, and what is known of the design.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "animation.hpp"
#include "commands.hpp"
#include "customizer.hpp"
#include "file_browser.hpp"
#include "framing.hpp"
#include "frontend/activity.hpp"
#include "frontend/design_follower.hpp"
#include "frontend/options.hpp"
#include "frontend/overlays.hpp"
#include "message_list.hpp"
#include "navigation.hpp"
#include "painter.hpp"
#include "projection.hpp"
#include "section_plane.hpp"

namespace window {

/// A point of the surface that the user has clicked.
struct MeasuredPoint {
  csgcore::Vec3 position{0.0};  // world space
  csgcore::Vec3 normal{0.0};    // unit, outward
  frontend::LeafPlace place;
  Surface surface;
  bool is_cut = false;  // it is on the section plane, inside of the leaf
};

/// The leaf under the resting mouse.
struct HoveredLeaf {
  PicturePoint at{};
  frontend::LeafPlace place;
  bool is_cut = false;
};

/// Returns the leaf, its place, and the innermost module that it stands in, a line each.
std::string hover_text(const HoveredLeaf& hovered);

/// A dialogue for the path of a file that is to be written.
struct PathDialogue {
  bool is_asked_for = false;
  std::string path;
  std::string path_to_overwrite{};  // that exists: the dialogue asks whether to overwrite it
};

struct State {
  explicit State(const frontend::Options& options);

  // Set by the user.
  Navigation navigation;
  frontend::RenderSettings look;
  frontend::Overlays overlays;
  SectionPlane section;
  std::vector<MeasuredPoint> points;       // at most two
  std::vector<csgcore::Vec3> last_points;  // of the last three clicks, or fewer
  std::size_t chosen_step = 0;             // in the trail of the last of them
  std::optional<HoveredLeaf> hovered;
  bool shows_place = true;
  bool shows_messages = true;
  bool shows_status = true;
  bool shows_orientation = true;  // the directions of the axes, in the corner
  bool shows_help = false;
  bool enters_menus = false;  // a key has asked for the menu
  bool shows_menus = false;   // a menu is open, or keys walk along the menu bar
  Customizer customizer;
  language::LanguageVersion language;  // that the design is evaluated in
  bool shows_parameters = false;
  ParameterEdit parameter_edit;
  std::string new_set;  // the name of a set that is to be saved
  Animation animation;
  bool shows_animation = false;
  std::string message_filter;               // the messages that are shown contain it
  bool asks_for_design = false;             // shows the dialogue for another design
  std::optional<FileBrowser> browser;       // of that dialogue
  std::vector<std::string> recent_designs;  // absolute paths, the newest first
  PathDialogue picture_dialogue;
  PathDialogue model_dialogue;

  // The design.
  std::string name;                                        // the file's name
  std::shared_ptr<const frontend::ImportedDesign> design;  // the last that could be read
  std::optional<frontend::DesignVersion> version;          // the newest
  std::vector<Message> messages;  // its error, if it has one, then what its evaluation has said
  bool is_reading = false;
  bool is_stopped = false;  // the user has ended what was done for the newest version
  std::optional<frontend::Activity> long_activity;  // what the user waits for, beyond a second

  std::string exporting;  // the path of the model that is being made; empty: none

  // The picture.
  std::optional<Painting> painting;  // the one shown, without its image
  double frames_per_second = 0;      // during the last motion of the camera
  PicturePart free_part;             // which the panels leave free
  std::string notice;                // tells the outcome of the last action

  /// Begins with another design, that of these options. What the user has chosen for all designs
  /// stays.
  void begin(const frontend::Options& options);
  /// Does a command that needs nothing but this state. Returns whether it was one.
  bool apply(Command command);
  bool is_checked(Command command) const;
  /// Takes the newest version of the design.
  void take(frontend::DesignVersion newest);
  /// Returns whether Command::kForgetPoints does anything.
  bool has_anything_to_forget() const { return !points.empty() || shows_help; }
  /// The box of what is seen of the design; empty without a design.
  csgcore::Box bounds() const;
  /// Shows all that is seen of it, from the present direction and clear of the panels.
  void view_all();
  /// Forgets a pair of points before.
  void measure(MeasuredPoint point);
  /// Returns the place that the editor is to show: the chosen one of the last measured point, or
  /// that under the mouse; null if there is none.
  const frontend::SourcePlace* place_to_open() const;
  /// Turns the section on, with that unit normal, across the middle of the design. The side towards
  /// the eye is cut off.
  void set_section_normal(const csgcore::Vec3& normal);
  /// Does the same with a plane through a point.
  void set_section(const csgcore::Vec3& normal, const csgcore::Vec3& point);
  /// Moves the section plane along its normal, by a share of the design's size, if it is on; within
  /// the design's box.
  void move_section(double share);
  /// Turns the section plane about the axes of the picture and the point of it that is nearest to
  /// the middle of the design, if it is on.
  void turn_section(double about_x_deg, double about_y_deg);
  /// Returns that point. Precondition: there is a design.
  csgcore::Vec3 section_middle() const;

 private:
  void ask_for_model();
  void cut_along_face();
  void cut_through_points();

  /// bounds() and of what design, since that takes some milliseconds.
  mutable std::pair<std::shared_ptr<const frontend::ImportedDesign>, csgcore::Box> bounds_;
};

/// Returns the status line: what is drawn, how long each stage took, and by what.
std::string status_line(const State& state);
/// Returns the most important parts of the status line that `fits` accepts. The number of
/// primitives, and that the design is being read, are always kept.
std::string status_line(const State& state, const std::function<bool(const std::string&)>& fits);

}  // namespace window
