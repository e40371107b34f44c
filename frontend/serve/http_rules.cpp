#include "http_rules.hpp"

#include <sys/random.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <filesystem>
#include <system_error>

#include "base/lower_case.hpp"
#include "frontend/error.hpp"
#include "frontend/files.hpp"

namespace serve {
namespace {

namespace fs = std::filesystem;

constexpr const char* kPage = "index.html";
/// Larger panels are none.
constexpr std::size_t kMostPanelBytes = std::size_t{32} << 20;

constexpr std::pair<std::string_view, const char*> kTypes[] = {
    {".html", "text/html; charset=utf-8"},
    {".js", "text/javascript; charset=utf-8"},
    {".css", "text/css; charset=utf-8"},
    {".svg", "image/svg+xml"},
    {".png", "image/png"},
    {".json", "application/json"},
    {".map", "application/json"},
    {".woff2", "font/woff2"},
};

const char* type_of(const std::string& path) {
  for (const auto& [suffix, type] : kTypes)
    if (path.ends_with(suffix)) return type;
  return nullptr;
}

/// Returns a text for an attribute of HTML.
std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (c == '&')
      result += "&amp;";
    else if (c == '"')
      result += "&quot;";
    else if (c == '<')
      result += "&lt;";
    else
      result += c;
  }
  return result;
}

}  // namespace

std::string random_token() {
  std::array<unsigned char, 16> bytes{};
  std::size_t filled = 0;
  while (filled < bytes.size()) {
    const ssize_t count = getrandom(bytes.data() + filled, bytes.size() - filled, 0);
    if (count < 0 && errno != EINTR)
      throw std::system_error(errno, std::generic_category(), "getrandom");
    if (count > 0) filled += static_cast<std::size_t>(count);
  }
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string token;
  for (const unsigned char byte : bytes) token += {kDigits[byte / 16], kDigits[byte % 16]};
  return token;
}

bool are_same_secrets(std::string_view a, std::string_view b) {
  if (a.size() != b.size()) return false;  // which length a token has is no secret
  unsigned char difference = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    difference = static_cast<unsigned char>(difference | (a[i] ^ b[i]));
  return difference == 0;
}

HttpOrigin::HttpOrigin(const std::string& host, uint16_t port, bool is_loopback,
                       const std::string& seen) {
  if (!seen.empty()) {
    std::string origin = frontend::lower_case(seen);
    while (origin.ends_with('/')) origin.pop_back();
    const std::size_t scheme = origin.find("://");
    const bool is_origin = (origin.starts_with("http://") || origin.starts_with("https://")) &&
                           origin.size() > scheme + 3 &&
                           origin.find_first_of("/?#@ ", scheme + 3) == origin.npos;
    if (!is_origin)
      throw frontend::Error("", {}, "--origin=" + seen + " is no address of a server",
                            "give one like https://example.org");
    origins_ = {origin};
    return;
  }
  const std::string shown = host.find(':') == host.npos ? host : "[" + host + "]";
  origins_ = {"http://" + shown + ":" + std::to_string(port)};
  if (is_loopback) origins_.push_back("http://localhost:" + std::to_string(port));
}

std::string HttpOrigin::socket_address() const {
  return "ws" + address().substr(std::string_view("http").size());
}

bool HttpOrigin::accepts(std::string_view host, std::optional<std::string_view> origin) const {
  const std::string name = frontend::lower_case(std::string(host));
  return std::ranges::any_of(origins_, [&](const std::string& own) {
    return own.substr(own.find("://") + 3) == name &&
           (!origin || frontend::lower_case(std::string(*origin)) == own);
  });
}

HttpTarget http_target(std::string_view target) {
  constexpr std::string_view kToken = "token=";
  const std::size_t question = std::min(target.find('?'), target.size());
  HttpTarget result{target.substr(0, question), {}};
  std::string_view query = target.substr(std::min(question + 1, target.size()));
  while (!query.empty()) {
    const std::size_t end = std::min(query.find('&'), query.size());
    const std::string_view part = query.substr(0, end);
    if (part.starts_with(kToken)) result.token = part.substr(kToken.size());
    query.remove_prefix(std::min(end + 1, query.size()));
  }
  return result;
}

PanelFiles::PanelFiles(const std::string& folder) {
  std::error_code failed;
  std::size_t bytes = 0;
  for (fs::recursive_directory_iterator file(folder, failed), end; !failed && file != end;
       file.increment(failed)) {
    const std::string path = file->path().lexically_relative(folder).generic_string();
    const char* const type = type_of(path);
    std::error_code unknown;
    if (type == nullptr || !file->is_regular_file(unknown)) continue;
    const frontend::FileText text = frontend::read_regular_file(file->path());
    bytes += text.view().size();
    if (bytes > kMostPanelBytes) break;
    files_[path] = {type, std::string(text.view())};
  }
  if (!files_.contains(kPage) || bytes > kMostPanelBytes)
    throw frontend::Error(folder, {}, "holds no panel for browsers",
                          "install it, or name its folder by --panel");
}

std::string PanelFiles::page(const std::string& design_uri) const {
  std::string page = files_.find(kPage)->second.bytes;
  const std::size_t at = page.find("</head>");
  page.insert(std::min(at, page.size()),
              "<meta name=\"scadray-design\" content=\"" + escaped(design_uri) + "\">");
  return page;
}

const PanelFiles::File* PanelFiles::find(std::string_view path) const {
  const auto found = files_.find(path);
  return found == files_.end() ? nullptr : &found->second;
}

std::string panel_folder() {
  std::error_code failed;
  const fs::path folder = fs::read_symlink("/proc/self/exe", failed).parent_path();
  const fs::path installed = folder / "../share/scadray/panel";
  const fs::path built = folder / "serve/panel/dist";
  return (fs::exists(built / kPage, failed) ? built : installed).lexically_normal().string();
}

}  // namespace serve
