#include "glrender/context.hpp"

#include <dlfcn.h>
#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include <utility>
#include <vector>

#include "shader_program.hpp"

namespace glrender {
namespace {

/// libepoxy loads these libraries by name at its first call, and ends the program where it cannot.
/// So they are loaded before that, and never unloaded.
void load_libraries() {
  const auto can_load = [](const char* name) { return dlopen(name, RTLD_LAZY) != nullptr; };
  if (!can_load("libEGL.so.1")) {
    throw GlError(std::string("EGL cannot be loaded: ") + dlerror() + " (install libegl1)");
  }
  if (!can_load("libOpenGL.so.0") && !can_load("libGL.so.1")) {
    throw GlError(std::string("OpenGL cannot be loaded: ") + dlerror() + " (install libopengl0)");
  }
}

/// Returns the displays to try, hardware first.
std::vector<EGLDisplay> candidate_displays() {
  std::vector<EGLDisplay> hardware;
  std::vector<EGLDisplay> software;
  if (epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_platform_device") &&
      epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_device_enumeration")) {
    EGLint count = 0;
    std::vector<EGLDeviceEXT> devices;
    if (eglQueryDevicesEXT(0, nullptr, &count) && count > 0) {
      devices.resize(static_cast<size_t>(count));
      if (!eglQueryDevicesEXT(count, devices.data(), &count)) count = 0;
    }
    for (EGLint i = 0; i < count; ++i) {
      const char* extensions = eglQueryDeviceStringEXT(devices[i], EGL_EXTENSIONS);
      const std::string list = extensions ? extensions : "";
      const bool is_software = list.find("EGL_MESA_device_software") != std::string::npos;
      const EGLDisplay display =
          eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, devices[i], nullptr);
      if (display != EGL_NO_DISPLAY) (is_software ? software : hardware).push_back(display);
    }
  }
  if (epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless")) {
    const EGLDisplay display =
        eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    if (display != EGL_NO_DISPLAY) software.insert(software.begin(), display);
  }
  hardware.insert(hardware.end(), software.begin(), software.end());
  return hardware;
}

}  // namespace

struct HeadlessContext::Impl {
  EGLDisplay display = EGL_NO_DISPLAY;
  EGLContext context = EGL_NO_CONTEXT;
  std::string renderer_name;
  uint64_t most_texels = 0;
  ProgramCache programs;

  /// Returns false, with nothing left open, if this display cannot give an OpenGL 3.3 core context.
  bool start(EGLDisplay candidate) {
    if (!eglInitialize(candidate, nullptr, nullptr)) return false;
    display = candidate;
    const EGLint config_attributes[] = {EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_SURFACE_TYPE,
                                        EGL_PBUFFER_BIT, EGL_NONE};
    const EGLint context_attributes[] = {EGL_CONTEXT_MAJOR_VERSION,
                                         3,
                                         EGL_CONTEXT_MINOR_VERSION,
                                         3,
                                         EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                         EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                         EGL_NONE};
    EGLConfig config = nullptr;
    EGLint count = 0;
    if (eglBindAPI(EGL_OPENGL_API) &&
        eglChooseConfig(display, config_attributes, &config, 1, &count) && count == 1) {
      context = eglCreateContext(display, config, EGL_NO_CONTEXT, context_attributes);
    }
    if (context != EGL_NO_CONTEXT &&
        eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context)) {
      renderer_name = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
      GLint limit = 0;
      glGetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &limit);
      most_texels = static_cast<uint64_t>(limit);
      return true;
    }
    stop();
    return false;
  }

  void stop() {
    if (display == EGL_NO_DISPLAY) return;
    if (context != EGL_NO_CONTEXT) {
      eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context);
      programs = {};
    }
    eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    if (context != EGL_NO_CONTEXT) eglDestroyContext(display, context);
    eglTerminate(display);
    display = EGL_NO_DISPLAY;
    context = EGL_NO_CONTEXT;
  }

  ~Impl() { stop(); }
};

HeadlessContext::HeadlessContext() : impl_(std::make_unique<Impl>()) {
  load_libraries();
  for (const EGLDisplay display : candidate_displays()) {
    if (impl_->start(display)) return;
  }
  throw GlError(
      "no OpenGL 3.3 context without a display can be had through EGL (install "
      "libgl1-mesa-dri, or a graphics driver)");
}

HeadlessContext::~HeadlessContext() = default;
HeadlessContext::HeadlessContext(HeadlessContext&&) noexcept = default;
HeadlessContext& HeadlessContext::operator=(HeadlessContext&&) noexcept = default;

const std::string& HeadlessContext::renderer_name() const { return impl_->renderer_name; }

uint64_t HeadlessContext::most_texels() const { return impl_->most_texels; }

void HeadlessContext::set_most_texels(uint64_t most) { impl_->most_texels = most; }

void HeadlessContext::leave_thread() {
  eglMakeCurrent(impl_->display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
}

void HeadlessContext::take_thread() {
  eglBindAPI(EGL_OPENGL_API);
  if (!eglMakeCurrent(impl_->display, EGL_NO_SURFACE, EGL_NO_SURFACE, impl_->context)) {
    throw GlError("a thread cannot take the OpenGL context over");
  }
}

ProgramCache& HeadlessContext::programs() { return impl_->programs; }

void HeadlessContext::set_compiles(bool compiles) { impl_->programs.set_compiles(compiles); }

}  // namespace glrender
