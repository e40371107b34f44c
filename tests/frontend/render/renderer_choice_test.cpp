// Tests what --renderer=auto finds on a machine, with folders that imitate /dev/dri and
// /sys/class/drm.
#include "render/renderer_choice.hpp"

#include <gmock/gmock.h>

#include "temporary_folder.hpp"

namespace frontend {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class RendererChoice : public testing::Test {
 protected:
  RendererChoice() {
    fs::create_directories(folders_.devices);
    for (const char* name :
         {"LIBGL_ALWAYS_SOFTWARE", "GALLIUM_DRIVER", "MESA_LOADER_DRIVER_OVERRIDE"}) {
      environment_.push_back(std::make_unique<Environment>(name, ""));
    }
  }

  /// Adds a driver's node; if `driver` is empty, one without a device.
  void add_node(const std::string& name, const std::string& driver) {
    std::ofstream(folders_.devices + '/' + name) << "";
    const fs::path device = fs::path(folders_.classes) / name / "device";
    fs::create_directories(device);
    if (!driver.empty())
      fs::create_symlink("../../../bus/pci/drivers/" + driver, device / "driver");
  }

  std::string reason() const { return why_no_gpu(folders_).value_or("a GPU"); }

  TemporaryFolder folder_;
  GpuFolders folders_{folder_ / "dri", folder_ / "drm"};
  std::vector<std::unique_ptr<Environment>> environment_;
};

TEST_F(RendererChoice, ARenderNodeOfADriverIsAGpu) {
  for (const char* driver : {"amdgpu", "i915", "nvidia", "virtio_gpu"}) {
    add_node("renderD128", driver);
    EXPECT_EQ(reason(), "a GPU") << driver;
    fs::remove_all(folders_.classes);
  }
}

TEST_F(RendererChoice, ADisplayAloneIsNone) {
  EXPECT_THAT(reason(), HasSubstr("no render node"));
  add_node("card0", "bochs-drm");
  EXPECT_THAT(reason(), HasSubstr("no render node"));
  fs::remove_all(folders_.devices);
  EXPECT_THAT(reason(), HasSubstr("no render node"));
}

TEST_F(RendererChoice, VirtualDevicesAreNone) {
  for (const char* driver : {"", "vgem", "vkms", "faux_driver"}) {
    add_node("renderD128", driver);
    EXPECT_THAT(reason(), HasSubstr("renderD128 is a virtual device")) << driver;
    fs::remove_all(folders_.classes);
  }
}

TEST_F(RendererChoice, OneGpuAmongOthersSuffices) {
  add_node("renderD128", "vgem");
  add_node("renderD129", "i915");
  add_node("renderD130", "");
  EXPECT_EQ(reason(), "a GPU");
}

/// Nobody, root included, can open a folder in the node's place for writing.
TEST_F(RendererChoice, ANodeMustOpen) {
  add_node("renderD128", "i915");
  fs::remove(folders_.devices + "/renderD128");
  fs::create_directory(folders_.devices + "/renderD128");
  EXPECT_THAT(reason(), HasSubstr("renderD128 cannot be opened"));
}

TEST_F(RendererChoice, TheEnvironmentMayAskForSoftware) {
  add_node("renderD128", "i915");
  for (const char* value : {"1", "true", "Yes"}) {
    const Environment software("LIBGL_ALWAYS_SOFTWARE", value);
    EXPECT_THAT(reason(), HasSubstr("LIBGL_ALWAYS_SOFTWARE")) << value;
  }
  for (const char* value : {"0", "false", "no"}) {
    const Environment hardware("LIBGL_ALWAYS_SOFTWARE", value);
    EXPECT_EQ(reason(), "a GPU") << value;
  }
  for (const char* name : {"GALLIUM_DRIVER", "MESA_LOADER_DRIVER_OVERRIDE"}) {
    for (const char* driver : {"iris", "softpipe"}) {
      const Environment asked(name, driver);
      EXPECT_THAT(reason(), HasSubstr(driver == std::string("softpipe") ? name : "a GPU"));
    }
  }
}

TEST(SoftwareRenderer, IsKnownByItsName) {
  EXPECT_TRUE(is_software("llvmpipe (LLVM 15.0.6, 256 bits)"));
  EXPECT_TRUE(is_software("softpipe"));
  EXPECT_TRUE(is_software("zink Vulkan 1.3(llvmpipe (LLVM 15.0.6, 256 bits) (MESA_LLVMPIPE))"));
  EXPECT_FALSE(is_software("NVIDIA H200/PCIe/SSE2"));
  EXPECT_FALSE(is_software("Mesa Intel(R) UHD Graphics 620 (KBL GT2)"));
  EXPECT_FALSE(is_software("AMD Radeon RX 6600 (radeonsi, navi23, LLVM 15.0.6, DRM 3.49)"));
  EXPECT_FALSE(is_software("virgl (Mesa Intel(R) UHD Graphics)"));
}

}  // namespace
}  // namespace frontend
