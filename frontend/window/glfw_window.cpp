#include "glfw_window.hpp"

#include <epoxy/gl.h>

#define GLFW_INCLUDE_NONE  // epoxy provides OpenGL
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "commands.hpp"
#include "frontend/error.hpp"
#include "frontend/terminal.hpp"
#include "letters.hpp"

namespace window {
namespace {

/// A press and a release at most this far apart are a click, in units of the screen.
constexpr double kClickReach = 3;
/// Two clicks within this time are a double click.
constexpr double kDoubleClick_s = 0.4;
constexpr double kUnknownRate = 60;  // frames/s, if the display does not tell
constexpr Size kLeastSize{160, 120};

std::string last_error;  // GLFW's

/// Returns whether a command is done again and again while its key is held.
bool repeats(const CommandRow* row) {
  return row && (row->command == Command::kZoomIn || row->command == Command::kZoomOut);
}

/// By GLFW's numbers.
constexpr WindowEvents::Button kButtons[] = {
    WindowEvents::Button::kLeft, WindowEvents::Button::kRight, WindowEvents::Button::kMiddle};

uint8_t modifiers_of(int glfw_modifiers) {
  return static_cast<uint8_t>(((glfw_modifiers & GLFW_MOD_CONTROL) ? kControl : 0) |
                              ((glfw_modifiers & GLFW_MOD_SHIFT) ? kShift : 0) |
                              ((glfw_modifiers & GLFW_MOD_ALT) ? kAlt : 0));
}

[[noreturn]] void fail(const std::string& what, const std::string& todo) {
  throw frontend::Error("", {}, what + (last_error.empty() ? "" : ": " + last_error), todo);
}

/// Holds GLFW itself, as long as there is a window.
class Library {
 public:
  Library() {
    glfwSetErrorCallback([](int, const char* text) { last_error = text; });
    if (!glfwInit()) {
      fail("no window can be opened", "set DISPLAY; or draw without a window: scadray -o FILE.png");
    }
  }
  ~Library() { glfwTerminate(); }
  Library(const Library&) = delete;
  Library& operator=(const Library&) = delete;
};

}  // namespace

struct GlfwWindow::Impl {
  Impl(const std::string& title, Size size, WindowEvents& window_events);
  ~Impl();
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  void open(const std::string& title, Size size);
  void set_up_imgui();
  void on_button(int button, int action, int glfw_modifiers);
  void on_cursor(double x, double y);
  struct Key {
    int key, scancode, modifiers;  // GLFW's
  };
  void on_key(const Key& key, int action);
  void release_keys();
  void place_cursor();
  double pixels_per_unit() const;
  bool is_over_panel() const;

  static Impl& of(GLFWwindow* window) {
    return *static_cast<Impl*>(glfwGetWindowUserPointer(window));
  }

  WindowEvents& events;
  Library library;
  GLFWwindow* window = nullptr;
  std::optional<Letters> letters;
  bool is_active = true;
  bool has_new_keys = false;  // some went down since the last frame
  std::vector<Key> released;  // those that went up after that

