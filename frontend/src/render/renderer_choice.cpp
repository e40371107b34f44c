#include "render/renderer_choice.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string_view>

namespace frontend {
namespace {

namespace fs = std::filesystem;

/// Drivers of render nodes with no 3D behind them. Most display-only drivers (ast, bochs-drm,
/// cirrus, mgag200, simpledrm, udl, …) make no render node at all; these are the virtual ones that
/// do, or have done, with the name of the bus that they hang on since Linux 6.15. A node without
/// any driver is a virtual one on an older Linux.
constexpr std::string_view kVirtualDrivers[] = {"vgem", "vkms", "bochs-drm", "faux_driver"};

/// Mesa's gallium drivers that run on the CPU (GALLIUM_DRIVER, MESA_LOADER_DRIVER_OVERRIDE).
constexpr std::string_view kSoftwareDrivers[] = {"llvmpipe", "softpipe", "swr", "swrast",
                                                 "kms_swrast"};

/// In GL_RENDERER. "llvmpipe" also stands in the name of zink on lavapipe.
constexpr std::string_view kSoftwareNames[] = {
    "llvmpipe", "softpipe", "swrast", "Software Rasterizer", "SWR", "SwiftShader"};

template <size_t kCount>
bool holds(const std::string_view (&names)[kCount], std::string_view name) {
  return std::find(std::begin(names), std::end(names), name) != std::end(names);
}

std::string_view environment(const char* name) {
  const char* value = std::getenv(name);
  return value ? value : "";
}

/// As Mesa reads its Boolean variables.
bool is_set(const char* name) {
  std::string value(environment(name));
  std::transform(value.begin(), value.end(), value.begin(), [](char c) {
    return 'A' <= c && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  return value == "1" || value == "true" || value == "yes" || value == "y" || value == "t";
}

std::optional<std::string> software_by_environment() {
  if (is_set("LIBGL_ALWAYS_SOFTWARE")) return "LIBGL_ALWAYS_SOFTWARE is set";
  for (const char* name : {"GALLIUM_DRIVER", "MESA_LOADER_DRIVER_OVERRIDE"}) {
    const std::string_view driver = environment(name);
    if (holds(kSoftwareDrivers, driver)) return std::string(name) + " is " + std::string(driver);
  }
  return std::nullopt;
}

bool has_3d_driver(const fs::path& node_class) {
  std::error_code failed;
  const fs::path driver = fs::read_symlink(node_class / "device" / "driver", failed);
  return !failed && !holds(kVirtualDrivers, driver.filename().native());
}

/// Only an open() tells: a container may show a node and yet forbid it.
bool can_open(const fs::path& node) {
  const int descriptor = open(node.c_str(), O_RDWR | O_CLOEXEC | O_NONBLOCK);
  if (descriptor < 0) return false;
  close(descriptor);
  return true;
}

}  // namespace

std::optional<std::string> why_no_gpu(const GpuFolders& folders) {
  if (auto reason = software_by_environment()) return reason;
  std::string reason = "no GPU: " + folders.devices + " has no render node";
  std::error_code failed;
  for (const fs::directory_entry& entry : fs::directory_iterator(folders.devices, failed)) {
    const fs::path name = entry.path().filename();
    if (!name.native().starts_with("renderD")) continue;
    if (!has_3d_driver(fs::path(folders.classes) / name)) {
      reason = "no GPU: " + entry.path().native() + " is a virtual device";
    } else if (!can_open(entry.path())) {
      reason = "no GPU: " + entry.path().native() + " cannot be opened";
    } else {
      return std::nullopt;
    }
  }
  return reason;
}

bool is_software(const std::string& gl_renderer) {
  return std::any_of(
      std::begin(kSoftwareNames), std::end(kSoftwareNames),
      [&](std::string_view name) { return gl_renderer.find(name) != std::string::npos; });
}

}  // namespace frontend
