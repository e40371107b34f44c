// Scenes with faces that two primitives share: caps, walls, whole shells; and the same seen at
// grazing angles.
#include <cmath>

#include "cases.hpp"

namespace stress {
namespace {

Part through_hole() { return rod(0, 10, 8) - rod(0, 10, 5); }
Part inlay() { return (rod(0, 10, 8) - rod(6, 10, 5)) + rod(6, 10, 5); }
Part tower() { return all_of({rod(0, 10, 8), rod(10, 20, 8), rod(-7, 0, 3)}); }

/// Discs with a common top plane, side by side and overlapping, every third one cut out again.
Part discs_in_one_plane() {
  Part result = rod(0, 2, 9);
  for (int i = 0; i < 12; ++i) {
    const double angle = i * 0.7;
    const Part disc = rod(1, 2, 1.5 + 0.2 * i, {6 * std::cos(angle), 6 * std::sin(angle), 0});
    result = i % 3 == 2 ? result - disc : result + disc;
  }
  return result;
}

/// A plate whose hole is given in a frame that is composed in the other order, so that planes and
/// axes agree only to a double's rounding.
Part turned_frames() {
  const Affine first = turn(17, 29, 0), second = turn(0, 0, 43);
  const Part plate = rod(0, 4, 9).under(csgcore::compose(first, second));
  const Part hole = rod(0, 4, 4).at({2, 1, 0}).under(second).under(first);
  const Part plug = rod(0, 4, 4).under(second).at({-3, -2, 0}).under(first);
  return (plate - hole - plug) + plug;
}

/// Two discs that touch side by side, both flush with the part that they are in.
Part touching_discs() {
  return (rod(0, 5, 10) - rod(3, 5, 4, {-4, 0, 0}) - rod(3, 5, 4, {4, 0, 0})) +
         rod(4, 5, 4, {-4, 0, 0});
}

/// Plugs, one inside the other, flush with the plate around the hole: where they are seen, the
/// plate's own top is cut away.
Part two_plugs_in_a_hole() { return (rod(0, 4, 9) - rod(1, 4, 5)) + rod(1, 4, 5) + rod(0, 4, 3); }

/// Two such plugs, one of whose tops is intersected with a part that is elsewhere.
Part beside_a_common_part() {
  return rod(0, 4, 9) * rod(0, 4, 9, {15, 0, 0}) + rod(1, 4, 5) + rod(0, 4, 3);
}

Family coincident_caps() {
  return {"coincident_caps",
          {{"through_hole", [] { return through_hole().scene(); }},
           {"blind_hole", [] { return (rod(0, 10, 8) - rod(4, 10, 5)).scene(); }},
           {"tower", [] { return tower().scene(); }},
           {"inlay", [] { return inlay().scene(); }},
           {"cut_that_touches", [] { return (rod(0, 10, 8) - rod(10, 15, 9)).scene(); }},
           {"common_lid",
            [] {
              return (rod(0, 10, 8) * rod(3, 10, 6, {4, 0, 0})).scene();
            }},
           {"discs_in_one_plane", [] { return discs_in_one_plane().scene(); }},
           {"turned_frames", [] { return turned_frames().scene(); }},
           {"touching_discs", [] { return touching_discs().scene(); }},
           {"two_plugs_in_a_hole", [] { return two_plugs_in_a_hole().scene(); }},
           {"beside_a_common_part", [] { return beside_a_common_part().scene(); }},
           {"half_filled", [] { return (rod(0, 10, 8) - rod(0, 10, 5) + rod(0, 5, 5)).scene(); }}},
          true};
}

/// Each ring's hole is the next ring's wall.
Part rings() {
  return all_of({rod(0, 3, 9) - rod(0, 3, 7), rod(0, 5, 7) - rod(0, 5, 4), rod(1, 8, 4)});
}

Part split_cone() {
  const Part outside = cone(0, 5, 8, 6) + cone(5, 10, 6, 4);
  const Part inside = cone(0, 5, 6, 4) + cone(5, 10, 4, 2);
  return outside - inside;
}

/// The same walls, with frames turned about their axis.
Part turned_about_their_axis() {
  const Part body = rod(0, 10, 6).under(turn(0, 0, 11));
  const Part same = rod(-2, 6, 6).under(turn(0, 0, 47));
  const Part plug = rod(3, 8, 6).under(turn(0, 0, 73));
  return ((body - same) + plug).under(turn(33, 21, 0));
}

Family coaxial_walls() {
  return {
      "coaxial_walls",
      {{"same_wall_cut", [] { return (rod(0, 10, 8) - rod(5, 15, 8)).scene(); }},
       {"sleeve", [] { return (rod(0, 10, 8) - rod(0, 10, 5) + rod(0, 10, 5)).scene(); }},
       {"long_sleeve", [] { return (rod(0, 10, 8) - rod(-1, 11, 5) + rod(-3, 13, 5)).scene(); }},
       {"split_cone", [] { return split_cone().scene(); }},
       {"rings", [] { return rings().scene(); }},
       {"turned_about_their_axis", [] { return turned_about_their_axis().scene(); }},
       {"common_wall", [] { return (rod(0, 10, 5) * rod(-4, 6, 5)).scene(); }},
       {"same_cone_cut", [] { return (cone(0, 10, 8, 3) - cone(0, 10, 8, 3)).scene(); }}},
      true};
}

Part equal_balls(Op op, int count) { return Part::combined(op, std::vector<Part>(count, ball(4))); }

/// Parts are added and taken away in turns, and added last.
Part in_turns() {
  Part result = ball(5);
  for (int i = 0; i < 9; ++i) result = i % 2 ? result + ball(5) : result - ball(5);
  return result + ball(5);
}

/// Nested shells, each of equal pairs, opened at the side.
Part onion() {
  Part result = ball(10) + ball(10);
  for (int i = 9; i > 3; --i) {
    const Part shell = ball(i) + ball(i);
    result = i % 2 ? result - shell : result + shell;
  }
  return result - rod(-11, 11, 8, {9, 0, 0});
}

/// Equal cones, turned about their axis, minus as many equal shorter ones.
Part many_equal_cones() {
  std::vector<Part> cones, cuts;
  for (int i = 0; i < 40; ++i) {
    cones.push_back(cone(0, 10, 6, 0).under(turn(0, 0, 9 * i)));
    cuts.push_back(cone(0, 5, 6, 3).under(turn(0, 0, 7 * i)));
  }
  return all_of(cones) - all_of(cuts);
}

Family nested_equal_shells() {
  return {"nested_equal_shells",
          {{"twelve_balls_in_common", [] { return equal_balls(Op::kIntersection, 12).scene(); }},
           {"hundred_balls_added", [] { return equal_balls(Op::kUnion, 100).scene(); }},
           {"in_turns", [] { return in_turns().scene(); }},
           {"onion", [] { return onion().scene(); }},
           {"many_equal_cones", [] { return many_equal_cones().scene(); }}},
          true};
}

/// Cameras 0.1° and 0.001° above and below the plane of the model's top, close and far, with the
/// plane in the picture.
std::vector<Camera> grazing_cameras(const Scene& scene, PictureSize size) {
  const Box box = camera_box(scene);
  const auto above_top = [&](Projection projection, double above_deg, double distance) {
    View view = view_around(box, size, projection, 40, above_deg, distance);
    view.eye.z += box.max.z - box.center().z;
    view.half_height /= 8;
    return view;
  };
  return {{"0.1 deg", above_top(Projection::kPerspective, 0.1, 1.5)},
          {"0.001 deg", above_top(Projection::kPerspective, 0.001, 1.5)},
          {"orthographic 0.001 deg", above_top(Projection::kOrthographic, 0.001, 3)}};
}

Family grazing() {
  return {"grazing",
          {{"through_hole", [] { return through_hole().scene(); }, grazing_cameras},
           {"inlay", [] { return inlay().scene(); }, grazing_cameras},
           {"discs_in_one_plane", [] { return discs_in_one_plane().scene(); }, grazing_cameras},
           {"level_with_two_rods",
            [] {
              return (rod(0, 10, 8) + rod(10, 10.5, 2, {-3, 0, 0})).scene();
            },
            grazing_cameras}},
          true};
}

/// Differences without thickness, or thinner than the tolerance: nothing is left, or the rest has
/// no skin.
Family zero_thickness() {
  const auto grown = [](double share) { return rod(0, 10 * (1 + share), 6 * (1 + share)); };
  return {
      "zero_thickness",
      {{"rod_less_itself", [] { return (rod(0, 10, 6) - rod(0, 10, 6)).scene(); }},
       {"rod_less_one_grown_by_1e-13", [grown] { return (rod(0, 10, 6) - grown(1e-13)).scene(); }},
       {"grown_by_1e-11_less_rod",
        [grown] {
          return (ball(3, {12, 0, 0}) + (grown(1e-11) - rod(0, 10, 6))).scene();
        }},
       {"plates_1e-10_apart",
        [] { return (rod(0, 2, 6) + rod(2 + 1e-10, 4, 6) - rod(1, 3, 2)).scene(); }},
       {"skins_of_1e-10_and_1e-6",
        [] {
          return ((ball(4) - ball(4 - 1e-10)) + (ball(4) - ball(4 - 1e-6)).at({9, 0, 0})).scene();
        }}},
      true};
}

}  // namespace

std::vector<Family> coincident_families() {
  return {coincident_caps(), coaxial_walls(), nested_equal_shells(), grazing(), zero_thickness()};
}

}  // namespace stress
