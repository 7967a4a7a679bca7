#include "server/guard.h"

#include <fmt/format.h>
#include <httplib.h>
#include <sys/random.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <stdexcept>
#include <utility>

namespace aplomb::studio {
namespace {

constexpr int unauthorized = 401, forbidden = 403, length_invalid = 400, too_large = 413;

/// Everything comes from this server; nothing is sent elsewhere, framed, or run that is not a file of it.
constexpr const char* content_policy =
    "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data: blob:; font-src 'self'; "
    "connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

/// Headers that may come once; where they come twice, two readers may take different ones.
bool comes_once(const httplib::Request& request, const char* key) { return request.get_header_value_count(key) <= 1; }

}  // namespace

std::string random_token() {
  std::array<unsigned char, 32> bytes{};
  std::size_t filled = 0;
  while (filled < bytes.size()) {
    const ssize_t count = getrandom(bytes.data() + filled, bytes.size() - filled, 0);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) throw std::runtime_error("the system gives no random numbers");
    filled += static_cast<std::size_t>(count);
  }
  std::string token;
  for (const unsigned char byte : bytes) token += fmt::format("{:02x}", byte);
  return token;
}

bool are_equal(std::string_view a, std::string_view b) {
  unsigned difference = a.size() == b.size() ? 0 : 1;
  for (std::size_t i = 0; i < a.size(); ++i)
    difference |=
        static_cast<unsigned>(static_cast<unsigned char>(a[i]) ^ static_cast<unsigned char>(i < b.size() ? b[i] : 0));
  return difference == 0;
}

bool Ticket::take(std::string_view word) {
  const std::lock_guard lock(mutex_);
  if (is_taken_ || std::chrono::steady_clock::now() > until_ || !are_equal(word, word_)) return false;
  return is_taken_ = true;
}

Guard::Guard(std::string token, int port, std::size_t most_body_bytes)
    : token_(std::move(token)), port_(std::to_string(port)), most_body_bytes_(most_body_bytes) {}

bool Guard::is_own_host(std::string_view host) const {
  return host == "127.0.0.1:" + port_ || host == "localhost:" + port_;
}

bool Guard::is_own_origin(std::string_view origin) const {
  constexpr std::string_view scheme = "http://";
  return origin.starts_with(scheme) && is_own_host(origin.substr(scheme.size()));
}

int Guard::refusal(const httplib::Request& request) const {
  for (const char* key : {"Host", "Origin", "Authorization", "Sec-Fetch-Site", "Content-Length"})
    if (!comes_once(request, key)) return forbidden;
  if (!is_own_host(request.get_header_value("Host"))) return forbidden;
  if (request.has_header("Origin") && !is_own_origin(request.get_header_value("Origin"))) return forbidden;
  const std::string site = request.get_header_value("Sec-Fetch-Site");
  if (!site.empty() && site != "same-origin" && site != "none") return forbidden;
  const bool asks_for_token = request.path == "/api/token" && request.method == "POST";
  if (request.path.starts_with("/api/") && !asks_for_token &&
      !are_equal(request.get_header_value("Authorization"), "Bearer " + token_))
    return unauthorized;
  if (!request.has_header("Content-Length")) return 0;
  const std::string length = request.get_header_value("Content-Length");
  std::size_t bytes = 0;
  const auto [end, error] = std::from_chars(length.data(), length.data() + length.size(), bytes);
  if (error == std::errc::result_out_of_range) return too_large;
  if (error != std::errc{} || end != length.data() + length.size()) return length_invalid;
  return bytes > most_body_bytes_ ? too_large : 0;
}

void harden(httplib::Response& response) {
  response.set_header("Content-Security-Policy", content_policy);
  response.set_header("X-Content-Type-Options", "nosniff");
  response.set_header("Referrer-Policy", "no-referrer");
  response.set_header("Cache-Control", "no-store");
  response.set_header("Cross-Origin-Opener-Policy", "same-origin");
  response.set_header("Cross-Origin-Resource-Policy", "same-origin");
}

}  // namespace aplomb::studio
