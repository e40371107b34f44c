// What the mouse does: it moves the camera and the section plane, measures, and names leaves.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>
#include <utility>

#include "application.hpp"
#include "projection.hpp"

namespace window {
namespace {

/// The step by which a plane is moved, as a share of the design's size, to see how its normal runs
/// on the screen.
constexpr double kSectionStep = 0.01;
/// A normal along which that step is shorter than this is seen end-on.
constexpr double kLeastNormal_px = 0.25;
/// A plane turns by so much for each pixel of a drag, as the view does.
constexpr double kSectionTurn_deg = 0.7;

/// A click measures a vertex, an edge or a circle's centre that is no further away, in units of the
/// screen.
constexpr double kSnapReach = 7;

}  // namespace

void Application::press(Button button, double x_px, double y_px) {
  if (button != Button::kRight || options_.pans_far) return;
  probe({x_px, y_px}, Probe::Purpose::kPan);
  pan_ = {probes_, state_.navigation, state_.navigation, 0, 0, state_.navigation.camera().distance};
}

void Application::drag(Button button, uint8_t modifiers, double dx_px, double dy_px) {
  const Size size = window_.size();
  const bool with_shift = (modifiers & kShift) != 0;
  is_moving_ = true;
  end_hover();
  if (button == Button::kLeft && (modifiers & kControl) && state_.section.is_on) {
    if (with_shift) {
      state_.turn_section(kSectionTurn_deg * dy_px, kSectionTurn_deg * dx_px);
    } else {
      drag_section(dx_px, dy_px);
    }
  } else if (button == Button::kLeft) {
    state_.navigation.turn(dx_px, dy_px, with_shift);
  } else if (button == Button::kMiddle || with_shift) {
    state_.navigation.move_along(dy_px, size);
  } else if (options_.pans_far) {
    state_.navigation.pan_far(dx_px, dy_px, size);
  } else {
    state_.navigation = pan_.move(state_.navigation, dx_px, dy_px, size);
  }
}

/// Moves the plane so that it follows the mouse along its normal, as that is seen.
void Application::drag_section(double dx_px, double dy_px) {
  const csgcore::Box bounds = state_.bounds();
  if (bounds.empty()) return;
  SectionPlane& section = state_.section;
  const csgcore::View view = state_.navigation.view(window_.size());
  const csgcore::Vec3 on_plane = state_.section_middle();
  const double step = bounds.diagonal() * kSectionStep;
  const auto from = project(view, on_plane), to = project(view, on_plane + step * section.normal);
  if (!from || !to) return;
  const double x = to->x_px - from->x_px, y = to->y_px - from->y_px;
  const double length_px = std::hypot(x, y);
  // A plane that is seen along its normal does not move on the screen: a drag downwards moves it
  // forward.
  const double moved_px =
      length_px >= kLeastNormal_px ? (dx_px * x + dy_px * y) / length_px : dy_px;
  const double position = section.position + step * moved_px / std::max(length_px, kLeastNormal_px);
  const auto [low, high] = positions_in(bounds, section.normal);
  section.position = std::clamp(position, low, high);
}

void Application::wheel(double notches, double x_px, double y_px) {
  is_moving_ = true;
  end_hover();
  state_.navigation.zoom(notches, x_px, y_px, window_.size());
}

void Application::click(uint8_t modifiers, double x_px, double y_px) {
  end_hover();
  const double snap_px = (modifiers & kAlt) ? 0 : kSnapReach * window_.pixels_per_unit();
  probe({x_px, y_px}, Probe::Purpose::kMeasure, snap_px);
}

void Application::right_click() { run_command(Command::kCopy); }

void Application::double_click(double x_px, double y_px) {
  end_hover();
  state_.points.clear();
  probe({x_px, y_px}, Probe::Purpose::kCenter);
}

void Application::move(double x_px, double y_px) {
  end_hover();
  hover_.move({x_px, y_px}, Clock::now());
}

void Application::leave() { end_hover(); }

void Application::end_hover() {
  hover_.stop();
  hovering_ = 0;
  state_.hovered.reset();
}

/// Asks for the leaf under the mouse once it rests.
void Application::probe_hover() {
  const std::optional<PicturePoint> place = hover_.take(Clock::now());
  if (!place || window_.is_over_panel()) return;
  probe(*place, Probe::Purpose::kHover);
  hovering_ = probes_;
}

void Application::probe(const PicturePoint& place, Probe::Purpose purpose, double snap_px) {
  if (!state_.design) return;
  Probe probe;
  probe.number = ++probes_;
  probe.purpose = purpose;
  probe.order = wanted_picture();
  probe.place = place;
  probe.snap_px = snap_px;
  probe.tree = tree_;
  painter_.probe(std::move(probe));
}

void Application::take_finding(const Finding& finding) {
  const Probe& probe = finding.probe;
  // The finding belongs to a design that is gone.
  if (probe.order.design != state_.design) return;
  switch (probe.purpose) {
    case Probe::Purpose::kPan:
      if (!finding.is_hit || probe.number != pan_.probe) return;
      pan_.depth = glm::dot(finding.position - probe.order.navigation.view({1, 1}).eye,
                            probe.order.navigation.view({1, 1}).forward);
      if (state_.navigation == pan_.now)
        state_.navigation = pan_.move(pan_.now, 0, 0, window_.size());
      return;
    case Probe::Purpose::kCenter:
      if (finding.is_hit) state_.navigation.look_at(finding.position);
      state_.points.clear();  // the first of the two clicks has measured a point
      if (!state_.last_points.empty()) state_.last_points.pop_back();
      return;
    case Probe::Purpose::kHover:
      if (!finding.is_hit || probe.number != hovering_) return;
      state_.hovered = {probe.place, finding.place, finding.is_cut};
      break;
    case Probe::Purpose::kMeasure:
      if (finding.is_hit) {
        state_.measure(
            {finding.position, finding.normal, finding.place, finding.surface, finding.is_cut});
      } else {
        state_.points.clear();
      }
      break;
  }
  has_new_picture_ = true;
}

}  // namespace window
