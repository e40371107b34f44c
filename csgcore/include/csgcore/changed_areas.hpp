// The part of a picture that an edit has changed.
#pragma once

#include <vector>

#include "csgcore/frame_settings.hpp"
#include "csgcore/scene_edit.hpp"
#include "csgcore/solid.hpp"
#include "csgcore/view.hpp"

namespace csgcore {

/// Returns areas outside of which the pictures of `before` and `after`, from this view and with
/// these settings (the same scene_box among them), have the same samples, bit for bit. The areas do
/// not overlap, and there are few of them. It is the whole picture
///   - if the solid may have changed anywhere (TreeEdit::kAnywhere);
///   - if the bounds have changed, since rays, the light and the thickness tolerance are fitted to
///     them;
///   - if ids are measured and those of kept primitives have changed.
/// There are no areas if no part of the change is on the screen. `before` and `after` are the
/// solids of the same tree before and after the edit; `tree_edit` is SceneEdit's entry for that
/// tree.
/// The areas hold for both values of Boundary. Hits name primitives by index, and so change
/// everywhere unless edit.keeps_indices().
std::vector<PixelArea> changed_areas(const Solid& before, const Solid& after, const SceneEdit& edit,
                                     TreeEdit tree_edit, const View& view,
                                     const FrameSettings& settings);

/// Returns an area that has every pixel with a point through which a ray may meet the solid.
PixelArea area_of(const Solid& solid, const View& view);

/// Returns the number of pixels in areas that do not overlap.
uint64_t count_pixels(const std::vector<PixelArea>& areas);

}  // namespace csgcore