  // The state of the mouse, in units of the screen.
  int pressed = -1;  // the button that is held; -1: none
  uint8_t modifiers = 0;
  bool has_cursor = false;  // its place is known
  double cursor_x = 0, cursor_y = 0;
  double press_x = 0, press_y = 0;
  double last_x = 0, last_y = 0;  // up to where it was dragged
  bool has_moved = false;
  double last_click_s = -1e9;
  std::optional<ImVec2> panel_press;  // where a panel was pressed that has not seen it yet
};

GlfwWindow::Impl::Impl(const std::string& title, Size size, WindowEvents& window_events)
    : events(window_events) {
  open(title, size);
  set_up_imgui();
}

void GlfwWindow::Impl::open(const std::string& title, Size size) {
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHintString(GLFW_X11_CLASS_NAME, "scadray");
  glfwWindowHintString(GLFW_X11_INSTANCE_NAME, "scadray");
  window = glfwCreateWindow(static_cast<int>(size.width_px), static_cast<int>(size.height_px),
                            frontend::visible(title).c_str(), nullptr, nullptr);
  if (!window) {
    fail("no window with OpenGL 3.3 can be opened",
         "install a driver, with: apt-get install libgl1-mesa-dri; or draw without a window: "
         "scadray -o FILE.png");
  }
  glfwMakeContextCurrent(window);
  glfwSwapInterval(1);
  glfwSetWindowSizeLimits(window, kLeastSize.width_px, kLeastSize.height_px, GLFW_DONT_CARE,
                          GLFW_DONT_CARE);
  glfwSetWindowUserPointer(window, this);
  glfwSetMouseButtonCallback(window, [](GLFWwindow* w, int button, int action, int mods) {
    of(w).on_button(button, action, mods);
  });
  glfwSetCursorPosCallback(window,
                           [](GLFWwindow* w, double x, double y) { of(w).on_cursor(x, y); });
  glfwSetScrollCallback(window, [](GLFWwindow* w, double, double notches) {
    Impl& impl = of(w);
    impl.is_active = true;
    if (impl.is_over_panel()) return;
    const double scale = impl.pixels_per_unit();
    impl.events.wheel(notches, impl.cursor_x * scale, impl.cursor_y * scale);
  });
  const auto activity = [](GLFWwindow* w) { of(w).is_active = true; };
  glfwSetWindowRefreshCallback(window, activity);
  glfwSetWindowCloseCallback(window, activity);
  glfwSetFramebufferSizeCallback(window, [](GLFWwindow* w, int, int) { of(w).is_active = true; });
  glfwSetWindowIconifyCallback(window, [](GLFWwindow* w, int) { of(w).is_active = true; });
  glfwSetCursorEnterCallback(window, [](GLFWwindow* w, int is_inside) {
    of(w).is_active = true;
    if (!is_inside) of(w).events.leave();
  });
}

void GlfwWindow::Impl::set_up_imgui() {
  IMGUI_CHECKVERSION();
  ImGui::CreateContext();
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;  // nothing is stored between runs
  io.ConfigFlags |= ImGuiConfigFlags_NoMouseCursorChange;
  float scale = 1, scale_y = 1;
  glfwGetWindowContentScale(window, &scale, &scale_y);
  letters.emplace(scale);
  ImGui::StyleColorsDark();
  ImGui::GetStyle().ScaleAllSizes(scale);
  ImGui::GetStyle().WindowRounding = 4;
  // ImGui calls the callbacks that are installed already.
  ImGui_ImplGlfw_InitForOpenGL(window, true);
  // The callback for keys is ours alone, and passes them on to ImGui.
  glfwSetKeyCallback(window, [](GLFWwindow* w, int key, int scancode, int action, int mods) {
    of(w).on_key({key, scancode, mods}, action);
  });
  if (!ImGui_ImplOpenGL3_Init("#version 330 core")) {
    fail("Dear ImGui does not start on this OpenGL", "draw without a window: scadray -o FILE.png");
  }
}

GlfwWindow::Impl::~Impl() {
  if (ImGui::GetCurrentContext()) {
    ImGui_ImplOpenGL3_Shutdown();
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext();
  }
  if (window) glfwDestroyWindow(window);
}

/// Returns whether the mouse is over a panel, or a panel holds it. ImGui itself knows of the
/// cursor's place from the last frame only, and the cursor may have jumped since.
bool GlfwWindow::Impl::is_over_panel() const {
  const ImGuiContext& imgui = *ImGui::GetCurrentContext();
  if (imgui.OpenPopupStack.Size > 0 || (imgui.ActiveId != 0 && ImGui::IsAnyMouseDown()))
    return true;
  const ImVec2 place(static_cast<float>(cursor_x), static_cast<float>(cursor_y));
  return std::any_of(imgui.Windows.begin(), imgui.Windows.end(), [&](const ImGuiWindow* panel) {
    const bool takes_mouse = (panel->Flags & ImGuiWindowFlags_NoMouseInputs) == 0;
    return panel->Active && !panel->Hidden && takes_mouse &&
           panel->OuterRectClipped.Contains(place);
  });
}

double GlfwWindow::Impl::pixels_per_unit() const {
  int width = 0, height = 0, pixels_x = 0, pixels_y = 0;
  glfwGetWindowSize(window, &width, &height);
  glfwGetFramebufferSize(window, &pixels_x, &pixels_y);
  return width > 0 ? static_cast<double>(pixels_x) / width : 1;
}

void GlfwWindow::Impl::on_button(int button, int action, int glfw_modifiers) {
  is_active = true;
  if (action == GLFW_PRESS) {
    if (pressed >= 0 || button > GLFW_MOUSE_BUTTON_MIDDLE) return;
    if (is_over_panel()) {
      panel_press = ImVec2(static_cast<float>(cursor_x), static_cast<float>(cursor_y));
      return;
    }
    pressed = button;
    modifiers = modifiers_of(glfw_modifiers);
    has_moved = false;
    // The place is taken from the events: the cursor's present place is further on if events come
    // late.
    press_x = last_x = cursor_x;
    press_y = last_y = cursor_y;
    events.press(kButtons[pressed], press_x * pixels_per_unit(), press_y * pixels_per_unit());
    return;
  }
  if (button != pressed) return;
  pressed = -1;
  if (has_moved) return;
  if (button == GLFW_MOUSE_BUTTON_RIGHT) events.right_click();
  if (button != GLFW_MOUSE_BUTTON_LEFT) return;
  const double now = glfwGetTime();
  const double scale = pixels_per_unit();
  const bool is_second = now - last_click_s < kDoubleClick_s;
  last_click_s = is_second ? -1e9 : now;
  if (is_second) {
    events.double_click(press_x * scale, press_y * scale);
  } else {
    events.click(modifiers, press_x * scale, press_y * scale);
  }
}

/// This ImGui sees the keys that are down in a frame. So a key that goes up before its frame is
/// drawn goes up for ImGui after that frame; and so does any other, since Ctrl may go up after the
/// key that it belongs to.
void GlfwWindow::Impl::on_key(const Key& key, int action) {
  is_active = true;
  if (action != GLFW_RELEASE) {
    const uint8_t held = modifiers_of(key.modifiers);
    const bool counts = action == GLFW_PRESS || repeats(find_command(key.key, held));
    if (counts && !ImGui::GetIO().WantTextInput) events.key(key.key, held);
    has_new_keys = true;
  } else if (has_new_keys) {
    released.push_back(key);
    return;
  }
  ImGui_ImplGlfw_KeyCallback(window, key.key, key.scancode, action, key.modifiers);
}

void GlfwWindow::Impl::release_keys() {
  for (const Key& key : released) {
    ImGui_ImplGlfw_KeyCallback(window, key.key, key.scancode, GLFW_RELEASE, key.modifiers);
  }
  if (!released.empty()) is_active = true;
  released.clear();
  has_new_keys = false;
}

void GlfwWindow::Impl::on_cursor(double x, double y) {
  is_active = true;
  has_cursor = true;
  cursor_x = x;
  cursor_y = y;
  const double scale = pixels_per_unit();
  if (pressed < 0) return events.move(x * scale, y * scale);
  if (!has_moved && std::hypot(x - press_x, y - press_y) < kClickReach) return;
  has_moved = true;
  const double dx = x - std::exchange(last_x, x), dy = y - std::exchange(last_y, y);
  events.drag(kButtons[pressed], modifiers, dx * scale, dy * scale);
}

/// ImGui's backend asks where the cursor is now, which may have left what its button still holds:
/// the button's release is an event that has not come yet. A frame that sees a panel pressed for
/// the first time has the cursor where that was.
void GlfwWindow::Impl::place_cursor() {
  ImVec2& place = ImGui::GetIO().MousePos;
  if (has_cursor && ImGui::IsMousePosValid(&place)) {
    place = {static_cast<float>(cursor_x), static_cast<float>(cursor_y)};
  }
  if (const auto press = std::exchange(panel_press, std::nullopt)) {
    place = *press;
    is_active = true;  // the next frame has the cursor where it is
  }
}

GlfwWindow::GlfwWindow(const std::string& title, Size size, WindowEvents& events)
    : impl_(std::make_unique<Impl>(title, size, events)) {}
GlfwWindow::~GlfwWindow() = default;

bool GlfwWindow::is_closing() const { return glfwWindowShouldClose(impl_->window); }
void GlfwWindow::close() { glfwSetWindowShouldClose(impl_->window, GLFW_TRUE); }

Size GlfwWindow::size() const {
  if (glfwGetWindowAttrib(impl_->window, GLFW_ICONIFIED)) return {};
  int width = 0, height = 0;
  glfwGetFramebufferSize(impl_->window, &width, &height);
  return {static_cast<uint32_t>(std::max(width, 0)), static_cast<uint32_t>(std::max(height, 0))};
}

double GlfwWindow::pixels_per_unit() const { return impl_->pixels_per_unit(); }

double GlfwWindow::frames_per_second() const {
  GLFWmonitor* const monitor = glfwGetPrimaryMonitor();
  const GLFWvidmode* const mode = monitor ? glfwGetVideoMode(monitor) : nullptr;
  return mode && mode->refreshRate > 0 ? mode->refreshRate : kUnknownRate;
}

void GlfwWindow::set_title(const std::string& title) {
  glfwSetWindowTitle(impl_->window, frontend::visible(title).c_str());
}

void GlfwWindow::wait() { glfwWaitEvents(); }
void GlfwWindow::wait(double timeout_s) { glfwWaitEventsTimeout(timeout_s); }
void GlfwWindow::poll() { glfwPollEvents(); }
void GlfwWindow::wake() { glfwPostEmptyEvent(); }
bool GlfwWindow::take_activity() { return std::exchange(impl_->is_active, false); }

bool GlfwWindow::is_over_panel() const { return impl_->is_over_panel(); }

void GlfwWindow::need_letters(std::string_view text) { impl_->letters->need(text); }

void GlfwWindow::begin_frame() {
  if (impl_->letters->load()) {
    ImGui_ImplOpenGL3_DestroyFontsTexture();
    ImGui_ImplOpenGL3_CreateFontsTexture();
  }
  ImGui_ImplOpenGL3_NewFrame();
  ImGui_ImplGlfw_NewFrame();
  impl_->place_cursor();
  ImGui::NewFrame();
}

void GlfwWindow::drop_frame() {
  ImGui::EndFrame();
  impl_->release_keys();
}

void GlfwWindow::end_frame() {
  ImGui::Render();
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
  impl_->release_keys();
  glfwSwapBuffers(impl_->window);
}

}  // namespace window
