// Which part of a picture an edit has changed.
#pragma once

#include <vector>

#include "csgcore/frame_settings.hpp"
#include "csgcore/scene_edit.hpp"
#include "csgcore/solid.hpp"
#include "csgcore/view.hpp"

namespace csgcore {

/// The areas of a picture in which one of `after` differs from one of `before`, both from this view
/// with these settings (scene_box among them), at most: all samples of every other pixel are the
/// same, bit for bit. They do not overlap, and there are few of them. The whole picture
///   - where the solid may have changed anywhere (TreeEdit::kAnywhere);
///   - where its bounds have: rays, the light and the thinnest piece that exists are fitted to
///   them;
///   - where ids are measured and those of primitives that were kept have changed.
/// None if nothing of the change is on the screen. `after` is of the scene after the edit, `before`
/// of the same tree before; `tree_edit` is that tree's.
/// A picture drawn with Boundary::kBehind changes in the same areas. Hits, whose primitives are
/// indices, change everywhere unless edit.keeps_indices().
std::vector<PixelArea> changed_areas(const Solid& before, const Solid& after, const SceneEdit& edit,
                                     TreeEdit tree_edit, const View& view,
                                     const FrameSettings& settings);

/// The pixels through any point of which a ray may meet the solid.
PixelArea area_of(const Solid& solid, const View& view);

/// Number of pixels.
uint64_t count_pixels(const std::vector<PixelArea>& areas);

}  // namespace csgcore
