// What `--renderer=auto` takes. The decision must not start OpenGL: on Mesa's software renderer
// that alone takes longer than the CPU needs for a picture.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>

namespace frontend {

/// Where Linux shows its GPUs.
struct GpuFolders {
  std::string devices = "/dev/dri";        // render nodes: renderD128, …
  std::string classes = "/sys/class/drm";  // renderD128/device/driver, a link to the driver
};

/// What is asked of OpenGL's driver. Tests feign others by it.
struct GlDemands {
  bool takes_software = false;  // by `auto`, too
  /// A driver is taken for one that allows no larger buffers (HeadlessContext::set_most_texels).
  uint64_t most_texels = std::numeric_limits<uint64_t>::max();
};

/// Why OpenGL would have no GPU here, as far as can be seen without asking OpenGL; nothing if there
/// is a render node of a driver with 3D that this process may open, and the environment does not
/// ask Mesa for software.
std::optional<std::string> why_no_gpu(const GpuFolders& folders = {});

/// Whether GL_RENDERER names a rasteriser that runs on the CPU.
bool is_software(const std::string& gl_renderer);

}  // namespace frontend
