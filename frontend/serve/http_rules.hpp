// What a server for browsers answers to whom, without the network.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace serve {

/// Returns 128 random bits of the system's in hexadecimal digits. Throws std::system_error.
std::string random_token();

/// Compares in a time that does not depend on where they differ.
bool are_same_secrets(std::string_view a, std::string_view b);

/// The addresses of a server, and those that it answers.
class HttpOrigin {
 public:
  /// `seen` is the address that browsers see in place of that ("https://host"); empty: there is no
  /// other. Throws frontend::Error if it is no such address.
  HttpOrigin(const std::string& host, uint16_t port, bool is_loopback, const std::string& seen);

  /// "http://host:port"
  const std::string& address() const { return origins_.front(); }
  /// For the page's policy: where it may open WebSockets.
  std::string socket_address() const;
  /// `origin` is absent where no browser's page has asked, or where one was typed or followed to.
  bool accepts(std::string_view host, std::optional<std::string_view> origin) const;

 private:
  std::vector<std::string> origins_;  // the first is the one that is printed
};

/// The path of a request's target, and its token, as they are: nothing is decoded.
struct HttpTarget {
  std::string_view path, token;
};
HttpTarget http_target(std::string_view target);

/// The files of the panel, read once.
class PanelFiles {
 public:
  struct File {
    std::string type, bytes;
  };

  /// Reads all files of a folder. Throws frontend::Error if it has no `index.html`.
  explicit PanelFiles(const std::string& folder);

  /// Returns the panel's page for a design, by its URI.
  std::string page(const std::string& design_uri) const;
  /// Returns a file by its path below the folder; null if there is none.
  const File* find(std::string_view path) const;

 private:
  std::map<std::string, File, std::less<>> files_;
};

/// Returns the folder of the panel beside this program: as it is installed, or as it is built.
std::string panel_folder();

}  // namespace serve
