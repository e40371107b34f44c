// The program that `scadray serve` executes.
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <thread>

#include "frontend/run_program.hpp"
#include "http_server.hpp"
#include "options.hpp"
#include "rpc.hpp"
#include "server.hpp"

namespace serve {
namespace {

using frontend::ExitCode;

std::size_t read_input(char* bytes, std::size_t room) {
  for (;;) {
    const ssize_t count = read(STDIN_FILENO, bytes, room);
    if (count >= 0) return static_cast<std::size_t>(count);
    if (errno != EINTR) return 0;
  }
}

/// Writes to the client. What it no longer reads is dropped: the end of its input follows.
void write_output(const std::string& bytes) {
  for (std::size_t at = 0; at < bytes.size();) {
    const ssize_t count = write(STDOUT_FILENO, bytes.data() + at, bytes.size() - at);
    if (count < 0 && errno != EINTR) return;
    if (count > 0) at += static_cast<std::size_t>(count);
  }
}

ExitCode serve_editor(const Options& options) {
  std::signal(SIGPIPE, SIG_IGN);
  Inbox inbox;
  std::thread reading([&] {
    FrameReader reader(read_input);
    read_messages(reader, inbox);
  });
  bool has_shut_down = false;
  {
    Server server(
        options.language, [](const Json& message) { write_output(framed(message)); },
        [](Json message, const frontend::Bytes& image) {
          message["params"]["data"] = base64(image);
          write_output(framed(message));
        },
        [&](std::function<void()> work) {
          Inbox::Item item;
          item.work = std::move(work);
          inbox.put(std::move(item));
        });
    while (!server.has_ended()) {
      const Inbox::Item item = inbox.take();
      if (item.work)
        item.work();
      else if (item.error)
        server.refuse(*item.error);
      else if (item.message)
        server.handle(*item.message, item.is_cancelled);
      else
        break;
    }
    has_shut_down = server.has_shut_down();
  }
  reading.join();
  return has_shut_down ? ExitCode::kDone : ExitCode::kFailure;
}

ExitCode serve_browsers(const Options& options) {
  std::signal(SIGPIPE, SIG_IGN);
  HttpServer server({options.design, options.language, options.bind, options.port, options.origin},
                    PanelFiles(options.panel.empty() ? panel_folder() : options.panel));
  std::printf("%s\n", server.address().c_str());
  std::fflush(stdout);
  if (!server.is_loopback()) {
    std::fputs(
        "scadray serve: warning: whoever is on the way can read the pictures and the token (put "
        "TLS "
        "in front, and give its address by --origin)\n",
        stderr);
  }
  server.run(true);
  return ExitCode::kDone;
}

ExitCode run(const std::vector<std::string>& arguments) {
  const Options options = parse_options(arguments);
  if (frontend::print_requested(options.request, help_text(),
                                "scadray-serve version " SCADRAY_VERSION)) {
    return ExitCode::kDone;
  }
  if (!options.design.empty()) return serve_browsers(options);
  return serve_editor(options);
}

}  // namespace
}  // namespace serve

int main(int argc, char** argv) {
  const std::vector<std::string> arguments(argv + (argc > 0 ? 1 : 0), argv + argc);
  return static_cast<int>(
      frontend::run_program([&] { return serve::run(arguments); }, "a smaller design"));
}
