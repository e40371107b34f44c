#include "drop_files.hpp"

#include <X11/Xatom.h>
#include <X11/Xlib.h>

#include <chrono>
#include <memory>
#include <thread>

namespace window_test {
namespace {

constexpr std::chrono::seconds kMost{60};
constexpr long kVersion = 5;  // of Xdnd

class FileDrop {
 public:
  FileDrop(Display* display, Window target, const std::vector<std::string>& paths)
      : display_(display),
        target_(target),
        source_(XCreateSimpleWindow(display, DefaultRootWindow(display), 0, 0, 1, 1, 0, 0, 0)) {
    for (const std::string& path : paths) uris_ += "file://" + path + "\r\n";
    XSetSelectionOwner(display_, atom("XdndSelection"), source_, CurrentTime);
  }
  ~FileDrop() { XDestroyWindow(display_, source_); }
  FileDrop(const FileDrop&) = delete;
  FileDrop& operator=(const FileDrop&) = delete;

  bool run() {
    send("XdndEnter", kVersion << 24, static_cast<long>(atom("text/uri-list")));
    send("XdndPosition", 0, (200L << 16) | 150L, CurrentTime,
         static_cast<long>(atom("XdndActionCopy")));
    if (!wait_for("XdndStatus")) return false;
    send("XdndDrop", 0, CurrentTime);
    return wait_for("XdndFinished");
  }

 private:
  Atom atom(const char* name) const { return XInternAtom(display_, name, False); }

  void send(const char* type, long a, long b, long c = 0, long d = 0) {
    XEvent event{};
    event.xclient.type = ClientMessage;
    event.xclient.window = target_;
    event.xclient.message_type = atom(type);
    event.xclient.format = 32;
    const long data[] = {static_cast<long>(source_), a, b, c, d};
    for (int i = 0; i < 5; ++i) event.xclient.data.l[i] = data[i];
    XSendEvent(display_, target_, False, NoEventMask, &event);
    XFlush(display_);
  }

  /// Answers what the window asks for the names of the files, until it sends such a message.
  bool wait_for(const char* type) {
    const auto end = std::chrono::steady_clock::now() + kMost;
    while (std::chrono::steady_clock::now() < end) {
      while (XPending(display_) > 0) {
        XEvent event;
        XNextEvent(display_, &event);
        if (event.type == SelectionRequest) answer(event.xselectionrequest);
        if (event.type == ClientMessage && event.xclient.message_type == atom(type)) return true;
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    return false;
  }

  void answer(const XSelectionRequestEvent& request) {
    XChangeProperty(display_, request.requestor, request.property, request.target, 8,
                    PropModeReplace, reinterpret_cast<const unsigned char*>(uris_.data()),
                    static_cast<int>(uris_.size()));
    XEvent event{};
    event.xselection.type = SelectionNotify;
    event.xselection.requestor = request.requestor;
    event.xselection.selection = request.selection;
    event.xselection.target = request.target;
    event.xselection.property = request.property;
    event.xselection.time = request.time;
    XSendEvent(display_, request.requestor, False, NoEventMask, &event);
    XFlush(display_);
  }

  Display* const display_;
  const Window target_;
  const Window source_;
  std::string uris_;
};

}  // namespace

bool drop_files(const std::string& display_name, unsigned long window,
                const std::vector<std::string>& paths) {
  const std::unique_ptr<Display, int (*)(Display*)> display(XOpenDisplay(display_name.c_str()),
                                                            XCloseDisplay);
  return display && FileDrop(display.get(), window, paths).run();
}

}  // namespace window_test
