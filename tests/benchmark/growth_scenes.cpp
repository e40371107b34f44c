#include "growth_scenes.hpp"

#include <cmath>
#include <glm/geometric.hpp>

#include "frame.hpp"
#include "growth_parts.hpp"

namespace frame_benchmark {
namespace {

using csgcore::Op;
using csgcore::Scene;
using csgcore::View;

// (a) Off the screen.

/// The parts are beside, above and below what the picture shows, and behind the eye.
Scene off_screen(uint32_t unseen) {
  Composer composer;
  composer.add_body();
  for (uint32_t i = 0; i < unseen; ++i) {
    const double aside = composer.uniform(1.2, 4) * (composer.toss() ? -1 : 1);
    const double along = composer.uniform(-4, 4);
    double depth = distance_to_body() * composer.uniform(0.2, 2);
    if (i % 4 == 0) depth = -depth;
    const bool beside = i % 2 == 0;
    composer.add_part(
        {on_screen(aspect() * (beside ? aside : along), beside ? along : aside, depth),
         composer.part_reach()});
  }
  return composer.finish();
}

/// Holes in those parts of the plate that the picture does not show, as if a person had zoomed in.
Scene off_screen_holes(uint32_t unseen) {
  constexpr double kPlate = 300;
  Composer composer;
  composer.open_plate(kPlate);
  const double border = 0.1;
  for (uint32_t i = 0; i < unseen;) {
    const double across = composer.uniform(-18, 18);
    const double upwards = composer.uniform(-18, 18);
    const Vec3 center = on_screen(across, upwards, plate_depth());
    const bool shown = std::abs(across) < aspect() + border && std::abs(upwards) < 1 + border;
    if (shown || glm::length(center) > kPlate - 1) continue;
    composer.add_ball({center, kPlateHole});
    ++i;
  }
  composer.close();
  return composer.finish();
}

// (b) Hidden.

Scene behind_body(uint32_t unseen) {
  Composer composer;
  composer.add_body();
  for (uint32_t i = 0; i < unseen; ++i) {
    composer.add_part(
        composer.find([&] { return composer.anywhere_on_screen(1.1, 2); }, is_in_shadow));
  }
  return composer.finish();
}

/// Holes on the side of the body that faces away.
Scene holes_behind(uint32_t unseen) {
  Composer composer;
  composer.open_body();
  const double reach = 20 / std::sqrt(200'000.0);
  for (uint32_t i = 0; i < unseen; ++i) {
    composer.add_ball(composer.find(
        [&] {
          return Place{composer.anywhere_on_body().position, reach};
        },
        is_in_shadow));
  }
  composer.close();
  return composer.finish();
}

Scene behind_wall(uint32_t unseen) {
  constexpr double kPlate = 40;
  Composer composer;
  composer.open_plate(kPlate);
  composer.close();
  for (uint32_t i = 0; i < unseen; ++i) {
    composer.add_part(composer.anywhere_on_screen(1.05, 1.5));
  }
  return composer.finish();
}

/// Voids that no ray reaches.
Scene voids(uint32_t unseen) {
  Composer composer;
  composer.open_body();
  for (uint32_t i = 0; i < unseen; ++i) {
    composer.add_part(composer.find([&] { return composer.anywhere_in_body(); }, is_in_core));
  }
  composer.close();
  return composer.finish();
}

// (c) Inside the solid.

Scene inside(uint32_t unseen) {
  Composer composer;
  composer.add_body();
  for (uint32_t i = 0; i < unseen; ++i) {
    composer.add_part(composer.find([&] { return composer.anywhere_in_body(); }, is_in_core));
  }
  return composer.finish();
}

// (d) Cancelled by the operations.

/// Parts are subtracted between the body and the eye, and beside the body.
Scene subtracted_from_nothing(uint32_t unseen) {
  Composer composer;
  composer.open_body();
  for (uint32_t i = 0; i < unseen; ++i) {
    composer.add_part(
        composer.find([&] { return composer.anywhere_on_screen(0.6, 1.2); }, is_off_body));
  }
  composer.close();
  return composer.finish();
}

/// A ball in front of the body's left half.
Place ball_in_front() { return {on_screen(-0.3, 0, 0.6 * distance_to_body()), 4}; }

void add_union_in(Composer& composer, const Place& ball, uint32_t count) {
  composer.open(Op::kUnion);
  for (uint32_t i = 0; i < count; ++i) composer.add_part(composer.anywhere_in(ball));
  composer.close();
}

Scene added_and_subtracted(uint32_t unseen) {
  Composer composer;
  composer.add_body();
  if (unseen > 0) {
    composer.open(Op::kDifference);
    add_union_in(composer, ball_in_front(), unseen - 1);
    composer.add_ball(ball_in_front());
    composer.close();
  }
  return composer.finish();
}

Scene intersected_with(const Place& elsewhere, uint32_t unseen) {
  Composer composer;
  composer.add_body();
  if (unseen > 0) {
    composer.open(Op::kIntersection);
    add_union_in(composer, ball_in_front(), unseen - 1);
    composer.add_ball(elsewhere);
    composer.close();
  }
  return composer.finish();
}

Scene intersected_beside(uint32_t unseen) {
  return intersected_with({on_screen(0.7, 0, 0.6 * distance_to_body()), 4}, unseen);
}

/// The two are one behind the other.
Scene intersected_behind(uint32_t unseen) {
  return intersected_with({on_screen(-0.3, 0, 0.8 * distance_to_body()), 4}, unseen);
}

// (e) Between the samples.

/// Parts around pixels' corners, a tenth of a pixel across, in front of the body and beside it.
Scene between_samples(uint32_t unseen) {
  Composer composer;
  composer.add_body();
  const View& view = growth_view();
  const auto corner = [&](uint32_t size_px) {
    const double px = 1 + std::floor(composer.uniform(0, size_px - 1.0));
    return (2 * (px + composer.uniform(-0.2, 0.2)) - size_px) / view.height_px;
  };
  for (uint32_t i = 0; i < unseen; ++i) {
    const double depth = composer.uniform(0.6, 0.8);
    const double across = corner(view.width_px);
    composer.add_part({on_screen(across, corner(view.height_px), depth * distance_to_body()),
                       0.05 * depth * pixel_at_body()});
  }
  return composer.finish();
}

}  // namespace

const View& growth_view() {
  static const View view = default_view({Vec3{-kBody}, Vec3{kBody}});
  return view;
}

std::span<const GrowthScene> growth_scenes() {
  static constexpr GrowthScene kScenes[] = {
      {"off_screen", off_screen},
      {"off_screen_holes", off_screen_holes},
      {"hidden_behind_body", behind_body},
      {"hidden_holes_behind", holes_behind},
      {"hidden_behind_wall", behind_wall},
      {"hidden_voids", voids},
      {"inside", inside},
      {"cancelled_subtracted_from_nothing", subtracted_from_nothing},
      {"cancelled_added_and_subtracted", added_and_subtracted},
      {"cancelled_intersected_beside", intersected_beside},
      {"cancelled_intersected_behind", intersected_behind},
      {"between_samples", between_samples}};
  return kScenes;
}

}  // namespace frame_benchmark
